"""Where a stroke turns: the sides of each corner, the apex they point at, and how round it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.corners.edge_fit import missed, turns
from wrapit.drawing.bitmap.corners.roundness import bend_radius
from wrapit.drawing.bitmap.corners.short_sides import chain_between, edge_points
from wrapit.drawing.bitmap.corners.turning import SEEN_RAD, crowds, kinks, parted, tops, turning
from wrapit.drawing.bitmap.corners.unexplained import CurvedChain, chain_around, curved_chains
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
# And on hard edges? With 1.8 four of 26 thresholded drawings get another graph than the smooth ones, with 2.6
# four others, with 2.2 one.
_HARD_SIDE = 2.2
_FAR = 4.5
_LEAST = 0.45
# When are two places of most turning one corner? Where they are nearer than a width and a quarter.
_TWICE = 1.25
# What may be a corner? A bend that is no rounder by its middle line; its outer edge decides. With 0.49 true
# corners are not even looked at: Hausdorff distance 0.28.
_ROUND = 0.7
# When is it one? Where the radius by the outer edge is less. On grey edges, radii of 0.2 and of 0.4 are told
# apart in 97 of 100 bends; 0.3 loses a tenth more corners, and no round bend less.
_CORNER = 1 / 3
# And between curved sides? They take over part of a bend's turn, so that it looks sharper: bends of 0.4 that
# turn by 145 degrees read as 0.24 and 0.3, true corners as 0.14 at most. On 80 strokes with two bends of 0.45
# to 1 and as many with corners a third changes nothing.
_CURVED_CORNER = 0.22
# How far from the middle line is a corner between arcs? Inside of the ink.
_INSIDE = 0.5
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


def find_corners(line: Line, ink: Ink, width_px: float, first: int, last: int) -> list[Corner]:
    """The corners of a line between two of its points, in walking order."""
    low, high = line.along[first], line.along[last]
    turn = turning(line, width_px, first, last)
    most = tops(line, turn, width_px)
    if not len(most):
        return []
    apart = _apart(line, ink, width_px, _places(line, most, width_px), low, high)
    stretches = parted(line, width_px, crowds(line, turn, most, width_px))
    groups = _crowded_groups(line, ink, stretches, apart)
    limits = first, last

    def with_curves(known: list[list[Corner]]) -> list[list[Corner]]:
        found = _in_order(known, apart)
        return [*known, *_between_curves(line, ink, width_px, stretches, limits, most, known, found)]

    seen = kinks(line, width_px, *limits)
    told = [with_curves(groups)]
    if seen:
        # Which tells more, chains of curved sides or what is between arcs at first? Either hides the other.
        told[0] += _hidden(line, ink, width_px, limits, seen, _in_order(told[0], apart))
        if hidden := _hidden(line, ink, width_px, limits, seen, _in_order(groups, apart)):
            told.append(with_curves([*groups, *hidden]))
    found = [_in_order(known, apart) for known in told]
    if len(found) == 1:
        return found[0]
    return min(found, key=lambda corners: _missed(line, ink, width_px, limits, corners))


def _missed(line: Line, ink: Ink, width_px: float, limits: tuple[int, int], corners: list[Corner]) -> float:
    """By how much a line with some corners misses the ink's edges (root mean square, in stroke widths)."""
    parts, start = [], limits[0]
    for corner in corners:
        parts += [line.points[start : corner.before]]
        parts += [side.points for side in (corner.side,) if side is not None]
        parts += [corner.points]
        parts += [side.points for side in (corner.last_side,) if side is not None]
        start = corner.after
    course = np.concatenate([*parts, line.points[start : limits[1] + 1]])
    edge = edge_points(ink, line.points[limits[0] : limits[1] + 1], width_px)
    return missed(course, edge, width_px).rms


def _hidden(
    line: Line,
    ink: Ink,
    width_px: float,
    limits: tuple[int, int],
    kinks: list[int],
    found: list[Corner],
) -> list[list[Corner]]:
    """The sharp corners, beside those found, between arcs that hide their turn."""
    around = round(_LEAST * width_px * (len(line.points) - 1) / line.length)

    def tells(corner: Corner, kink: int) -> bool:
        """Whether a corner found is the one at a kink: one beside it took an arc's turn for its own."""
        at = corner.before - around <= kink <= corner.after + around
        off = np.linalg.norm(corner.points - line.points[kink], axis=1).min()
        return at and (corner.chained or bool(off < _INSIDE * width_px))

    places = [kink for kink in kinks if not any(tells(corner, kink) for corner in found)]
    spans = [
        (corner.before, corner.after)
        for corner in found
        if not any(corner.before - around <= kink <= corner.after + around for kink in places)
    ]
    hidden = []
    for kink in places:
        others = [*((other, other) for other in places), *spans]
        start = max([limits[0], *(after for _, after in others if after < kink)])
        end = min([limits[1], *(before for before, _ in others if before > kink)])
        middle = (
            (start + kink) // 2 if start in places else start,
            (end + kink) // 2 if end in places else end,
        )
        chain = chain_around(line, ink, width_px, kink, middle)
        corners = _of_curves(ink, chain) if chain else []
        if corners and corners[0].sharp:
            hidden.append(corners)
            continue
        place = float(line.along[kink])
        low = max(float(line.along[start]), place - _FAR * width_px)
        high = min(float(line.along[end]), place + _FAR * width_px)
        corner = _corner(line, ink, width_px, place, low, high)
        if corner is not None and corner.sharp:
            apex, before, after = corner.points[0], corner.before - 1, corner.after
            if _off(line, apex, before, after) < _INSIDE * width_px:
                hidden.append([corner])
    return hidden


def _between_curves(
    line: Line,
    ink: Ink,
    width_px: float,
    stretches: list[tuple[int, int]],
    limits: tuple[int, int],
    tops: NDArray[np.intp],
    groups: list[list[Corner]],
    found: list[Corner],
) -> list[list[Corner]]:
    """The corners of each place that only a chain of curved sides explains."""
    spans = [(corner.before, corner.after, corner.points) for corner in found]
    taken = [(group[0].before, group[-1].after) for group in groups]
    chains = curved_chains(line, ink, width_px, stretches, limits, tops, spans, taken)
    return [group for chain in chains if (group := _of_curves(ink, chain))]


def _of_curves(ink: Ink, chain: CurvedChain) -> list[Corner]:
    """The corners between curved sides; none where one of them is a round bend, or none turns by enough."""
    found: list[Corner] = []
    curves = chain.curves
    for k, apex in enumerate(curves.corners[1:-1]):
        arriving, leaving = curves.arriving[k], curves.leaving[k + 1]
        turned = angle(arriving, leaving)
        radius = bend_radius(ink, apex, arriving, leaving, turned, chain.width_px)
        sharp = radius is None or radius < _CURVED_CORNER
        if not sharp and turned > SEEN_RAD:
            return []
        before = chain.last if k else chain.first
        last = chain.side(k + 1) if k == len(curves.corners) - 3 else None
        found.append(Corner(apex[None], before, chain.last, turned, sharp, chain.side(k), last, True))
    return found if any(corner.turn_rad > SEEN_RAD for corner in found) else []


def _crowded_groups(
    line: Line, ink: Ink, stretches: list[tuple[int, int]], apart: list[Corner]
) -> list[list[Corner]]:
    """The corners of each crowd that a chain of straight sides explains."""
    groups: list[list[Corner]] = []
    for low, high in stretches:
        known = [corner for corner in apart if low <= (corner.before + corner.after) / 2 <= high]
        together = _crowded(line, ink, low, high, known)
        if together:
            groups.append(together)
    return groups


def _in_order(groups: list[list[Corner]], apart: list[Corner]) -> list[Corner]:
    """All corners in walking order: those found together, and where there are none those found apart."""
    spans = [(group[0].before, group[-1].after) for group in groups]
    free = [c for c in apart if not any(start <= c.after and c.before <= end for start, end in spans)]
    found: list[Corner] = []
    for group in sorted([*groups, *([c] for c in free)], key=lambda group: group[0].before):
        if not found or group[0].before >= found[-1].after:
            found += group
    return found


def _crowded(line: Line, ink: Ink, start: int, end: int, known: list[Corner]) -> list[Corner]:
    """Corners with short sides between them; none where those `known` explain the ink as well."""
    chain = chain_between(line, ink, start, end, [corner.points for corner in known])
    if chain is None:
        return []
    courses, turn = unit(np.diff(chain.points, axis=0)), turns(chain.points)
    found: list[Corner] = []
    for k, apex in enumerate(chain.points[1:-1]):
        arriving, leaving, turned = courses[k], courses[k + 1], float(turn[k])
        radius = bend_radius(ink, apex, arriving, leaving, turned, chain.width_px)
        sharp = radius is None or radius < _CORNER
        points = (
            apex[None]
            if radius is None or sharp
            else _arc(apex, arriving, leaving, turned, radius * chain.width_px)
        )
        before, side = (chain.last, chain.side(k)) if k else (chain.first, None)
        found.append(Corner(points, before, chain.last, turned, sharp, side, chained=True))
    return found if any(corner.sharp for corner in found) else []


def _apart(
    line: Line, ink: Ink, width_px: float, crowd: list[float], low: float, high: float
) -> list[Corner]:
    """The corners near some places, each from its own two sides."""
    found: list[Corner] = []
    candidates = _together(crowd, _TWICE * width_px)
    for k, place in enumerate(candidates):
        start = max(low, candidates[k - 1] + _LEAST * width_px if k else low, place - _FAR * width_px)
        end = candidates[k + 1] - _LEAST * width_px if k + 1 < len(candidates) else high
        end = min(high, end, place + _FAR * width_px)
        corner = _corner(line, ink, width_px, place, start, end)
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


def _corner(line: Line, ink: Ink, width_px: float, place: float, start: float, end: float) -> Corner | None:
    along = line.along - place
    near = min(_NEAR * width_px, 0.6 * (place - start), 0.6 * (end - place))
    sides = []
    reach = (_HARD_SIDE if needs_longer_look(ink, width_px) else _SIDE) * width_px
    for side in ((along >= start - place) & (along <= -near), (along >= near) & (along <= end - place)):
        chosen = np.flatnonzero(side & line.clean)
        # The nearest clean stretch; at an acute tip it begins far from the apex.
        if len(chosen):
            chosen = chosen[np.abs(along[chosen]) <= np.abs(along[chosen]).min() + reach]
        if len(chosen) < 4 or np.ptp(along[chosen]) < _LEAST * width_px:
            return None
        sides.append((chosen, _side(along[chosen], line.points[chosen], width_px)))
    met = crossing(sides[0][1], sides[1][1], _FAR * width_px, 0.05 * width_px)
    if met is None:
        return None
    apex, arriving, leaving = met
    turn = angle(arriving, leaving)
    off = _off(line, apex, sides[0][0][-1], sides[1][0][0])
    sharpness = width_px * (1 / max(math.cos(turn / 2), 0.05) - 1)
    if turn < SEEN_RAD or off > 1.5 * width_px or off > _ROUND * sharpness + 0.05 * width_px:
        return None
    before, after = int(sides[0][0][-1]) + 1, int(sides[1][0][0])
    usual = float(np.median(np.concatenate([line.width[chosen] for chosen, _ in sides])))
    radius = bend_radius(ink, apex, arriving, leaving, turn, usual)
    if radius is None or radius < _CORNER:
        return Corner(apex[None], before, after, turn, True)
    bend = _arc(apex, arriving, leaving, turn, radius * usual)
    # The sides may reach into the arc.
    between = ((bend - line.points[before - 1]) @ arriving > 0) & ((line.points[after] - bend) @ leaving > 0)
    return Corner(bend[between], before, after, turn, False) if between.any() else None


def _off(line: Line, apex: FloatArray, first: int, last: int) -> float:
    """How far an apex is from the nearest point of a line between two of its points."""
    return float(np.linalg.norm(line.points[first : last + 1] - apex, axis=1).min())


def _arc(
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
