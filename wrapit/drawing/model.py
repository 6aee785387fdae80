"""A drawing: a planar graph of Bézier segments, in mm, y up."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, locked

SegmentKind = Literal["stroke", "bridge"]


@dataclass(frozen=True, eq=False)
class Junction:
    """An end, a crossing, or a sharp corner; `point` is (2,)."""

    id: int
    point: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", locked(self.point))


@dataclass(frozen=True, eq=False)
class Segment:
    """A curve between two junctions (ids), passing no other; a loop starts and ends at one."""

    id: int
    start: int
    end: int
    curve: BezierChain
    kind: SegmentKind = "stroke"


@dataclass(frozen=True)
class Removal:
    """Something clean-up removed, merged or added, and why."""

    what: str
    at: tuple[float, float]
    length_mm: float
    reason: str = ""


@dataclass(frozen=True)
class Dot:
    """A dot, or a round ring that touches nothing: no line of the drawing, but a bead may stand for it."""

    at: tuple[float, float]
    diameter_mm: float


@dataclass(frozen=True)
class PixelFrame:
    """Where the bitmap lies: mm of the centre of pixel (0, 0); y_mm falls as y_px grows."""

    mm_per_px: float
    origin_mm: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Junctions and segments, each at the index of its id.

    Raises ValueError where ids don't count up from 0 or a segment doesn't end exactly on its junctions.
    """

    junctions: tuple[Junction, ...]
    segments: tuple[Segment, ...]
    stroke_width_mm: float | None = None
    pixel_frame: PixelFrame | None = None
    removed: tuple[Removal, ...] = field(default=())
    dots: tuple[Dot, ...] = ()
    """Of what was left out, what is round; files don't hold it."""

    def __post_init__(self) -> None:
        for index, junction in enumerate(self.junctions):
            if junction.id != index:
                raise ValueError(f"junction {junction.id} is at index {index}")
        for index, segment in enumerate(self.segments):
            if segment.id != index:
                raise ValueError(f"segment {segment.id} is at index {index}")
            for junction_id, point in (
                (segment.start, segment.curve.start),
                (segment.end, segment.curve.end),
            ):
                if not 0 <= junction_id < len(self.junctions):
                    raise ValueError(f"segment {index} names junction {junction_id}, which doesn't exist")
                if not np.array_equal(point, self.junctions[junction_id].point):
                    raise ValueError(f"segment {index} doesn't end on junction {junction_id}")

    def half_edges(self) -> list[list[int]]:
        """For each junction its half-edges: 2e at the start of segment e, 2e + 1 at its end."""
        incident: list[list[int]] = [[] for _ in self.junctions]
        for segment in self.segments:
            incident[segment.start].append(2 * segment.id)
            incident[segment.end].append(2 * segment.id + 1)
        return incident

    @property
    def odd_junctions(self) -> int:
        """Number of junctions where an odd number of segment ends meet."""
        return sum(len(ends) % 2 for ends in self.half_edges())

    @property
    def length_mm(self) -> float:
        """Total length of the segments."""
        return sum(segment.curve.length for segment in self.segments)

    @property
    def bounds_mm(self) -> tuple[FloatArray, FloatArray]:
        """Lower left and upper right corner of the centre lines, (2,) each."""
        points = np.concatenate([segment.curve.sampled(0.05) for segment in self.segments])
        return points.min(axis=0), points.max(axis=0)
