"""Corners with room around them: the two sides of each, the apex they point at, and how round it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.corners.edge_fit import missed
from wrapit.drawing.bitmap.corners.roundness import bend_radius
from wrapit.drawing.bitmap.corners.short_sides import edge_points
from wrapit.drawing.bitmap.corners.turning import SEEN_RAD
from wrapit.drawing.bitmap.hard_edges.pixels import needs_longer_look
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polynomials import angle, crossing, polynomial

# In stroke widths.
# Which points tell the two sides of a corner? Those from 0.8 on, as nearer ones are rounded by the smoothing
# (1.04 loses short sides: Hausdorff distance 0.17 instead of 0.12 widths), over 1.8 at most, so that the side
# is a quadratic, and no farther than 4.5 from the corner; a side shorter than 0.45 tells no direction. The
# last two, varied by 30 %, change nothing.
_NEAR = 0.8
_SIDE = 1.8
FAR = 4.5
LEAST = 0.45
# And on hard edges? With 1.8 four of 26 thresholded drawings get another graph than the smooth ones, with 2.6
# four others, with 2.2 one.
_HARD_SIDE = 2.2
# When are two places of most turning one corner? Where they are nearer than a width and a quarter.
_TWICE = 1.25
# How far beside the place of most turning may a corner lie? Between two with a short side that place is the
# side's middle: a corner found farther off is looked for once more where it is. 0.35 and 0.65 change nothing.
# On hard edges stairs would decide which fits better: 23 of 26 thresholded drawings come out right, not 25.
_BESIDE = 0.5
# What may be a corner? A bend that is no rounder by its middle line; its outer edge decides. With 0.49 true
# corners are not even looked at: Hausdorff distance 0.28.
_ROUND = 0.7
# When is it one? Where the radius by the outer edge is less. On grey edges, radii of 0.2 and of 0.4 are told
# apart in 97 of 100 bends; 0.3 loses a tenth more corners, and no round bend less.
CORNER = 1 / 3
# When is a side straight? Where a straight line misses it by hardly more than a quadratic: 1.2 times, and a
# thousandth of a width.
_STRAIGHT = 1.2
_SLACK = 0.001


@dataclass(frozen=True, eq=False)
class Corner:
    """A corner or tight bend: the points before index `before` and from `after` on are its sides.

    `points` (n, 2) lie between them: the apex alone where it is `sharp`, else an arc. Where corners stand
    close together a `side` leads to it, and a `last_side` away from it, instead of the line's own points; it
    is `chained` where a chain of sides that explains the ink gave its place.
    """

    points: FloatArray
    before: int
    after: int
    turn_rad: float
    sharp: bool
    side: Line | None = None
    last_side: Line | None = None
    chained: bool = False


def corners_apart(
    line: Line, ink: Ink, width_px: float, tops: NDArray[np.intp], limits: tuple[int, int]
) -> list[Corner]:
    """The corners where a line turns most, each from its own two sides."""
    found: list[Corner] = []
    low, high = line.along[limits[0]], line.along[limits[1]]
    candidates = _together(_places(line, tops, width_px), _TWICE * width_px)
    for k, place in enumerate(candidates):
        start = max(low, candidates[k - 1] + LEAST * width_px if k else low, place - FAR * width_px)
        end = candidates[k + 1] - LEAST * width_px if k + 1 < len(candidates) else high
        end = min(high, end, place + FAR * width_px)
        corner = corner_between(line, ink, width_px, place, start, end)
        if corner is not None and corner.sharp and ink.stair_px == 0:
            foot = _foot(line, corner)
            if abs(foot - place) > _BESIDE * width_px:
                again = corner_between(line, ink, width_px, foot, start, end)
                corner = corner if again is None else _better(line, ink, width_px, corner, again)
        if corner is not None and (not found or corner.before > found[-1].after):
            found.append(corner)
    return found


def _places(line: Line, tops: NDArray[np.intp], width_px: float) -> list[float]:
    """Lengths along the line at the middles of what is disturbed where it turns most."""
    places: list[float] = []
    for top in tops:
        place = _disturbed_middle(line, int(top), 0.4 * width_px)
        if not places or place - places[-1] > width_px:
            places.append(place)
    return places


def _together(places: list[float], apart: float) -> list[float]:
    """One place in the middle of two that are too near to be two corners: one corner seen from both sides."""
    single: list[float] = []
    for place in places:
        if single and place - single[-1] < apart:
            single[-1] = (single[-1] + place) / 2
        else:
            single.append(place)
    return single


def _disturbed_middle(line: Line, at: int, least: float) -> float:
    """Length at the middle of the disturbed stretch around a point, whose own shape means nothing."""
    first = last = at
    while first > 0 and not line.clean[first - 1 : first + 1].all():
        first -= 1
    while last < len(line.clean) - 1 and not line.clean[last : last + 2].all():
        last += 1
    if line.along[last] - line.along[first] < least:
        return float(line.along[at])
    return float(line.along[first] + line.along[last]) / 2


def corner_between(
    line: Line, ink: Ink, width_px: float, place: float, start: float, end: float
) -> Corner | None:
    along = line.along - place
    near = min(_NEAR * width_px, 0.6 * (place - start), 0.6 * (end - place))
    sides = []
    reach = (_HARD_SIDE if needs_longer_look(ink, width_px) else _SIDE) * width_px
    for side in ((along >= start - place) & (along <= -near), (along >= near) & (along <= end - place)):
        chosen = np.flatnonzero(side & line.clean)
        # The nearest clean stretch; at an acute tip it begins far from the apex.
        if len(chosen):
            chosen = chosen[np.abs(along[chosen]) <= np.abs(along[chosen]).min() + reach]
        if len(chosen) < 4 or np.ptp(along[chosen]) < LEAST * width_px:
            return None
        sides.append((chosen, _side(along[chosen], line.points[chosen], width_px)))
    met = crossing(sides[0][1], sides[1][1], FAR * width_px, 0.05 * width_px)
    if met is None:
        return None
    apex, arriving, leaving = met
    turn = angle(arriving, leaving)
    off = off_line(line, apex, sides[0][0][-1], sides[1][0][0])
    sharpness = width_px * (1 / max(math.cos(turn / 2), 0.05) - 1)
    if turn < SEEN_RAD or off > 1.5 * width_px or off > _ROUND * sharpness + 0.05 * width_px:
        return None
    before, after = int(sides[0][0][-1]) + 1, int(sides[1][0][0])
    usual = float(np.median(np.concatenate([line.width[chosen] for chosen, _ in sides])))
    radius = bend_radius(ink, apex, arriving, leaving, turn, usual)
    if radius is None or radius < CORNER:
        return Corner(apex[None], before, after, turn, True)
    bend = arc(apex, arriving, leaving, turn, radius * usual)
    # The sides may reach into the arc.
    between = ((bend - line.points[before - 1]) @ arriving > 0) & ((line.points[after] - bend) @ leaving > 0)
    return Corner(bend[between], before, after, turn, False) if between.any() else None


def _foot(line: Line, corner: Corner) -> float:
    """Length at the point of a line nearest to the apex of a corner."""
    away = np.linalg.norm(line.points[corner.before - 1 : corner.after + 1] - corner.points[0], axis=1)
    return float(line.along[corner.before - 1 + int(np.argmin(away))])


def _better(line: Line, ink: Ink, width_px: float, one: Corner, other: Corner) -> Corner:
    """The corner that misses the ink's edges by less."""
    around = round(FAR / 3 * width_px * (len(line.points) - 1) / line.length)
    first = max(min(one.before, other.before) - around, 0)
    last = min(max(one.after, other.after) + around, len(line.points) - 1)
    edge = edge_points(ink, line.points[first : last + 1], width_px)

    def misses(corner: Corner) -> float:
        parts = line.points[first : corner.before], corner.points, line.points[corner.after : last + 1]
        return missed(np.concatenate(parts), edge, width_px).rms

    return min(one, other, key=misses)


def off_line(line: Line, apex: FloatArray, first: int, last: int) -> float:
    """How far an apex is from the nearest point of a line between two of its points."""
    return float(np.linalg.norm(line.points[first : last + 1] - apex, axis=1).min())


def arc(
    apex: FloatArray, arriving: FloatArray, leaving: FloatArray, turn_rad: float, radius_px: float
) -> FloatArray:
    """Points on the arc of a radius that touches both sides of a corner."""
    outwards, across = unit(arriving - leaving), unit(arriving + leaving)
    turned = np.linspace(-turn_rad / 2, turn_rad / 2, 7)[:, None]
    centre = apex - outwards * (radius_px / math.cos(turn_rad / 2))
    return centre + radius_px * (np.cos(turned) * outwards + np.sin(turned) * across)


def _side(along: FloatArray, points: FloatArray, width_px: float) -> FloatArray:
    """Coefficients of a side: a straight line where a quadratic, which errs more ahead, fits no better."""
    straight = polynomial(along, points, 1)
    if np.ptp(along) <= 1.2 * width_px:
        return straight
    curved = polynomial(along, points, 2)
    missed = [
        float(np.sqrt(((along[:, None] ** np.arange(len(model)) @ model - points) ** 2).sum(axis=1).mean()))
        for model in (straight, curved)
    ]
    return straight if missed[0] < _STRAIGHT * missed[1] + _SLACK * width_px else curved
