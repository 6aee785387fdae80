"""The laser-cut jig: what the laser draws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from wrapit.geometry import Edge

LaserLayer = Literal["ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER"]


@dataclass(frozen=True)
class Contour:
    """One run of the laser: edges that follow one another, on the layer that says what is done there.

    On the CUT layers contours are closed; engraved lines may be open.
    """

    layer: LaserLayer
    edges: tuple[Edge, ...]

    def __post_init__(self) -> None:
        if not self.edges:
            raise ValueError("a contour has at least one edge")

    @property
    def closed(self) -> bool:
        """Whether the last edge ends where the first starts (within a micrometre)."""
        (x, y), (u, v) = self.edges[0].start, self.edges[-1].end
        return abs(x - u) < 1e-3 and abs(y - v) < 1e-3
