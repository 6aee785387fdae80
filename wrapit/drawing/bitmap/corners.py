"""Corners along a stroke: sharp ones become junctions, gentle ones only get their apex back."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import angle, crossing, polynomial

# In stroke widths.
# Which points tell the two sides of a corner? Those from 0.8 on, as nearer ones are rounded by the smoothing
# (1.04 loses short sides: Hausdorff distance 0.17 instead of 0.12 widths), over 1.8 at most, so that the side
# is a quadratic, and no farther than 4.5 from the corner; a side shorter than 0.45 tells no direction. The
# last two, varied by 30 %, change nothing.
_NEAR = 0.8
_SIDE = 1.8
_FAR = 4.5
_LEAST = 0.45
# Between which points is turning looked for? From 0.8 to 1.7 on either side: the chord over a width.
_PROBE = 1.7
# When are two places of most turning one corner? Where they are nearer than a width and a quarter.
_TWICE = 1.25
# A bend of a smaller radius can't be told from a corner, because the inner edge of the ink is one. With 0.49
# true corners become bends: Hausdorff distance 0.28.
_ROUND = 0.7
# When is a side straight? Where a straight line misses it by hardly more than a quadratic: 1.2 times, and a
# thousandth of a width.
_STRAIGHT = 1.2
_SLACK = 0.001
# What turn is worth a look? Less is the hand's; the config's own `corner_angle` is 60 degrees. 20 or 36
# change the Béziers by two in 242.
_SEEN_RAD = math.radians(28)


@dataclass(frozen=True, eq=False)
class Corner:
    """A corner at `apex`: the points before index `before` and from `after` on are the sides."""

    apex: FloatArray
    before: int
    after: int
    turn_rad: float


def find_corners(line: Line, width_px: float, first: int, last: int) -> list[Corner]:
    """The corners of a line between two of its points, in walking order."""
    low, high = line.along[first], line.along[last]
    found: list[Corner] = []
    candidates = _together(_candidates(line, width_px, low, high), _TWICE * width_px)
    for k, place in enumerate(candidates):
        start = max(low, candidates[k - 1] + _LEAST * width_px if k else low, place - _FAR * width_px)
        end = candidates[k + 1] - _LEAST * width_px if k + 1 < len(candidates) else high
        end = min(high, end, place + _FAR * width_px)
        corner = _corner(line, width_px, place, start, end)
        if corner is not None and (not found or corner.before > found[-1].after):
            found.append(corner)
    return found


def _candidates(line: Line, width_px: float, low: float, high: float) -> list[float]:
    """Lengths along the line where it turns most."""
    # The points are evenly spaced, so lengths are counts.
    along = line.along
    step = max(line.length / (len(along) - 1), 1e-6)
    near, far = max(1, round(_NEAR * width_px / step)), max(2, round(_PROBE * width_px / step))
    inner = np.flatnonzero((along >= low + 1.25 * width_px) & (along <= high - 1.25 * width_px))
    if not len(inner):
        return []
    first, last = np.searchsorted(along, [low, high])

    def at(shift: int) -> FloatArray:
        return line.points[np.clip(inner + shift, first, min(last, len(along) - 1))]

    before, after = at(-near) - at(-far), at(far) - at(near)
    turn = np.abs(
        np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    )
    if turn.max() <= _SEEN_RAD:
        return []
    reach = max(1, int(width_px / step))
    padded = np.pad(turn, reach)
    peak = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    tops = inner[(turn == peak) & (turn > _SEEN_RAD)]
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


def _corner(line: Line, width_px: float, place: float, start: float, end: float) -> Corner | None:
    along = line.along - place
    near = min(_NEAR * width_px, 0.6 * (place - start), 0.6 * (end - place))
    sides = []
    for side in ((along >= start - place) & (along <= -near), (along >= near) & (along <= end - place)):
        chosen = np.flatnonzero(side & line.clean)
        # The nearest clean stretch; at an acute tip it begins far from the apex.
        if len(chosen):
            chosen = chosen[np.abs(along[chosen]) <= np.abs(along[chosen]).min() + _SIDE * width_px]
        if len(chosen) < 4 or np.ptp(along[chosen]) < _LEAST * width_px:
            return None
        sides.append((chosen, _side(along[chosen], line.points[chosen], width_px)))
    met = crossing(sides[0][1], sides[1][1], _FAR * width_px, 0.05 * width_px)
    if met is None:
        return None
    apex, arriving, leaving = met
    turn = angle(arriving, leaving)
    off = float(np.linalg.norm(line.points - apex, axis=1).min())
    sharpness = width_px * (1 / max(math.cos(turn / 2), 0.05) - 1)
    if turn < _SEEN_RAD or off > 1.5 * width_px or off > _ROUND * sharpness + 0.05 * width_px:
        return None
    return Corner(apex, int(sides[0][0][-1]) + 1, int(sides[1][0][0]), turn)


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


def split_corners(graph: StrandGraph, lines: dict[int, Line], width_px: float, corner_rad: float) -> None:
    """Makes a node of each corner sharper than `corner_rad`; gentler ones become points of their line."""
    for strand in list(graph.strands):
        s = graph.strands[strand]
        closed = graph.is_seam(s.start)
        line = lines[strand]
        if closed:
            line = lines[strand] = line.turned(_flattest(line, width_px))
            graph.nodes[s.start] = line.points[0]
            first, last = 0, len(line.points) - 1
        else:
            first = arm(line, strand, 0, width_px).cut
            last = len(line.points) - 1 - arm(line, strand, 1, width_px).cut
        if last - first < 8:
            continue
        corners = find_corners(line, width_px, first, last)
        if corners:
            _split(graph, lines, strand, corners, corner_rad)


def _split(
    graph: StrandGraph, lines: dict[int, Line], strand: int, corners: list[Corner], corner_rad: float
) -> None:
    s, line = graph.strands[strand], lines[strand]
    parts: list[tuple[list[slice | FloatArray], FloatArray]] = []
    stretch: list[slice | FloatArray] = []
    start = 0
    for corner in corners:
        stretch.append(slice(start, corner.before))
        start = corner.after
        if corner.turn_rad >= corner_rad:
            parts.append((stretch, corner.apex))
            stretch = []
        else:
            stretch.append(corner.apex)
    stretch.append(slice(start, len(line.points)))
    nodes = [s.start, *(graph.add_node(apex) for _, apex in parts), s.end]
    graph.corners |= set(nodes[1:-1])
    pieces = [_joined(line, items) for items in [*(items for items, _ in parts), stretch]]
    if graph.is_seam(s.start) and len(pieces) > 1:
        # A closed loop with corners needs its seam no longer.
        pieces[0] = _after(pieces.pop(), pieces[0])
        nodes[0] = nodes[-2]
        del nodes[-1]
    graph.drop_strand(strand)
    del lines[strand]
    for piece, start_node, end_node in zip(pieces, nodes[:-1], nodes[1:], strict=True):
        lines[graph.add_strand(start_node, end_node, piece.points)] = piece
    graph.drop_lonely()


def _joined(line: Line, items: list[slice | FloatArray]) -> Line:
    """A line from stretches of another, with the apexes of gentle corners between them."""
    points, width, clean = [], [], []
    for item in items:
        if isinstance(item, slice):
            points.append(line.points[item])
            width.append(line.width[item])
            clean.append(line.clean[item])
        else:
            points.append(item[None])
            width.append(np.array([np.nan]))
            clean.append(np.array([True]))
    chain = np.concatenate(points)
    return Line(chain, np.concatenate(width), np.concatenate(clean), lengths(chain))


def _after(first: Line, second: Line) -> Line:
    chain = np.concatenate([first.points, second.points[1:]])
    return Line(
        chain,
        np.concatenate([first.width, second.width[1:]]),
        np.concatenate([first.clean, second.clean[1:]]),
        lengths(chain),
    )


def _flattest(line: Line, width_px: float) -> int:
    """The point of a closed line around which it turns least."""
    ring = line.points[:-1]
    reach = max(1, min(int(2 * width_px / max(line.length / len(ring), 1e-6)), len(ring) // 3))
    before, after = ring - np.roll(ring, reach, axis=0), np.roll(ring, -reach, axis=0) - ring
    turn = np.abs(
        np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    )
    return int(np.argmin(np.round(turn, 6)))
