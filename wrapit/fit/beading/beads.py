"""Small round loops of a sketch become beads, and the lines that come to them run through."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.faces import Face
from wrapit.fit.model import Bead, Limits
from wrapit.fit.sketch import STEP_MM, Arm, Line, Sketch
from wrapit.geometry import BezierChain, FloatArray, joined, straight
from wrapit.geometry.disjoint_sets import Sets

# Largest circle inside over smallest circle round it: an oval of 4 : 3 still reads as a bead, a square (0.71)
# or an eye's almond doesn't.
ROUND: Final = 0.75
# Beads that shops have for wire of these thicknesses, in mm; they come in half millimetres.
SMALLEST_MM: Final = 2.0
LARGEST_MM: Final = 10.0
STEP_OF_SIZES_MM: Final = 0.5
# A loop of more than half the drawing's length is its shape, not its ornament.
_SHARE_OF_DRAWING = 0.5
# Mirrored loops, traced from one picture, differ by up to a pixel or two: 0.1 mm at 40 mm and 800 px. Loops
# as alike as that are of one size, and all of them beads or none.
ALIKE_MM = 0.1
_ALIKE_ROUND = 0.03
# A loop of more lines has more than two neighbours, or corners: no bead.
_LINES = 3
# A bead's hole is straight. Two lines that come from within 60° of opposite sides can be led through it; two
# that pass beside it bend by no more than that.
_STRAIGHT = np.cos(np.radians(60.0))
# Wire beyond the last bead, so that the jig has room for the wire's start hole beside the bead's seat: hole
# (wire + 0.5 mm, 2 mm at least), clearance of 0.2 mm and 0.5 mm of plate between.
_BEYOND_MM = 2.0
_BEYOND_WIRES = 0.5


@dataclass(frozen=True, eq=False)
class _Loop:
    """A closed loop about `middle` (2,), and the nodes on it from which other lines leave, each with them."""

    lines: frozenset[int]
    middle: FloatArray
    diameter_mm: float
    roundness: float
    ways: Mapping[int, tuple[Arm, ...]]


def beaded(
    sketch: Sketch,
    limits: Limits,
    kept: Iterable[int] = (),
    places: Iterable[tuple[float, float]] = (),
) -> tuple[Sketch, tuple[Bead, ...]]:
    """The sketch without small round loops, lines led on through their middles; and the beads there.

    A bead's `segment` is the number of the line that runs through it. Segments of the original that are
    `kept` stay lines; a loop about one of `places`, where something was drawn that is no line, is no bead.
    """
    loops = _loops(sketch, frozenset(kept), list(places))
    beads = []
    for loop, size_mm in zip(loops, _sizes(loops), strict=True):
        if size_mm is not None:
            sketch, middle = _led_through(sketch, loop, size_mm, limits)
            beads.append(Bead(middle, size_mm))
    curves = {number: line.curve for number, line in sketch.lines.items()}
    return sketch, tuple(replace(bead, segment=passing(bead.at, curves)) for bead in beads)


def passing(at: FloatArray, curves: Mapping[int, BezierChain]) -> int:
    """Which curve comes nearest to a place (2,), the first of several. Raises ValueError without any."""
    return min(
        curves, key=lambda number: (round(_distance_mm(curves[number].sampled(STEP_MM), at), 3), number)
    )


def size_of(diameter_mm: float) -> float | None:
    """The bead that can be bought nearest to a diameter; None where there is none of that size."""
    size_mm = STEP_OF_SIZES_MM * round(diameter_mm / STEP_OF_SIZES_MM)
    return size_mm if SMALLEST_MM <= size_mm <= LARGEST_MM else None


def alike(pairs: Sequence[tuple[float, float]], within: tuple[float, float]) -> list[list[int]]:
    """Indices of pairs of numbers in groups: those that are as near to another of the group in both.

    >>> alike([(3.0, 1.0), (5.0, 1.0), (3.1, 1.0)], (0.2, 0.1))
    [[0, 2], [1]]
    """
    sets = Sets()
    for (i, one), (j, other) in itertools.combinations(enumerate(pairs), 2):
        if all(abs(a - b) <= most for a, b, most in zip(one, other, within, strict=True)):
            sets.merge(i, j)
    groups: dict[int, list[int]] = {}
    for index in range(len(pairs)):
        groups.setdefault(sets.find(index), []).append(index)
    return list(groups.values())


def _distance_mm(points: FloatArray, at: FloatArray) -> float:
    import shapely

    return float(shapely.LineString(points).distance(shapely.Point(at)))


def _loops(sketch: Sketch, kept: frozenset[int], places: Sequence[tuple[float, float]]) -> list[_Loop]:
    """Loops that a bead may take the place of, whatever their size and roundness; they share no lines."""
    import shapely

    points = {number: line.curve.sampled(STEP_MM) for number, line in sketch.lines.items()}
    every = np.concatenate(list(points.values()))
    largest_mm = _SHARE_OF_DRAWING * float(np.ptp(every, axis=0).max())
    # The inner places of lines, and what else was drawn: none of them lies in a bead.
    drawn = [*(each[len(each) // 2] for each in points.values()), *places]
    inner = shapely.points(np.array(drawn))
    found = []
    for face in sketch.faces.faces:
        loop = _loop(sketch, face)
        if loop is None or loop.diameter_mm > largest_mm:
            continue
        if any(sketch.lines[number].origin & kept for number in loop.lines):
            continue
        if not shapely.contains(face.polygon.buffer(-STEP_MM / 2), inner).any():
            found.append(loop)
    shared = {number for one, other in itertools.combinations(found, 2) for number in one.lines & other.lines}
    return [loop for loop in found if not loop.lines & shared]


def _loop(sketch: Sketch, face: Face) -> _Loop | None:
    """A face as a loop that lines can be led through; None where it isn't one."""
    import shapely

    if len(face.lines) > _LINES or len(face.polygon.interiors):
        return None
    ways: dict[int, tuple[Arm, ...]] = {}
    for node in sorted({end for n in face.lines for end in (sketch.lines[n].start, sketch.lines[n].end)}):
        arms = sketch.arms[node]
        others = tuple(arm for arm in arms if arm[0] not in face.lines)
        if len(arms) - len(others) != 2:
            return None
        if others:
            ways[node] = others
    middle = np.array(face.polygon.centroid.coords[0])
    if not _can_be_led(sketch, middle, ways):
        return None
    around_mm = 2 * float(shapely.minimum_bounding_radius(face.polygon))
    diameter_mm = 2 * float(np.sqrt(face.polygon.area / np.pi))
    return _Loop(face.lines, middle, diameter_mm, face.inside_mm / around_mm, ways)


def _can_be_led(sketch: Sketch, middle: FloatArray, ways: Mapping[int, tuple[Arm, ...]]) -> bool:
    """Whether one line comes to a loop, or two from opposite sides, or one passes it."""
    counts = [len(arms) for arms in ways.values()]
    if counts == [1]:
        return True
    if counts == [2]:
        (arms,) = ways.values()
        one, other = (sketch.leaving(arm).start_tangent for arm in arms)
        return float(-one @ other) >= _STRAIGHT
    if counts == [1, 1]:
        one, other = (_unit(sketch.nodes[node] - middle) for node in ways)
        return float(-one @ other) >= _STRAIGHT
    return False


def _sizes(loops: Sequence[_Loop]) -> list[float | None]:
    """The bead for each loop, None where it is too large, too small, or not round; alike for loops alike."""
    sizes: list[float | None] = [None] * len(loops)
    for group in alike([(loop.diameter_mm, loop.roundness) for loop in loops], (ALIKE_MM, _ALIKE_ROUND)):
        if np.mean([loops[index].roundness for index in group]) >= ROUND:
            size_mm = size_of(float(np.mean([loops[index].diameter_mm for index in group])))
            for index in group:
                sizes[index] = size_mm
    return sizes


def _led_through(sketch: Sketch, loop: _Loop, size_mm: float, limits: Limits) -> tuple[Sketch, FloatArray]:
    """The sketch without a loop, and where its bead's middle is."""
    length_mm = sum(sketch.lines[number].curve.length for number in loop.lines)
    nodes = list(loop.ways)
    passed = len(sketch.arms[nodes[0]]) > 3
    middle = sketch.nodes[nodes[0]] if passed else loop.middle
    told = Removal(
        "bead",
        (float(middle[0]), float(middle[1])),
        length_mm,
        f"becomes a bead of {size_mm:g} mm; drawn {loop.diameter_mm:.2f} mm",
    )
    number = min(loop.lines)
    if passed:
        return _joined_at(sketch.changed(loop.lines, told=[told]), nodes[0]), middle
    if len(nodes) == 2:
        through, more = _between(sketch, nodes, middle, loop), {}
        line = Line(nodes[0], nodes[1], through, frozenset())
    else:
        end = max(sketch.nodes) + 1
        through = _beyond(sketch, nodes[0], middle, size_mm, limits, loop)
        line, more = Line(nodes[0], end, through, frozenset()), {end: through.end}
    sketch = sketch.changed(loop.lines, {number: line}, more, [told])
    for node in nodes:
        sketch = _joined_at(sketch, node)
    return sketch, middle


def _between(sketch: Sketch, nodes: Sequence[int], middle: FloatArray, loop: _Loop) -> BezierChain:
    """From one node over the bead's middle to the other, smooth with the lines that come there."""
    start, end = (sketch.nodes[node] for node in nodes)
    arriving, leaving = _arriving(sketch, loop, nodes[0]), -_arriving(sketch, loop, nodes[1])
    through = _unit(end - start)
    return BezierChain(
        np.array([_smooth(start, arriving, middle, through), _smooth(middle, through, end, leaving)])
    )


def _beyond(
    sketch: Sketch, node: int, middle: FloatArray, size_mm: float, limits: Limits, loop: _Loop
) -> BezierChain:
    """From a node over the bead's middle to its other side, and on for what holds it there."""
    start = sketch.nodes[node]
    through = _unit(middle - start)
    end = middle + (size_mm / 2 + _BEYOND_MM + _BEYOND_WIRES * limits.diameter_mm) * through
    first = _smooth(start, _arriving(sketch, loop, node), middle, through)
    return joined((BezierChain(first[None]), straight(middle, end)))


def _arriving(sketch: Sketch, loop: _Loop, node: int) -> FloatArray:
    """Direction (2,) in which the other line comes to a loop."""
    (arm,) = (arm for arm in sketch.arms[node] if arm[0] not in loop.lines)
    return -sketch.leaving(arm).start_tangent


def _smooth(start: FloatArray, leaving: FloatArray, end: FloatArray, arriving: FloatArray) -> FloatArray:
    """A cubic (4, 2) with these ends and directions."""
    reach = float(np.linalg.norm(end - start)) / 3
    return np.array([start, start + reach * leaving, end - reach * arriving, end])


def _joined_at(sketch: Sketch, node: int) -> Sketch:
    """The sketch with the two lines that end at a node as one; a line that comes back to it stays."""
    (one, at_end), (other, at_other_end) = sketch.arms[node]
    if one == other:
        return sketch
    first = sketch.lines[one] if at_end else sketch.lines[one].reversed()
    then = sketch.lines[other].reversed() if at_other_end else sketch.lines[other]
    both = Line(first.start, then.end, joined((first.curve, then.curve)), first.origin | then.origin)
    return sketch.changed((one, other), {min(one, other): both})


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(vector / np.linalg.norm(vector))
