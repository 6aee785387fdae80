"""A trail as sections between its hairpins, each of them one shifted line."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.beside.ramps import Level, shift_of
from wrapit.wires.beside.shifting import Course, shifted
from wrapit.wires.centreline import Corner, Joined, join

# How finely a place near a point is looked for, before Newton's method finds it.
STEP_MM = 0.1
# How closely bends are looked at, as those of whole wires are (`stage.py`).
LOOK_MM = 0.02
# A run that keeps less than this of the radius of its line, or turns back on itself, can't be laid beside it.
LEAST_ROOM = 0.15


@dataclass(frozen=True, eq=False)
class Item:
    """A single segment or one run of a stretch, as the wire runs along it; `shift_mm` is to its left.

    `joints` (n - 1, 2) are where its n segments meet, and `corners` what was rounded between them, each with
    its place.
    """

    curve: BezierChain
    segments: tuple[int, ...]
    double: bool
    shift_mm: float
    joints: FloatArray
    corners: tuple[tuple[Corner, FloatArray], ...] = ()


@dataclass(frozen=True, eq=False)
class Laid:
    """A section as it lies; `tight` are doubled segments that can't be laid side by side."""

    joined: Joined
    tight: frozenset[int]


def laid_section(items: Sequence[Item], radius_mm: float, least_mm: float, held: tuple[bool, bool]) -> Laid:
    """The items joined into one line and shifted; ramps bend by no less than the radius.

    Bent more tightly than `least_mm` a run lies in itself. `held` says for both ends whether the wire ends
    there; a hairpin follows where not.
    """
    line = join([item.curve for item in items], radius_mm, held, _bends_mm(items, radius_mm))
    levels = [
        Level(start, end, item.shift_mm, item.double)
        for item, (start, end) in zip(items, line.spans_mm, strict=True)
    ]
    course = Course(line.chain, shift_of(levels, radius_mm))
    bounds_mm = [0.0]
    corners = list(line.corners)
    for item, (start, end) in zip(items, line.spans_mm, strict=True):
        inner = [_nearest(course.lengths, point, start, end) for point in item.joints]
        # Where a corner used up more than a segment of the stretch, nothing of that is left.
        bounds_mm += [*np.maximum.accumulate(inner).tolist(), end]
        for corner, point in item.corners:
            corners.append(dataclasses.replace(corner, at_mm=_nearest(course.lengths, point, start, end)))
    # What was cut and joined tells its length to 1e-5 mm; the wire ends where the line does.
    bounds_mm[-1] = float(course.reach[-1])
    segments = [segment if item.double else -1 for item in items for segment in item.segments]
    tight = _tight(course, segments, bounds_mm, least_mm)
    if tight:
        return Laid(line, tight)
    moved = shifted(course, bounds_mm)
    spans = itertools.pairwise(moved.places_mm(np.array(bounds_mm)).tolist())
    return Laid(
        Joined(
            moved.chain,
            tuple((float(a), float(b)) for a, b in spans),
            tuple(
                _moved(corner, course, float(moved.places_mm(np.array([corner.at_mm]))[0]))
                for corner in sorted(corners, key=lambda corner: corner.at_mm)
            ),
        ),
        frozenset(),
    )


def _bends_mm(items: Sequence[Item], radius_mm: float) -> list[float]:
    """Radii of the bends between each two items: wider by the shift but on the outside of both of them.

    On the outside of one, the ramp beside it needs what that has to spare.
    """
    asked_mm = []
    for before, after in itertools.pairwise(items):
        arriving, leaving = before.curve.end_tangent, after.curve.start_tangent
        left = math.copysign(1.0, arriving[0] * leaving[1] - arriving[1] * leaving[0])
        outside = left * before.shift_mm < 0 and left * after.shift_mm < 0
        aside_mm = 0.0 if outside else max(abs(before.shift_mm), abs(after.shift_mm))
        asked_mm.append(radius_mm + aside_mm)
    return asked_mm


def _moved(corner: Corner, course: Course, at_mm: float) -> Corner:
    """A corner of the line as one of the run beside it; its radius is then measured, and no longer known."""
    aside_mm = abs(float(course.shifts(np.array([corner.at_mm]))[0][0]))
    radius_mm = math.inf if aside_mm else corner.radius_mm
    return Corner(at_mm, corner.bend_rad, radius_mm, corner.deviation_mm + aside_mm)


def _tight(
    course: Course, segments: Sequence[int], bounds_mm: Sequence[float], least_mm: float
) -> frozenset[int]:
    """Of the segments (-1 for single ones), the doubled ones nearest to where a shift leaves no room."""
    at_mm = course.lengths.stations(LOOK_MM)
    middle_mm = (at_mm[:-1] + at_mm[1:]) / 2
    room, bend = course.room(middle_mm), np.abs(course.curvature(middle_mm))
    # Only where it is the shift that bends a run too tightly.
    wrong = middle_mm[(room < LEAST_ROOM) | ((room < least_mm * bend) & (least_mm * bend < 1) & (room < 1))]
    spans = [
        (segment, span)
        for segment, span in zip(segments, itertools.pairwise(bounds_mm), strict=True)
        if segment >= 0
    ]
    return frozenset(
        min(spans, key=lambda each: max(each[1][0] - place, place - each[1][1]))[0] for place in wrong
    )


def _nearest(course: ArcLength, point: FloatArray, start_mm: float, end_mm: float) -> float:
    """The place between two of a line that is nearest to a point: the best of many, and Newton's method."""
    at_mm = np.linspace(start_mm, end_mm, max(3, math.ceil((end_mm - start_mm) / STEP_MM)))
    apart = course.spline.at(course.parameter(at_mm)) - point
    best = at_mm[[int((apart**2).sum(axis=1).argmin())]]
    for _ in range(3):
        u = course.parameter(best)
        ahead = unit(course.spline.derivative(u)[0])
        best = np.clip(best + float((point - course.spline.at(u)[0]) @ ahead), start_mm, end_mm)
    return float(best[0])
