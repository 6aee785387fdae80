"""Short polynomials in the length along a stroke, and angles, mostly in plain numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry import FloatArray, unit

# Made once, as polynomials are many and short: beside an array a number takes twice as long as an array.
_REGULAR = np.array(1e-12)
_EXPONENTS = np.arange(16.0)[:, None]


def horner(terms: list[list[float]], along: float) -> tuple[float, float, float, float]:
    """Place and unit direction of a parametric polynomial; plain numbers, as arrays of two are slow."""
    x = y = dx = dy = 0.0
    for a, b in reversed(terms):
        dx, dy = dx * along + x, dy * along + y
        x, y = x * along + a, y * along + b
    norm = math.hypot(dx, dy) or 1.0
    return x, y, dx / norm, dy / norm


def nearest_along(
    terms: list[list[float]], point: FloatArray, along: float, low: float, high: float
) -> float:
    """Where between two lengths a polynomial comes nearest to a point, starting the search at `along`."""
    px, py = float(point[0]), float(point[1])
    for _ in range(3):
        x, y, dx, dy = horner(terms, along)
        along = min(max(along + (px - x) * dx + (py - y) * dy, low), high)
    return along


def polynomial(along: FloatArray, points: FloatArray, degree: int) -> FloatArray:
    """Least-squares coefficients (degree + 1, 2), lowest first."""
    scale = max(float(np.maximum.reduce(np.abs(along))), 1e-9)
    powers = np.empty((degree + 1, len(along)))
    powers[0] = 1.0
    share = np.divide(along, scale, out=powers[1])
    for k in range(1, degree):
        np.multiply(powers[k], share, out=powers[k + 1])
    normal = powers @ powers.T
    normal.ravel()[:: degree + 2] += _REGULAR
    solution = np.linalg.solve(normal, powers @ points)
    solution /= np.power(scale, _EXPONENTS[: degree + 1])
    return np.asarray(solution)


def crossing(
    before: FloatArray, after: FloatArray, limit: float, apart: float
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Where two parametric polynomials meet within `limit` of their zero, and their unit directions there.

    Nothing where they are parallel or come no nearer to each other than `apart`.
    """
    s, t = 0.0, 0.0
    terms = before.tolist(), after.tolist()
    for _ in range(6):
        (px, py, ax, ay), (qx, qy, bx, by) = _value(terms[0], s), _value(terms[1], t)
        determinant = ay * bx - ax * by
        if abs(determinant) < 1e-3 * math.hypot(ax, ay) * math.hypot(bx, by):
            return None
        s += ((qy - py) * bx - (qx - px) * by) / determinant
        t += ((qy - py) * ax - (qx - px) * ay) / determinant
        s, t = min(max(s, -limit), limit), min(max(t, -limit), limit)
    p, q = np.array(_value(terms[0], s)), np.array(_value(terms[1], t))
    if np.linalg.norm(p[:2] - q[:2]) > apart:
        return None
    return (p[:2] + q[:2]) / 2, unit(p[2:]), unit(q[2:])


def _value(terms: list[list[float]], at: float) -> tuple[float, float, float, float]:
    """Place and derivative of a parametric polynomial."""
    x = y = dx = dy = 0.0
    for a, b in reversed(terms):
        dx, dy = dx * at + x, dy * at + y
        x, y = x * at + a, y * at + b
    return x, y, dx, dy


def angle(a: FloatArray, b: FloatArray) -> float:
    """Angle between two directions, 0…π."""
    return angle_of(a.tolist(), b.tolist())


def angle_of(a: Sequence[float], b: Sequence[float]) -> float:
    """The same for plain numbers."""
    return abs(math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))


def parabola_shares(steps: int) -> FloatArray:
    """How much of the start, bend and end of a quadratic Bézier is in each of its points (steps + 1, 3)."""
    t = np.linspace(0, 1, steps + 1)
    return np.column_stack([(1 - t) ** 2, 2 * (1 - t) * t, t**2])
