"""Joins the segments of a trail into one smooth chain; corners are rounded to what the metal allows."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, straight, unit
from wrapit.geometry.arclength import cut

SMOOTH_BEND_RAD = 1e-4  # smaller bends are noise: turning the handles moves the curve by less than a micron
MIN_BLEND_MM = 0.3  # shorter blends make slivers in the jig
MAX_TRIM = 0.45  # share of a segment that one corner may use up
FOLD_RAD = math.radians(175)  # a wire laid back over itself is folded, not rounded


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


@dataclass(frozen=True, eq=False)
class _Blend:
    """The curve that replaces the last and first `trim_mm` of two neighbours."""

    curves: tuple[BezierChain, ...]
    trim_mm: float
    radius_mm: float
    deviation_mm: float


def join(curves: Sequence[BezierChain], min_radius_mm: float) -> Joined:
    """One chain, G1 but at folds; bends become arcs of `min_radius_mm` where there is room.

    Each curve starts where the one before ends. Kinks inside a curve are rounded like those between curves.
    """
    split = [_split_at_kinks(curve) for curve in curves]
    pieces = _aligned([piece for group in split for piece in group])
    blends = [_blend(before, after, min_radius_mm) for before, after in itertools.pairwise(pieces)]
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
    return Joined(_connected(chain), spans_mm, corners)


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


def _blend(before: BezierChain, after: BezierChain, min_radius_mm: float) -> _Blend:
    """The tightest arc that keeps the radius; the widest that fits where none does."""
    bend = bend_rad(before, after)
    if bend < SMOOTH_BEND_RAD or bend > FOLD_RAD:
        return _Blend((), 0.0, math.inf, 0.0)
    room = MAX_TRIM * min(before.length, after.length)
    trim = min(room, max(MIN_BLEND_MM, min_radius_mm * math.tan(bend / 2)))
    best: _Blend | None = None
    while True:
        blend = _arc(before, after, trim)
        if blend is not None and (best is None or blend.radius_mm > best.radius_mm):
            best = blend
        if trim >= room or (best is not None and best.radius_mm >= 0.999 * min_radius_mm):
            break
        trim = min(room, 1.25 * trim)
    return best or _Blend((), 0.0, 0.0, 0.0)


def _arc(before: BezierChain, after: BezierChain, trim: float) -> _Blend | None:
    """Straight, arc, straight between the two trimmed ends; None where the tangents don't meet ahead."""
    head, tail = cut(before, before.length - trim)[0], cut(after, trim)[1]
    start, end, along, out = head.end, tail.start, head.end_tangent, tail.start_tangent
    matrix = np.column_stack([along, out])
    turning = _turning(along, out)
    if abs(np.linalg.det(matrix)) < 1e-9:
        return None
    ahead, behind = np.linalg.solve(matrix, end - start)
    reach = min(ahead, behind)
    if reach <= 0:
        return None
    apex = start + ahead * along
    radius = reach / math.tan(turning / 2)
    arc = _cubic_arc(apex - reach * along, along, apex + reach * out, out, radius)
    ends = [(start, arc.start), (arc.end, end)]
    first, last = (straight(a, b) if np.linalg.norm(b - a) > 1e-6 else None for a, b in ends)
    curves = tuple(curve for curve in (first, arc, last) if curve is not None)
    corner = before.end
    deviation = float(np.min(np.linalg.norm(arc.sampled(0.02) - corner, axis=1)))
    return _Blend(curves, trim, radius, deviation)


def _cubic_arc(
    start: FloatArray, along: FloatArray, end: FloatArray, out: FloatArray, radius: float
) -> BezierChain:
    """A circular arc as cubics of at most 60° (2·10⁻⁵ of the radius away from the circle)."""
    cross = along[0] * out[1] - along[1] * out[0]
    angle = math.atan2(float(cross), float(along @ out))
    count = max(1, math.ceil(abs(angle) / (math.pi / 3)))
    centre = start + radius * math.copysign(1, angle) * np.array([-along[1], along[0]])
    handle = 4 / 3 * math.tan(abs(angle) / count / 4) * radius
    turns = [
        np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]])
        for a in np.linspace(0, angle, count + 1)
    ]
    points = [centre + turn @ (start - centre) for turn in turns]
    points[-1] = end
    tangents = [turn @ along for turn in turns]
    return BezierChain(
        np.array(
            [
                [
                    points[i],
                    points[i] + handle * tangents[i],
                    points[i + 1] - handle * tangents[i + 1],
                    points[i + 1],
                ]
                for i in range(count)
            ]
        )
    )


def _trimmed(piece: BezierChain, head: float, tail: float) -> BezierChain:
    if tail > 0:
        piece = cut(piece, piece.length - tail)[0]
    return cut(piece, head)[1] if head > 0 else piece


def _connected(chain: Sequence[BezierChain]) -> BezierChain:
    """One chain; ends that differ by rounding are made the same."""
    points = np.concatenate([curve.points for curve in chain])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)
