"""Exact pieces of curves: a B-spline as Béziers, and the part between two arc lengths."""

from __future__ import annotations

import itertools

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, derivative, split
from wrapit.geometry.bspline import BSpline


def chain_of(spline: BSpline) -> BezierChain:
    """The same curve as cubic Béziers, one for each knot span; ValueError unless the degree is 3.

    Control points are the spline's blossoms at the span's ends (Ramshaw 1987), so corners stay corners.
    """
    if spline.degree != 3:
        raise ValueError(f"only cubic splines become cubic Béziers, not degree {spline.degree}")
    knots = spline.knots
    cubics = [
        [_blossom(spline, index, values) for values in ((a, a, a), (a, a, b), (a, b, b), (b, b, b))]
        for index, (a, b) in enumerate(itertools.pairwise(knots))
        if b > a
    ]
    points = np.array(cubics)
    points[1:, 0] = points[:-1, 3]
    points[0, 0], points[-1, 3] = spline.poles[0], spline.poles[-1]
    return BezierChain(points)


def piece(chain: BezierChain, start_mm: float, end_mm: float) -> BezierChain:
    """The part of the chain between two arc lengths, cut to the chain; ValueError if nothing is left."""
    reach = np.concatenate([[0.0], np.cumsum(chain.lengths)])
    start, end = max(0.0, start_mm), min(float(reach[-1]), end_mm)
    if end - start <= 1e-9:
        raise ValueError(f"no curve between {start_mm:g} mm and {end_mm:g} mm of {reach[-1]:g} mm")
    first = min(int(np.searchsorted(reach, start, side="right")) - 1, len(chain) - 1)
    last = max(int(np.searchsorted(reach, end, side="left")) - 1, first)
    cubics = chain.points[first : last + 1].copy()
    at_end = _parameter(cubics[-1], end - reach[last])
    at_start = _parameter(cubics[0], start - reach[first])
    if at_end < 1:
        cubics[-1] = split(cubics[-1:], at_end)[0][0]
    if at_start > 0:
        within = at_start / at_end if first == last else at_start
        cubics[0] = split(cubics[:1], within)[1][0]
    cubics[1:, 0] = cubics[:-1, 3]
    return BezierChain(cubics)


def _blossom(spline: BSpline, index: int, values: tuple[float, float, float]) -> FloatArray:
    """Polar form of the polynomial on knot span `index` (de Boor's recursion with three parameters)."""
    poles = [spline.poles[index - 3 + j] for j in range(4)]
    for level, value in enumerate(values, start=1):
        for j in range(3, level - 1, -1):
            low, high = spline.knots[index - 3 + j], spline.knots[index + 1 + j - level]
            share = (value - low) / (high - low)
            poles[j] = (1 - share) * poles[j - 1] + share * poles[j]
    return poles[3]


def _parameter(cubic: FloatArray, length_mm: float) -> float:
    """Parameter at which the cubic (4, 2) has run `length_mm`: safeguarded Newton on exact lengths."""
    total = BezierChain(cubic[None]).length
    if length_mm <= 1e-9 * total:
        return 0.0
    if length_mm >= total * (1 - 1e-9):
        return 1.0
    low, high, t = 0.0, 1.0, length_mm / total
    for _ in range(60):
        excess = BezierChain(split(cubic[None], t)[0]).length - length_mm
        if abs(excess) <= 1e-10 * total:
            break
        low, high = (low, t) if excess > 0 else (t, high)
        speed = float(np.linalg.norm(derivative(cubic[None], np.array([t]))[0, 0]))
        step = t - excess / speed if speed > 0 else -1.0
        t = step if low < step < high else (low + high) / 2
    return t
