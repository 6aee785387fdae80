"""What a wire asks of a drawing, and the drawing that was made to answer it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from wrapit.drawing.model import Drawing
from wrapit.geometry import FloatArray, locked

Level = Literal["gentle", "bold"]


@dataclass(frozen=True)
class Limits:
    """What a wire of a certain thickness can be, in mm."""

    diameter_mm: float
    radius_mm: float
    """Of the tightest bend of a centreline."""

    room_mm: float
    """Diameter of the largest circle inside a face, at least."""

    ring_mm: float
    """The same of a loop that a post of the jig has to stand in."""

    shortest_mm: float
    """Length of the shortest segment that hands can bend."""


@dataclass(frozen=True, eq=False)
class Bead:
    """A bead or stone where the drawing has a small closed loop or a dot; `at` is (2,).

    `segment` is the segment of the fitted drawing that runs through it, None where none does.
    """

    at: FloatArray
    diameter_mm: float
    segment: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", locked(self.at))


@dataclass(frozen=True)
class Measures:
    """How fit a drawing is; `wires` are the fewest that its odd junctions allow."""

    segments: int
    wires: int
    tight_bends: int
    smallest_face_mm: float | None
    length_mm: float


@dataclass(frozen=True)
class Costs:
    """What it took: shares of the outline kept (within half a wire) and of the length left out, a distance.

    `deviation_mm` is how far a place that is kept lies from where it was drawn, at most.
    """

    outline_kept: float
    left_out: float
    deviation_mm: float


@dataclass(frozen=True, eq=False)
class Fitted:
    """A drawing that wire can follow, in the frame of the one that was read.

    `origins` are for each segment those of `original` that it comes from; a segment of `original` that is in
    none of them was left out. What was changed is told in `drawing.removed`, after what reading it changed.
    """

    original: Drawing
    drawing: Drawing
    origins: tuple[tuple[int, ...], ...]
    beads: tuple[Bead, ...]
    before: Measures
    after: Measures
    costs: Costs

    @property
    def left_out(self) -> tuple[int, ...]:
        """Strokes of the original that are in no segment of the drawing; bridges are offered anew."""
        kept = {number for origin in self.origins for number in origin}
        strokes = (segment for segment in self.original.segments if segment.kind == "stroke")
        return tuple(segment.id for segment in strokes if segment.id not in kept)
