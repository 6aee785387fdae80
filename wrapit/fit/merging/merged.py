"""Two nodes become one, and what met there follows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.fit.merging.leading import Led, led_points
from wrapit.fit.merging.planarity import crossed, is_planar
from wrapit.fit.merging.straightness import straight_on, straightest
from wrapit.fit.sketch import STEP_MM, Arm, Line, Sketch
from wrapit.geometry import BezierChain, FloatArray, joined
from wrapit.geometry.arclength import piece
from wrapit.geometry.polyline import lengths

# A ring is so many wire diameters long at least: round the narrowest post of a jig.
_RING: Final = 7.0
# So near to a node (mm) only curves tell whether lines cross, not the points that they are fitted to: of 578
# short lines generated 10 are quoted otherwise than they merge, 16 with 0.05, 12 with 0.13, 8 with 0.3.
_QUOTED_MM: Final = 0.2


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


@dataclass(frozen=True, eq=False)
class Quote:
    """What a merger would move and lose, as `Merger` tells it."""

    moved: Mapping[int, float]
    lost: bool


@dataclass(frozen=True, eq=False)
class _Plan:
    """How two nodes would become one at a place: the lines that are led there, or grow up to it."""

    at: FloatArray
    node: int
    lines: Mapping[int, Line | Led]
    moved: Mapping[int, float]
    lost: bool


def merged(sketch: Sketch, number: int, blur_mm: float, near: FloatArray | None = None) -> Merger | None:
    """The two ends of a line become one node; None where lines would cross or coincide for that.

    A line that runs on straight through the short one stays as it is, and what ends on it slides along it.
    Where none does, both ends come to the middle. With `near` the node is as near to that place (2,) as the
    line goes. A place that moves by `blur_mm` counts as moved, less by the square.
    """
    for plan in _plans(sketch, number, blur_mm, near):
        lines = {n: each.fitted() if isinstance(each, Led) else each for n, each in plan.lines.items()}
        result = sketch.changed((number,), lines, {plan.node: plan.at})
        if is_planar(result, lines, sketch):
            return Merger(result, plan.at, plan.moved, plan.lost)
    return None


def quoted(sketch: Sketch, number: int, blur_mm: float) -> Quote | None:
    """What `merged` would say, from the points that lines would go through: no curve is fitted."""
    for plan in _plans(sketch, number, blur_mm, None):
        lines = {n: line for n, line in sketch.lines.items() if n != number} | dict(plan.lines)
        if not crossed(lines, {**sketch.nodes, plan.node: plan.at}, plan.lines, sketch, _QUOTED_MM):
            return Quote(plan.moved, plan.lost)
    return None


def _plans(sketch: Sketch, number: int, blur_mm: float, near: FloatArray | None) -> Iterator[_Plan]:
    """The ways in which a line's nodes may become one, the best first."""
    line = sketch.lines[number]
    if line.is_ring or _runs_beside(sketch, number, blur_mm):
        return
    before, after = straight_on(sketch, (number, False)), straight_on(sketch, (number, True))
    yield _at_best(sketch, number, before, after, blur_mm, near)
    if before is not None and after is not None and before[0] == after[0]:
        # A ring of two lines: what runs along the short one beside it goes straight on as well.
        ways = [_beside(sketch, (number, last), before[0]) for last in (False, True)]
        yield _at_best(sketch, number, ways[0], ways[1], blur_mm, near)


def _beside(sketch: Sketch, arm: Arm, other: int) -> Arm | None:
    """The straightest arm that isn't of another line."""
    line = sketch.lines[arm[0]]
    arms = sketch.arms[line.end if arm[1] else line.start]
    return straightest(sketch, arm, [each for each in arms if each != arm and each[0] != other])


def _at_best(
    sketch: Sketch,
    number: int,
    before: Arm | None,
    after: Arm | None,
    blur_mm: float,
    near: FloatArray | None,
) -> _Plan:
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
) -> _Plan:
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


def _moved(sketch: Sketch, number: int, at: FloatArray, grown: dict[int, Line], blur_mm: float) -> _Plan:
    """The line goes; arms at its ends are led to `at`, but those that have grown up to it."""
    gone = sketch.lines[number]
    ends = {gone.start, gone.end}
    node = min(ends)
    moved: dict[int, float] = {}
    lines: dict[int, Line | Led] = {}
    for other in sorted({arm[0] for end in ends for arm in sketch.arms[end]} - {number}):
        old = sketch.lines[other]
        line = grown.get(other, old)
        curve = line.curve
        first, last = (
            at if each in ends else own for each, own in ((old.start, curve.start), (old.end, curve.end))
        )
        start, end = (node if each in ends else each for each in (old.start, old.end))
        if np.array_equal(first, curve.start) and np.array_equal(last, curve.end):
            lines[other] = Line(start, end, curve, line.origin)
        else:
            stroke, moved[other] = led_points(curve, first, last, blur_mm)
            lines[other] = Led(start, end, stroke, line.origin)
    return _Plan(at, node, lines, moved, not grown)


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


def _runs_beside(sketch: Sketch, number: int, blur_mm: float) -> bool:
    """Whether a short line joins the same two nodes: merging them would leave it a ring without room."""
    line = sketch.lines[number]
    ends = {line.start, line.end}
    return any(
        {other.start, other.end} == ends and other.curve.length < _RING * blur_mm
        for n, other in sketch.lines.items()
        if n != number
    )
