"""Flat drawings of a jig at true size: what a laser, a plotter or a pen follows."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from wrapit.geometry import Edge
from wrapit.geometry.outlines.loops import Point, moved

Layer = Literal["NOTE", "ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER"]


@dataclass(frozen=True)
class Contour:
    """One run of the laser: edges that follow one another, on the layer that says what is done there.

    On the CUT layers contours are closed; engraved lines may be open. What stands on NOTE is for people:
    the laser leaves it out.
    """

    layer: Layer
    edges: tuple[Edge, ...]

    def __post_init__(self) -> None:
        if not self.edges:
            raise ValueError("a contour has at least one edge")

    @property
    def closed(self) -> bool:
        """Whether the last edge ends where the first starts (within a micrometre)."""
        (x, y), (u, v) = self.edges[0].start, self.edges[-1].end
        return bool(abs(x - u) < 1e-3 and abs(y - v) < 1e-3)

    @property
    def is_cut(self) -> bool:
        """Whether the laser goes through the sheet here."""
        return self.layer.startswith("CUT")

    @property
    def is_worked(self) -> bool:
        """Whether the laser follows it at all."""
        return self.layer != "NOTE"

    def moved(self, quarters: int, shift: tuple[float, float]) -> Contour:
        """The contour turned by right angles about the origin, then shifted."""
        return Contour(self.layer, tuple(moved(edge, quarters, shift) for edge in self.edges))


@dataclass(frozen=True, eq=False)
class FlatDrawing:
    """A drawing for one file: its name, what is drawn, its size; the lower left corner is the origin."""

    stem: str
    title: str
    contours: tuple[Contour, ...]
    width_mm: float
    height_mm: float


def arrow_head(back: Point, tip: Point, width_mm: float) -> tuple[Point, Point, Point]:
    """One barb, the tip and the other barb of an arrow head whose barbs lie on both sides of `back`.

    >>> arrow_head((0.0, 0.0), (3.0, 0.0), 2.0)
    ((0.0, 1.0), (3.0, 0.0), (0.0, -1.0))
    """
    along = math.dist(back, tip)
    across = width_mm / 2 * (tip[0] - back[0]) / along, width_mm / 2 * (tip[1] - back[1]) / along
    return (back[0] - across[1], back[1] + across[0]), tip, (back[0] + across[1], back[1] - across[0])
