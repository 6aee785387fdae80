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
    pieces = _aligned([piece for group in split for piece in group])
    asked_mm = [min_radius_mm] * (len(pieces) - 1)
    for end, radius in zip(itertools.accumulate(map(len, split)), between_mm or (), strict=False):
        asked_mm[end - 1] = radius
    room_mm = [MAX_TRIM * piece.length for piece in pieces]
    for end, piece in ((0, pieces[0]), (-1, pieces[-1])):
        if not held[end] and len(pieces) > 1:
            room_mm[end] = END_TRIM * piece.length
    blends = [
        _blend(before, after, min(rooms), radius)
        for (before, after), rooms, radius in zip(
            itertools.pairwise(pieces), itertools.pairwise(room_mm), asked_mm, strict=True
        )
    ]
    trims = [blend.trim_mm for blend in blends]
    chain: list[BezierChain] = []
    joints_mm, at_mm = [0.0], 0.0
    for piece, head, tail, blend in itertools.zip_longest(pieces, [0.0, *trims], [*trims, 0.0], blends):
        chain.append(_trimmed(piece, head, tail))
        at_mm += chain[-1].length
        if blend is not None:
            half = sum(curve.length for curve in blend.curves) / 2
            joints_mm.append(at_mm + half)
            chain += blend.curves
            at_mm += 2 * half
    corners = tuple(
        Corner(joint_mm, bend_rad(*pair), blend.radius_mm, blend.deviation_mm)
        for joint_mm, pair, blend in zip(joints_mm[1:], itertools.pairwise(pieces), blends, strict=True)
        if blend.curves
    )
    bounds_mm = [*joints_mm, at_mm]
    firsts = itertools.accumulate((len(group) for group in split), initial=0)
    spans_mm = tuple(itertools.pairwise(bounds_mm[first] for first in firsts))
    return _relaxed(Joined(_connected(chain), spans_mm, corners), min_radius_mm)


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
