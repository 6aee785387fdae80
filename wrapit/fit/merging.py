"""Two nodes become one, and what met there follows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.fit.sketch import STEP_MM, Arm, Line, Sketch
from wrapit.geometry import BezierChain, FloatArray, joined
from wrapit.geometry.arclength import piece
from wrapit.geometry.fitting.fit import Stroke, fit
from wrapit.geometry.polyline import lengths

# A line goes straight on into another where it turns by less than this (rad): as crossings are told apart.
_STRAIGHT: Final = math.radians(40)
# A moved end draws its line along: all of a line so short (in shifts), so many shifts of a longer one.
_WHOLE, _REACH = 10.0, 6.0
# Moved lines are fitted within this (mm), a tenth of what a hand can bend to.
_TOLERANCE_MM: Final = 0.02
# A ring is so many wire diameters long at least: round the narrowest post of a jig.
_RING: Final = 7.0
# Lines that meet at a node may touch this near to it (mm).
_NODE_MM: Final = 0.05


@dataclass(frozen=True, eq=False)
class Merger:
    """A sketch in which a short line's two nodes are one, where that is, and what moved for it.

    `moved` are numbers of lines with how many mm of each are no longer where they were, `lost` says whether
    the short line itself is in none of them.
    """

    sketch: Sketch
    at: FloatArray
    moved: Mapping[int, float]
    lost: bool


def merged(sketch: Sketch, number: int, blur_mm: float, near: FloatArray | None = None) -> Merger | None:
    """The two ends of a line become one node; None where lines would cross or coincide for that.

    A line that runs on straight through the short one stays as it is, and what ends on it slides along it.
    Where none does, both ends come to the middle. With `near` the node is as near to that place (2,) as the
    line goes. A place that moves by `blur_mm` counts as moved, less by the square.
    """
    line = sketch.lines[number]
    if line.is_ring or _runs_beside(sketch, number, blur_mm):
        return None
    before, after = straight_on(sketch, (number, False)), straight_on(sketch, (number, True))
    result = _at_best(sketch, number, before, after, blur_mm, near)
    if result is None and before is not None and after is not None and before[0] == after[0]:
        # A ring of two lines: what runs along the short one beside it goes straight on as well.
        ways = [_beside(sketch, (number, last), before[0]) for last in (False, True)]
        return _at_best(sketch, number, ways[0], ways[1], blur_mm, near)
    return result


def _beside(sketch: Sketch, arm: Arm, other: int) -> Arm | None:
    """The straightest arm that isn't of another line."""
    line = sketch.lines[arm[0]]
    arms = sketch.arms[line.end if arm[1] else line.start]
    return _straightest(sketch, arm, [each for each in arms if each != arm and each[0] != other])


def _at_best(
    sketch: Sketch,
    number: int,
    before: Arm | None,
    after: Arm | None,
    blur_mm: float,
    near: FloatArray | None,
) -> Merger | None:
    """The two ends of a line as one node, given the arms into which it goes straight on."""
    line = sketch.lines[number]
    cut_mm = line.curve.length / 2
    if near is not None:
        points = line.curve.sampled(STEP_MM)
        nearest = int(np.argmin(((points - near) ** 2).sum(axis=1)))
        cut_mm = min(float(lengths(points)[nearest]), line.curve.length)
        if nearest == len(points) - 1:
            cut_mm = line.curve.length
    elif (before is None) != (after is None):
        cut_mm = line.curve.length if after is None else 0.0
    if before is None and after is None:
        at = (line.curve.start + line.curve.end) / 2 if near is None else _at(line.curve, cut_mm)
        return _moved(sketch, number, at, {}, blur_mm)
    return _slid(sketch, number, before, after, cut_mm, blur_mm)


def _slid(
    sketch: Sketch, number: int, before: Arm | None, after: Arm | None, cut_mm: float, blur_mm: float
) -> Merger | None:
    line = sketch.lines[number]
    at = _at(line.curve, cut_mm)
    backwards = line.curve.reversed()
    node = min(line.start, line.end)
    grown: dict[int, Line] = {}
    for arm, part in (
        (before, piece(line.curve, 0.0, cut_mm) if cut_mm > 0 else None),
        (after, piece(backwards, 0.0, line.curve.length - cut_mm) if cut_mm < line.curve.length else None),
    ):
        if arm is not None and part is not None:
            # The same line at both ends is a ring with the short one.
            whole = grown.get(arm[0], sketch.lines[arm[0]])
            grown[arm[0]] = _lengthened(whole, part, node, line.origin, at, last=arm[1])
    return _moved(sketch, number, at, grown, blur_mm)


def _moved(
    sketch: Sketch, number: int, at: FloatArray, grown: dict[int, Line], blur_mm: float
) -> Merger | None:
    """The sketch without the line; arms at its ends are led to `at`, but those that have grown up to it."""
    gone = sketch.lines[number]
    ends = {gone.start, gone.end}
    node = min(ends)
    moved: dict[int, float] = {}
    lines: dict[int, Line] = {}
    for other in sorted({arm[0] for end in ends for arm in sketch.arms[end]} - {number}):
        old = sketch.lines[other]
        line = grown.get(other, old)
        targets = []
        for node_there, own in ((old.start, line.curve.start), (old.end, line.curve.end)):
            targets.append(at if node_there in ends else own)
        start, end = (node if each in ends else each for each in (old.start, old.end))
        curve = line.curve
        if not (np.array_equal(targets[0], curve.start) and np.array_equal(targets[1], curve.end)):
            curve, moved[other] = led(curve, targets[0], targets[1], blur_mm)
        lines[other] = Line(start, end, curve, line.origin)
    result = sketch.changed((number,), lines, {node: at})
    if not is_planar(result, lines, sketch):
        return None
    return Merger(result, at, moved, not grown)


def led(curve: BezierChain, start: FloatArray, end: FloatArray, blur_mm: float) -> tuple[BezierChain, float]:
    """The curve led to other ends, all between by less the farther away it is; straight lines stay straight.

    And how many mm of it have moved, as for `merged`.
    """
    first, last = start - curve.start, end - curve.end
    points = curve.sampled(STEP_MM)
    along = lengths(points)
    shift = _fading(along, first)[:, None] * first + _fading(along[-1] - along, last)[:, None] * last
    moved = points + shift
    moved[0], moved[-1] = start, end
    leaving = _direction(moved) if first.any() else curve.start_tangent
    arriving = -_direction(moved[::-1]) if last.any() else curve.end_tangent
    lost = np.minimum(1.0, (shift * shift).sum(axis=1) / blur_mm**2)
    return fit(Stroke(moved, leaving, arriving), _TOLERANCE_MM), float(np.trapezoid(lost, along))


def _fading(along: FloatArray, shift: FloatArray) -> FloatArray:
    """What share of a shift at length 0 a place at some length follows: straight lines stay straight."""
    size, whole = float(np.hypot(*shift)), max(float(along.max()), 1e-12)
    if whole <= _WHOLE * size:
        return np.asarray(1 - along / whole)
    share = np.clip(1 - along / max(_REACH * size, 1e-9), 0, 1)
    return np.asarray(share * share * (3 - 2 * share))


def _direction(points: FloatArray) -> FloatArray:
    step = points[min(2, len(points) - 1)] - points[0]
    return np.asarray(step / max(float(np.hypot(*step)), 1e-12))


def _at(curve: BezierChain, at_mm: float) -> FloatArray:
    if at_mm <= 0:
        return curve.start
    return curve.end if at_mm >= curve.length else piece(curve, 0.0, at_mm).end


def _lengthened(
    line: Line, part: BezierChain, node: int, origin: frozenset[int], at: FloatArray, *, last: bool
) -> Line:
    """A line, going on over part of the short one; `part` runs from the line's end to the new node."""
    if last:
        points = joined((line.curve, part)).points.copy()
        points[-1, 3] = at
        return Line(line.start, node, BezierChain(points), line.origin | origin)
    points = joined((part.reversed(), line.curve)).points.copy()
    points[0, 0] = at
    return Line(node, line.end, BezierChain(points), line.origin | origin)


def straight_on(sketch: Sketch, arm: Arm) -> Arm | None:
    """The arm at the same node that goes straight on from one, if they are one another's straightest."""
    node = sketch.lines[arm[0]].end if arm[1] else sketch.lines[arm[0]].start
    arms = [other for other in sketch.arms[node] if other != arm]
    best = _straightest(sketch, arm, arms)
    if best is None or _straightest(sketch, best, [o for o in sketch.arms[node] if o != best]) != arm:
        return None
    return best


def _straightest(sketch: Sketch, arm: Arm, others: list[Arm]) -> Arm | None:
    own = sketch.heading(arm)
    turns = [(math.acos(float(np.clip(-own @ sketch.heading(o), -1, 1))), o) for o in others]
    turns = [each for each in turns if each[0] < _STRAIGHT]
    return min(turns)[1] if turns else None


def _runs_beside(sketch: Sketch, number: int, blur_mm: float) -> bool:
    """Whether a short line joins the same two nodes: merging them would leave it a ring without room."""
    line = sketch.lines[number]
    ends = {line.start, line.end}
    return any(
        {other.start, other.end} == ends and other.curve.length < _RING * blur_mm
        for n, other in sketch.lines.items()
        if n != number
    )


def is_planar(sketch: Sketch, lines: Mapping[int, Line], before: Sketch) -> bool:
    """Whether lines that are new since `before` cross neither themselves nor any line but at their nodes.

    What crossed before may cross still: not every drawing that is read is planar to the last micron.
    """
    numbers, tree = before.places
    for number, line in lines.items():
        if not line.shape.is_simple and (number not in before.lines or before.lines[number].shape.is_simple):
            return False
        near = {numbers[index] for index in tree.query(line.shape).tolist()} | set(lines)
        if any(
            _meet_elsewhere(sketch, number, other) and not _met_before(before, number, other)
            for other in sorted(near)
            if other != number and other in sketch.lines
        ):
            return False
    return True


def _met_before(before: Sketch, one: int, other: int) -> bool:
    return one in before.lines and other in before.lines and _meet_elsewhere(before, one, other)


def _meet_elsewhere(sketch: Sketch, one: int, other: int) -> bool:
    import shapely

    first, second = sketch.lines[one], sketch.lines[other]
    both = shapely.intersection(first.shape, second.shape)
    if both.is_empty:
        return False
    shared = {first.start, first.end} & {second.start, second.end}
    near = shapely.union_all([shapely.Point(sketch.nodes[node]).buffer(_NODE_MM) for node in shared])
    return not bool(shapely.is_empty(shapely.difference(both, near)))
