"""A drawing while it is changed: lines between nodes, each knowing which segments it comes from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from wrapit.drawing.assembly import Piece, Placement, assemble
from wrapit.drawing.model import Drawing, Removal
from wrapit.drawing.reflection import spread
from wrapit.geometry import BezierChain, FloatArray, joined, unit
from wrapit.geometry.polyline import lengths

if TYPE_CHECKING:
    import shapely

    from wrapit.fit.faces import Faces

# How finely lines become chains of points: far below a wire's thickness. Half of it changes no circle inside
# a face of the corpus by more than 0.01 mm.
STEP_MM = 0.1
# How finely lines are compared with one another: a tenth of the room that 18 AWG needs.
_TRAIL_MM = 0.25
# Directions at a node are those of the first so many mm: nearer, the drawing is unsteady.
_LOOK_MM = 1.0


@dataclass(frozen=True, eq=False)
class Line:
    """A curve between two nodes, and the segments of the original drawing that it comes from."""

    start: int
    end: int
    curve: BezierChain
    origin: frozenset[int]

    @property
    def is_ring(self) -> bool:
        """Whether it ends where it starts."""
        return self.start == self.end

    @cached_property
    def shape(self) -> shapely.LineString:
        """The line as a chain of points."""
        import shapely

        return shapely.LineString(self.curve.sampled(STEP_MM))

    @cached_property
    def headings(self) -> tuple[FloatArray, FloatArray]:
        """Directions (2,) in which the line leaves its start and its end, over its first mm there."""
        points = self.curve.sampled(STEP_MM)
        return heading(points), heading(points[::-1])

    @cached_property
    def spread(self) -> FloatArray:
        """Points (9, 2) at even distances along it."""
        return spread(self.curve)

    @cached_property
    def trail(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Points (m, 2) at most 0.25 mm apart, mm along the line to each (m,), and unit directions there."""
        points = self.curve.sampled(_TRAIL_MM)
        along = lengths(points)
        # Chords alone are shorter than its bends, by 0.05 mm in some.
        along *= self.curve.length / max(float(along[-1]), 1e-12)
        return points, along, unit(np.gradient(points, axis=0))

    def reversed(self) -> Line:
        """The same line travelled the other way."""
        return Line(self.end, self.start, self.curve.reversed(), self.origin)

    def told(self, what: str, reason: str) -> Removal:
        """What is told of a change to the line: where its middle is, how long it is, and why."""
        points = self.curve.sampled(STEP_MM)
        x, y = points[len(points) // 2]
        return Removal(what, (float(x), float(y)), self.curve.length, reason)


# One end of a line: the line's number, and whether it is its last end.
Arm = tuple[int, bool]


@dataclass(frozen=True, eq=False)
class Sketch:
    """Nodes (points (2,) by number) and lines by number; both keep their numbers while others go.

    `removed` tells what was changed so far.
    """

    nodes: Mapping[int, FloatArray]
    lines: Mapping[int, Line]
    removed: tuple[Removal, ...] = ()

    @classmethod
    def of(cls, drawing: Drawing) -> Sketch:
        """A drawing's strokes as a sketch: junctions and segments keep their numbers."""
        strokes = [segment for segment in drawing.segments if segment.kind == "stroke"]
        used = {node for stroke in strokes for node in (stroke.start, stroke.end)}
        return cls(
            {junction.id: junction.point for junction in drawing.junctions if junction.id in used},
            {s.id: Line(s.start, s.end, s.curve, frozenset((s.id,))) for s in strokes},
        )

    @cached_property
    def arms(self) -> dict[int, list[Arm]]:
        """The ends of lines at each node, in the order of their numbers; a ring has two."""
        arms: dict[int, list[Arm]] = {}
        for number, line in sorted(self.lines.items()):
            arms.setdefault(line.start, []).append((number, False))
            arms.setdefault(line.end, []).append((number, True))
        return arms

    @cached_property
    def places(self) -> tuple[list[int], shapely.STRtree]:
        """The numbers of the lines, and a tree of their shapes in that order."""
        import shapely

        numbers = sorted(self.lines)
        return numbers, shapely.STRtree([self.lines[number].shape for number in numbers])

    @cached_property
    def faces(self) -> Faces:
        """What the lines enclose, and which are seen from outside."""
        from wrapit.fit.faces import faces_of  # which asks for sketches

        return faces_of(self)

    def leaving(self, arm: Arm) -> BezierChain:
        """The curve of an arm, travelled away from its node."""
        line = self.lines[arm[0]]
        return line.curve.reversed() if arm[1] else line.curve

    def heading(self, arm: Arm) -> FloatArray:
        """The direction (2,) in which an arm leaves its node."""
        return self.lines[arm[0]].headings[arm[1]]

    def changed(
        self,
        without: Iterable[int] = (),
        lines: Mapping[int, Line] | None = None,
        nodes: Mapping[int, FloatArray] | None = None,
        told: Iterable[Removal] = (),
    ) -> Sketch:
        """The sketch without some lines, with others added or in place of those of the same number.

        Nodes at which no line is left go.
        """
        gone = set(without)
        kept = {number: line for number, line in self.lines.items() if number not in gone} | dict(lines or {})
        used = {node for line in kept.values() for node in (line.start, line.end)}
        points = {node: point for node, point in {**self.nodes, **(nodes or {})}.items() if node in used}
        return Sketch(points, kept, (*self.removed, *told))

    def simplified(self, short_mm: float = 0.0) -> Sketch:
        """Two lines that meet at a node of their own are one; told where one of them is shorter than that."""
        sketch = self
        for node in sorted(self.nodes):
            arms = sketch.arms.get(node, [])
            if len(arms) != 2 or arms[0][0] == arms[1][0]:
                continue
            (one, at_end), (other, at_other_end) = arms
            first = sketch.lines[one] if at_end else sketch.lines[one].reversed()
            then = sketch.lines[other].reversed() if at_other_end else sketch.lines[other]
            curve = joined((first.curve, then.curve))
            both = Line(first.start, then.end, curve, first.origin | then.origin)
            least = min((first, then), key=lambda line: line.curve.length)
            told = (
                [least.told("merged", "it goes on in one other line")]
                if least.curve.length < short_mm
                else []
            )
            sketch = sketch.changed((one, other), {min(one, other): both}, told=told)
        return sketch

    def drawing(self, original: Drawing) -> tuple[Drawing, tuple[tuple[int, ...], ...]]:
        """The drawing, numbered as drawings are, in the original's frame; and each segment's origins."""
        numbers = sorted(self.lines)
        pieces = [
            Piece(line.start, line.end, line.curve) for line in (self.lines[number] for number in numbers)
        ]
        plain = Placement(1.0, np.zeros(2), False)
        made = assemble(dict(self.nodes), pieces, plain, width=None, changes=[], pixel_frame=False)
        origins = self._origins(made)
        return replace(
            made,
            stroke_width_mm=original.stroke_width_mm,
            pixel_frame=original.pixel_frame,
            removed=(*original.removed, *self.removed),
        ), origins

    def _origins(self, made: Drawing) -> tuple[tuple[int, ...], ...]:
        """Assembling turns lines round and numbers them anew: they are known again by their middles."""
        known = {_key(line.curve): tuple(sorted(line.origin)) for line in self.lines.values()}
        return tuple(known[_key(segment.curve)] for segment in made.segments)


def _key(curve: BezierChain) -> tuple[bytes, ...]:
    """The same for a curve and for the curve travelled backwards, another for any other."""
    there = (curve.points + 0.0).tobytes()
    back = (np.ascontiguousarray(curve.points[::-1, ::-1]) + 0.0).tobytes()
    return tuple(sorted((there, back)))


def heading(points: FloatArray) -> FloatArray:
    """The direction in which a chain of points leaves its start, over its first mm."""
    along = lengths(points)
    at = min(int(np.searchsorted(along, min(_LOOK_MM, along[-1] / 2))), len(points) - 1)
    step = points[max(at, 1)] - points[0]
    return np.asarray(step / max(float(np.hypot(*step)), 1e-12))
