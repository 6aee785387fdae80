"""The corners of a stroke: those apart, those in a crowd, and those that arcs hide."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.corners.apart import (
    CORNER,
    FAR,
    LEAST,
    Corner,
    arc,
    corner_between,
    corners_apart,
    off_line,
)
from wrapit.drawing.bitmap.corners.edge_fit import missed, turns
from wrapit.drawing.bitmap.corners.roundness import bend_radius
from wrapit.drawing.bitmap.corners.short_sides import chain_between, edge_points
from wrapit.drawing.bitmap.corners.turning import SEEN_RAD, crowds, kinks, parted, tops, turning
from wrapit.drawing.bitmap.corners.unexplained import CurvedChain, chain_around, curved_chains
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polynomials import angle

# In stroke widths.
# What is a corner between curved sides? They take over part of a bend's turn, so that it looks sharper: bends
# of 0.4 that turn by 145 degrees read as 0.24 and 0.3, true corners as 0.14 at most. On 80 strokes with two
# bends of 0.45 to 1 and as many with corners a third changes nothing.
_CURVED_CORNER = 0.22
# How far from the middle line is a corner between arcs? Inside of the ink. (With 0.7 fewer rows
# of arcs come out right.)
_INSIDE = 0.5
# How far around what two ways to tell corners differ in are they compared? (Not varied.)
_AROUND = 1.0


def find_corners(line: Line, ink: Ink, width_px: float, first: int, last: int) -> list[Corner]:
    """The corners of a line between two of its points, in walking order."""
    limits = first, last
    turn = turning(line, width_px, *limits)
    most = tops(line, turn, width_px)
    if not len(most):
        return []
    apart = corners_apart(line, ink, width_px, most, limits)
    stretches = parted(line, width_px, crowds(line, turn, most, width_px))
    groups = _crowded_groups(line, ink, stretches, apart)

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
    first, last = _differing(line, width_px, *found)
    edge = edge_points(ink, line.points[first : last + 1], width_px)
    return min(found, key=lambda corners: missed(_course(line, first, last, corners), edge, width_px).rms)


def _differing(line: Line, width_px: float, one: list[Corner], other: list[Corner]) -> tuple[int, int]:
    """First and last point of a stretch of a line in which are all corners that only one of two lists has."""
    known = [
        {(corner.before, corner.after, corner.points.tobytes()) for corner in each} for each in (one, other)
    ]
    lone = known[0] ^ known[1] or known[0]
    around = round(_AROUND * width_px * (len(line.points) - 1) / line.length)
    first = min(before for before, _, _ in lone) - around
    return max(first, 0), min(max(after for _, after, _ in lone) + around, len(line.points) - 1)


def _course(line: Line, first: int, last: int, corners: list[Corner]) -> FloatArray:
    """A stretch of a line (n, 2) with some corners, and the sides between them, instead of its own points."""
    parts, start = [], first
    for corner in corners:
        if corner.after < first or corner.before > last:
            continue
        parts += [line.points[start : corner.before]]
        parts += [side.points for side in (corner.side,) if side is not None]
        parts += [corner.points]
        parts += [side.points for side in (corner.last_side,) if side is not None]
        start = corner.after
    return np.concatenate([*parts, line.points[start : last + 1]])


def _hidden(
    line: Line,
    ink: Ink,
    width_px: float,
    limits: tuple[int, int],
    kinks: list[int],
    found: list[Corner],
) -> list[list[Corner]]:
    """The sharp corners, beside those found, between arcs that hide their turn."""
    around = round(LEAST * width_px * (len(line.points) - 1) / line.length)

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
        low = max(float(line.along[start]), place - FAR * width_px)
        high = min(float(line.along[end]), place + FAR * width_px)
        corner = corner_between(line, ink, width_px, place, low, high)
        if corner is not None and corner.sharp:
            apex, before, after = corner.points[0], corner.before - 1, corner.after
            if off_line(line, apex, before, after) < _INSIDE * width_px:
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
        before = chain.last if k else chain.first
        last = chain.side(k + 1) if k == len(curves.corners) - 3 else None
        points = apex[None]
        if radius is not None and not sharp and turned > SEEN_RAD:
            points = arc(apex, arriving, leaving, turned, radius * chain.width_px)
        found.append(Corner(points, before, chain.last, turned, sharp, chain.side(k), last, True))
    return found if any(corner.sharp and corner.turn_rad > SEEN_RAD for corner in found) else []


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
        sharp = radius is None or radius < CORNER
        points = (
            apex[None]
            if radius is None or sharp
            else arc(apex, arriving, leaving, turned, radius * chain.width_px)
        )
        before, side = (chain.last, chain.side(k)) if k else (chain.first, None)
        found.append(Corner(points, before, chain.last, turned, sharp, side, chained=True))
    return found if any(corner.sharp for corner in found) else []
