"""Curves that turn back on themselves, made such that metal can follow: smoothed, or cut at their tips."""

from __future__ import annotations

import numpy as np

from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.cusps import sharp_places, without_cusps

# What turns sharply within this share of the tightest bend that the metal takes has a tip. Where it turns in
# more, bends are widened as anywhere else. In a drawing of 214 segments, 32 of them out and back, 14 of 38
# wires had no solid; with 0.03 and 0.1 all have one, with 0.3 one still has none.
TIP_SHARE = 0.1
# How finely the deviation is measured, in shares of that bend.
_ROUGHNESS = 0.05


def faired(curve: BezierChain, min_radius_mm: float) -> BezierChain:
    """The curve without places where a cubic turns back within next to nothing.

    Where shorter handles keep a cubic within `min_radius_mm` of the drawing and out of its own way, it gets
    those, and specks go: out and back by less than a bend is a slip. Else its tips become corners.
    """
    near = TIP_SHARE * min_radius_mm
    slips = [bool(sharp_places(cubic, near)) for cubic in curve.points]
    if not any(slips):
        return curve
    kept: list[FloatArray] = []
    for cubic, slip in zip(curve.points, slips, strict=True):
        if slip and _is_speck(cubic, min_radius_mm, near):
            continue
        kept.append(_tamed(cubic, min_radius_mm, near) if slip else cubic)
    # A segment that is nothing but a speck stays one: it ties its junctions.
    points = np.stack(kept or [*curve.points])
    points[0, 0], points[-1, 3] = curve.start, curve.end
    points[1:, 0] = points[:-1, 3]
    return BezierChain(without_cusps(points, near))


def _is_speck(cubic: FloatArray, min_radius_mm: float, near: float) -> bool:
    """Whether a cubic comes back to where it began without having gone as far as a bend."""
    away = np.linalg.norm(cubic - cubic[0], axis=1)
    return bool(away[3] < near and away.max() < min_radius_mm)


def _tamed(cubic: FloatArray, min_radius_mm: float, near: float) -> FloatArray:
    """The cubic with handles of a third of the way; as it was where that would stray, or turn sharply."""
    from scipy.spatial import cKDTree

    chord = float(np.linalg.norm(cubic[3] - cubic[0]))
    if chord < near:
        return cubic
    old = BezierChain(cubic[None])
    first, last = np.minimum(np.linalg.norm([cubic[1] - cubic[0], cubic[3] - cubic[2]], axis=1), chord / 3)
    inner = cubic[0] + first * old.start_tangent, cubic[3] - last * old.end_tangent
    new = np.stack([cubic[0], *inner, cubic[3]])
    step = _ROUGHNESS * min_radius_mm
    apart = cKDTree(BezierChain(new[None]).sampled(step)).query(old.sampled(step))[0].max()
    return new if apart <= min_radius_mm and not sharp_places(new, near) else cubic
