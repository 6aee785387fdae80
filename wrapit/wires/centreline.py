"""Joins the segments of a trail into one smooth chain; corners are rounded to what the metal allows."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, from_chain, unit
from wrapit.geometry.arclength import ArcLength, cut
from wrapit.wires.fairing import faired
from wrapit.wires.rounding import NO_BLEND, Blend, best_blend

# What is rounded, how far, and what isn't. On three of our drawings a third more or less of the first three
# moves no wire; they bound what strange drawings may ask for.
SMOOTH_BEND_RAD = 1e-4  # smaller bends are noise: turning the handles moves the curve by less than a micron
RELAX_RADII = 4.0  # how far beyond a tight span a wire may leave the drawing to widen it
MAX_TRIM = 0.45  # share of a segment that one corner may use up
END_TRIM = 0.95  # and of one that has no other corner, as a hairpin follows
FOLD_RAD = math.radians(175)  # a wire laid back over itself is folded, not rounded
# The tightest hairpin that a tip becomes, in bends that the metal takes: half of that of soft wire is half of
# its thickness, and tighter its sides would lie in each other.
HAIRPIN_SHARE = 0.5
# A side so short between two corners, or behind the last one, has no room for a bend (a blend is twice as
# long): the two are one, and the line ends with the corner. Of 500 such wires, with sides of a hundredth of a
# micrometre to two millimetres, one in four had no sound solid; with 0.05, 0.15 and 0.25 all have one.
SLIVER_MM = 0.15
# That is so where the sides around have room, in slivers. Many short sides in a row are a curve.
_AROUND = 4.0
TIP_RAD = math.radians(150)  # straight sides would be cut by 3.7 bends here, curved ones by far less


@dataclass(frozen=True)
class Corner:
    """A rounded bend."""

    at_mm: float
    bend_rad: float
    radius_mm: float
    deviation_mm: float


@dataclass(frozen=True, eq=False)
class Joined:
    """One chain for a whole trail; `spans_mm[i]` is where traversal i runs along it."""

    chain: BezierChain
    spans_mm: tuple[tuple[float, float], ...]
    corners: tuple[Corner, ...]


def join(
    curves: Sequence[BezierChain],
    min_radius_mm: float,
    held: tuple[bool, bool] = (True, True),
    between_mm: Sequence[float] | None = None,
) -> Joined:
    """One chain, G1 but at folds; bends become arcs of `min_radius_mm` where there is room.

    Each curve starts where the one before ends. Kinks inside a curve are rounded like those between curves.
    `between_mm` are the radii of bends between two curves, where these aren't the same. `held` says for both
    ends whether the line ends there: where it goes on straight, one bend may use up almost all of the last
    curve.
    """
    split = [_split_at_kinks(faired(curve, min_radius_mm)) for curve in curves]
    pieces = _from_start(_to_end(_aligned([piece for group in split for piece in group])))
    ends = list(itertools.accumulate(map(len, split)))
    asked_mm = [min_radius_mm] * (len(pieces) - 1)
    for end, radius in zip(ends, between_mm or (), strict=False):
        asked_mm[end - 1] = radius
    bends = [bend_rad(*pair) for pair in itertools.pairwise(pieces)]
    sharp = _corners([piece.length for piece in pieces], bends)
    # A corner's sides go on where others only cross them: beside a crossing a bend has room too.
    sides = [_connected(pieces[a:b]) for a, b in itertools.pairwise([0, *sharp, len(pieces)])]
    room_mm = [MAX_TRIM * side.length for side in sides]
    for end, side in ((0, sides[0]), (-1, sides[-1])):
        if not held[end] and len(sides) > 1:
            room_mm[end] = END_TRIM * side.length
    blends = [
        _blend(before, after, min(rooms), asked_mm[joint - 1])
        for (before, after), rooms, joint in zip(
            itertools.pairwise(sides), itertools.pairwise(room_mm), sharp, strict=True
        )
    ]
    # Places along the pieces as drawn, and where they come to lie: a corner in the middle of its bend.
    drawn_mm = np.cumsum([0.0, *(piece.length for piece in pieces)])
    places_mm = [(0.0, 0.0)]
    chain: list[BezierChain] = []
    corners: list[Corner] = []
    at_mm = head = 0.0
    for side, joint, blend in itertools.zip_longest(sides, sharp, blends):
        tail = blend.trim_mm if blend else 0.0
        chain.append(_trimmed(side, head, tail))
        at_mm += chain[-1].length
        if blend is not None:
            half = sum(curve.length for curve in blend.curves) / 2
            corner_mm = float(drawn_mm[joint])
            places_mm += [
                (corner_mm - tail, at_mm),
                (corner_mm, at_mm + half),
                (corner_mm + tail, at_mm + 2 * half),
            ]
            if blend.curves:
                chain += blend.curves
                corners.append(Corner(at_mm + half, bends[joint - 1], blend.radius_mm, blend.deviation_mm))
            at_mm += 2 * half
            head = tail
    places_mm.append((float(drawn_mm[-1]), at_mm))
    bounds_mm = np.interp(drawn_mm[[0, *ends]], *np.transpose(places_mm)).tolist()
    spans_mm = tuple(itertools.pairwise(bounds_mm))
    joined = Joined(_connected(chain), spans_mm, tuple(corners))
    return _relaxed(joined, min_radius_mm)


def bend_rad(before: BezierChain, after: BezierChain) -> float:
    """Angle in [0, π] by which the direction changes where `after` follows `before`."""
    return _turning(before.end_tangent, after.start_tangent)


def _turning(arriving: FloatArray, leaving: FloatArray) -> float:
    cross = arriving[0] * leaving[1] - arriving[1] * leaving[0]
    return abs(math.atan2(float(cross), float(arriving @ leaving)))


def _split_at_kinks(curve: BezierChain) -> list[BezierChain]:
    cubics = [BezierChain(points[None]) for points in curve.points]
    kinks = [
        index + 1
        for index, pair in enumerate(itertools.pairwise(cubics))
        if bend_rad(*pair) >= SMOOTH_BEND_RAD
    ]
    return [BezierChain(curve.points[a:b]) for a, b in itertools.pairwise([0, *kinks, len(curve)])]


def _to_end(pieces: list[BezierChain]) -> list[BezierChain]:
    """The pieces with a last one that is no sliver behind a corner: the one before leads to its end."""
    if len(pieces) < 2 or not pieces[-1].length < SLIVER_MM <= pieces[-2].length / _AROUND:
        return pieces
    if bend_rad(*pieces[-2:]) < SMOOTH_BEND_RAD:
        return pieces
    points = pieces[-2].points.copy()
    points[-1, 2:] += pieces[-1].end - points[-1, 3]
    bent = BezierChain(points)
    return [*pieces[:-2], *cut(bent, bent.length - SLIVER_MM)]


def _from_start(pieces: list[BezierChain]) -> list[BezierChain]:
    """The same for the first one."""
    return [piece.reversed() for piece in _to_end([piece.reversed() for piece in pieces[::-1]])[::-1]]


def _corners(lengths_mm: Sequence[float], bends: Sequence[float]) -> list[int]:
    """The joints that are corners, each by the piece after it; of two with a sliver between, the sharper."""
    joints = [joint for joint, bend in enumerate(bends, 1) if bend >= SMOOTH_BEND_RAD]
    ends_mm = [0.0, *itertools.accumulate(lengths_mm)]
    while True:
        bounds = [0, *joints, len(lengths_mm)]
        sides_mm = [ends_mm[b] - ends_mm[a] for a, b in itertools.pairwise(bounds)]
        weaker = [
            min(bounds[i : i + 2], key=lambda joint: bends[joint - 1])
            for i in range(1, len(sides_mm) - 1)
            if sides_mm[i] < SLIVER_MM <= min(sides_mm[i - 1], sides_mm[i + 1]) / _AROUND
            and max(bends[joint - 1] for joint in bounds[i : i + 2]) <= FOLD_RAD
        ]
        if not weaker:
            return joints
        joints.remove(weaker[0])


def _aligned(curves: Sequence[BezierChain]) -> list[BezierChain]:
    """The curves with handles turned to one direction wherever they differ by noise only."""
    points = np.concatenate([curve.points for curve in curves])
    cubics = [BezierChain(cubic[None]) for cubic in points]
    for index, (before, after) in enumerate(itertools.pairwise(cubics)):
        if bend_rad(before, after) < SMOOTH_BEND_RAD:
            direction = unit(before.end_tangent + after.start_tangent)
            at = before.end
            points[index, 2] = at - direction * np.linalg.norm(at - points[index, 2])
            points[index + 1, 1] = at + direction * np.linalg.norm(points[index + 1, 1] - at)
    firsts = itertools.accumulate((len(curve) for curve in curves), initial=0)
    return [BezierChain(points[a:b]) for a, b in itertools.pairwise(firsts)]


def _blend(before: BezierChain, after: BezierChain, room_mm: float, min_radius_mm: float) -> Blend:
    bend = bend_rad(before, after)
    if bend < SMOOTH_BEND_RAD:
        return NO_BLEND
    if bend > FOLD_RAD:
        return _hairpin(before, after, room_mm, min_radius_mm)
    blend = best_blend(before, after, min_radius_mm * math.tan(bend / 2), room_mm, min_radius_mm)
    if bend > TIP_RAD:
        # Sides that curve away from each other have room for the bend long before straight ones would.
        hairpin = _hairpin(before, after, room_mm, min_radius_mm)
        enough = hairpin.radius_mm >= 0.999 * min(min_radius_mm, blend.radius_mm)
        return hairpin if hairpin.curves and enough and hairpin.deviation_mm < blend.deviation_mm else blend
    return blend


def _hairpin(before: BezierChain, after: BezierChain, room_mm: float, min_radius_mm: float) -> Blend:
    """A tip whose sides part becomes a hairpin; where they don't, the wire stays laid back over itself."""
    blend = best_blend(before, after, 0.0, room_mm, min_radius_mm)
    least_mm = HAIRPIN_SHARE * min_radius_mm
    if not blend.curves or blend.radius_mm < least_mm:
        return NO_BLEND
    apart_mm = float(np.linalg.norm(blend.curves[-1].end - blend.curves[0].start))
    return blend if apart_mm >= 2 * least_mm else NO_BLEND


def _relaxed(joined: Joined, min_radius_mm: float) -> Joined:
    """Spans that bend more tightly than the metal allows are widened, where a short stretch is enough."""
    for start_mm, end_mm in reversed(_tight_spans(joined.chain, min_radius_mm)):
        middle, half = (start_mm + end_mm) / 2, (end_mm - start_mm) / 2
        room = min(middle, joined.chain.length - middle, half + RELAX_RADII * min_radius_mm) - 1e-3
        if room <= half:
            continue
        before, after = cut(joined.chain, middle)
        blend = best_blend(before, after, half + 0.05, room, min_radius_mm)
        if blend.curves and blend.radius_mm >= 0.999 * min_radius_mm and blend.deviation_mm <= min_radius_mm:
            joined = _replaced(joined, middle, before, after, blend)
    return joined


def _tight_spans(chain: BezierChain, min_radius_mm: float) -> list[tuple[float, float]]:
    """Where the curvature is beyond the metal's, joined where they are nearer than that radius."""
    lengths = ArcLength(from_chain(chain))
    at_mm = lengths.stations(0.02)
    middle_mm = (at_mm[:-1] + at_mm[1:]) / 2
    tight = np.abs(lengths.spline.curvature(lengths.parameter(middle_mm))) > 1.01 / min_radius_mm
    spans: list[tuple[float, float]] = []
    for a, b in np.flatnonzero(np.diff(np.r_[False, tight, False])).reshape(-1, 2):
        start, end = float(at_mm[a]), float(at_mm[b])
        if spans and start - spans[-1][1] < min_radius_mm:
            spans[-1] = (spans[-1][0], end)
        else:
            spans.append((start, end))
    return spans


def _replaced(
    joined: Joined, middle_mm: float, before: BezierChain, after: BezierChain, blend: Blend
) -> Joined:
    low, high = middle_mm - blend.trim_mm, middle_mm + blend.trim_mm
    new_mm = sum(curve.length for curve in blend.curves)

    def moved(at_mm: float) -> float:
        return (
            float(np.interp(at_mm, [low, high], [low, low + new_mm]))
            + max(0.0, at_mm - high)
            - max(0.0, low - at_mm)
        )

    chain = [_trimmed(before, 0.0, blend.trim_mm), *blend.curves, _trimmed(after, blend.trim_mm, 0.0)]
    corners = [dataclasses.replace(corner, at_mm=moved(corner.at_mm)) for corner in joined.corners]
    bend = _turning(chain[0].end_tangent, chain[-1].start_tangent)
    corners.append(Corner(low + new_mm / 2, bend, blend.radius_mm, blend.deviation_mm))
    spans = tuple((moved(start), moved(end)) for start, end in joined.spans_mm)
    return Joined(_connected(chain), spans, tuple(sorted(corners, key=lambda corner: corner.at_mm)))


def _trimmed(piece: BezierChain, head: float, tail: float) -> BezierChain:
    if tail > 0:
        piece = cut(piece, piece.length - tail)[0]
    return cut(piece, head)[1] if head > 0 else piece


def _connected(chain: Sequence[BezierChain]) -> BezierChain:
    """One chain; ends that differ by rounding are made the same."""
    points = np.concatenate([curve.points for curve in chain])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)
