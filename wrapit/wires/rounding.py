"""Replaces a bend between two curves by one that the metal takes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, straight
from wrapit.geometry.arclength import cut
from wrapit.geometry.bezier import derivative, second_derivative
from wrapit.geometry.outlines.loops import arc_cubics

MIN_BLEND_MM = 0.3  # shorter blends make slivers in the jig
# Smaller bends are noise: turning the handles moves the curve by less than a micron.
SMOOTH_BEND_RAD = 1e-4
FOLD_RAD = math.radians(175)  # a wire laid back over itself is folded, not rounded
# The tightest hairpin that a tip becomes, in bends that the metal takes: half of that of soft wire is half of
# its thickness, and tighter its sides would lie in each other.
HAIRPIN_SHARE = 0.5
TIP_RAD = math.radians(150)  # straight sides would be cut by 3.7 bends here, curved ones by far less
# By how much each trial is wider than the one before. The finer, the less is cut off a corner: 1.14 brings
# wires 0.07 mm nearer to our drawings, and takes more trials.
GROWTH = 1.2
# How finely the deviation is measured; 0.02 changes it by less than 1e-4 mm.
ROUGHNESS_MM = 0.03
# Cubics of at most 60° stray from their circle by 2e-5 of its radius (`geometry/outlines/loops.py`).
ARC_PIECE_RAD = math.pi / 3


@dataclass(frozen=True, eq=False)
class Blend:
    """The curves that replace the last `trim_mm` of one curve and the first `trim_mm` of the next."""

    curves: tuple[BezierChain, ...]
    trim_mm: float
    radius_mm: float
    deviation_mm: float


# What a corner is that stays as drawn.
NO_BLEND: Final = Blend((), 0.0, math.inf, 0.0)


def bend_rad(before: BezierChain, after: BezierChain) -> float:
    """Angle in [0, π] by which the direction changes where `after` follows `before`."""
    return turning_rad(before.end_tangent, after.start_tangent)


def turning_rad(arriving: FloatArray, leaving: FloatArray) -> float:
    """Angle in [0, π] between two unit directions (2,)."""
    cross = arriving[0] * leaving[1] - arriving[1] * leaving[0]
    return abs(math.atan2(float(cross), float(arriving @ leaving)))


def corner_blend(before: BezierChain, after: BezierChain, room_mm: float, min_radius_mm: float) -> Blend:
    """The bend of the corner where `after` follows `before`, within `room_mm` of either: none at folds."""
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


def best_blend(
    before: BezierChain, after: BezierChain, trim_mm: float, room_mm: float, min_radius_mm: float
) -> Blend:
    """The shortest blend from `trim_mm` on that keeps the radius; the widest within `room_mm` if none does.

    `after` starts where `before` ends.
    """
    trim = min(room_mm, max(MIN_BLEND_MM, trim_mm))
    best = NO_BLEND
    while True:
        head, tail = cut(before, before.length - trim)[0], cut(after, trim)[1]
        for curves in (_arc(head, tail), _swing(head, tail)):
            radius = _smallest_radius(curves)
            if curves and (best is NO_BLEND or radius > best.radius_mm):
                best = Blend(curves, trim, radius, 0.0)
        if trim >= room_mm or (best.curves and best.radius_mm >= 0.999 * min_radius_mm):
            return Blend(best.curves, best.trim_mm, best.radius_mm, _deviation(before, after, best))
        trim = min(room_mm, GROWTH * trim)


def _arc(head: BezierChain, tail: BezierChain) -> tuple[BezierChain, ...]:
    """Straight, arc, straight between two ends; nothing where the tangents don't meet ahead."""
    start, end, along, out = head.end, tail.start, head.end_tangent, tail.start_tangent
    matrix = np.column_stack([along, out])
    if abs(np.linalg.det(matrix)) < 1e-9:
        return ()
    ahead, behind = np.linalg.solve(matrix, end - start)
    reach = min(ahead, behind)
    if reach <= 0:
        return ()
    apex = start + ahead * along
    arc = _cubic_arc(apex - reach * along, along, apex + reach * out, out, reach)
    ends = [(start, arc.start), (arc.end, end)]
    first, last = (straight(a, b) if np.linalg.norm(b - a) > 1e-6 else None for a, b in ends)
    return tuple(curve for curve in (first, arc, last) if curve is not None)


def _swing(head: BezierChain, tail: BezierChain) -> tuple[BezierChain, ...]:
    """One cubic between two ends, for ends that lie beside one another."""
    start, end = head.end, tail.start
    handle = float(np.linalg.norm(end - start)) / 3
    if handle < 1e-6:
        return ()
    return (
        BezierChain(
            np.array([[start, start + handle * head.end_tangent, end - handle * tail.start_tangent, end]])
        ),
    )


def _cubic_arc(
    start: FloatArray, along: FloatArray, end: FloatArray, out: FloatArray, reach: float
) -> BezierChain:
    """The circular arc that leaves `start` along one direction and comes to `end` along the other."""
    cross = along[0] * out[1] - along[1] * out[0]
    angle = math.atan2(float(cross), float(along @ out))
    radius = reach / math.tan(abs(angle) / 2)
    count = max(1, math.ceil(abs(angle) / ARC_PIECE_RAD))
    centre = start + radius * math.copysign(1, angle) * np.array([-along[1], along[0]])
    turns = [
        np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]])
        for a in np.linspace(0, angle, count + 1)
    ]
    points = np.array([centre + turn @ (start - centre) for turn in turns])
    points[-1] = end
    tangents = np.array([turn @ along for turn in turns])
    return BezierChain(arc_cubics(points, tangents, radius, abs(angle) / count))


def _smallest_radius(curves: tuple[BezierChain, ...]) -> float:
    points = np.concatenate([curve.points for curve in curves]) if curves else np.zeros((0, 4, 2))
    t = np.linspace(0, 1, 17)
    d, dd = derivative(points, t), second_derivative(points, t)
    speed = np.maximum(np.linalg.norm(d, axis=-1), 1e-12)
    curvature = np.abs(d[..., 0] * dd[..., 1] - d[..., 1] * dd[..., 0]) / speed**3
    return 1 / max(float(curvature.max(initial=0.0)), 1e-9)


def _deviation(before: BezierChain, after: BezierChain, blend: Blend) -> float:
    """Largest distance of what is replaced from what replaces it."""
    from scipy.spatial import cKDTree

    if not blend.curves:
        return 0.0
    replaced = np.concatenate(
        [
            cut(before, before.length - blend.trim_mm)[1].sampled(ROUGHNESS_MM),
            cut(after, blend.trim_mm)[0].sampled(ROUGHNESS_MM),
        ]
    )
    new = np.concatenate([curve.sampled(ROUGHNESS_MM) for curve in blend.curves])
    # Sorted by place: along a segment of 60 mm each would be compared with thousands.
    return float(cKDTree(new).query(replaced)[0].max())
