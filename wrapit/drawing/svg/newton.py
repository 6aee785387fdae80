"""Newton's method for the crossings of many pairs of cubics at once."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.svg.steps import SAMPLES, Steps
from wrapit.geometry import FloatArray, IntArray

# From a step of a 24th of a cubic, each round doubles the correct digits; four would do, except at tangents.
_ROUNDS = 8
# What is a crossing? Where the curves then lie within this share of the drawing's size of each other.
_MISSED = 1e-9
# How far beyond its ends does a step count? The chord misses the curve by a little.
_BEYOND = 0.2


def crossings_near(
    steps: Steps, first: IntArray, second: IntArray
) -> tuple[IntArray, FloatArray, FloatArray]:
    """True crossings near pairs of steps.

    Returns which pairs have one, and its parameter on the first and on the second curve; (n,) each.
    """
    rows, s, t = _straight(steps, first, second)
    one, other = first[rows], second[rows]
    k, u = _whole_and_rest(steps, one, s)
    m, v = _whole_and_rest(steps, other, t)
    a, b = steps.cubics[steps.first[steps.curve[one]] + k], steps.cubics[steps.first[steps.curve[other]] + m]
    for _ in range(_ROUNDS):
        (x, dx), (y, dy) = local(a, u), local(b, v)
        matrix = np.stack([dx, -dy], axis=-1)
        least = 1e-12 * np.maximum(np.linalg.norm(dx, axis=1) * np.linalg.norm(dy, axis=1), 1e-300)
        regular = ~(np.abs(np.linalg.det(matrix)) < least)
        rows, k, m, a, b, u, v = (array[regular] for array in (rows, k, m, a, b, u, v))
        if not len(rows):
            break
        step = np.linalg.solve(matrix[regular], (y - x)[regular][:, :, None])[:, :, 0]
        u, v = np.clip(u + step[:, 0], 0, 1), np.clip(v + step[:, 1], 0, 1)
    missed = np.linalg.norm(local(a, u)[0] - local(b, v)[0], axis=1) > _MISSED * steps.size
    return rows[~missed], (k + u)[~missed], (m + v)[~missed]


def points_at(steps: Steps, curve: IntArray, at: FloatArray) -> FloatArray:
    """Points (n, 2) of curves at parameters (n,)."""
    k = np.minimum(at.astype(np.int64), steps.count[curve] - 1)
    return local(steps.cubics[steps.first[curve] + k], at - k)[0]


def local(cubics: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points and first derivatives, (n, 2) each, of cubics (n, 4, 2), each at a parameter of its own (n,)."""
    a, b, c, d = (cubics[:, k] for k in range(4))
    s = 1 - t
    return (_weighted(_cubed(s), a) + _weighted(3 * s * s * t, b) + _weighted(3 * s * t * t, c)) + _weighted(
        _cubed(t), d
    ), 3 * (_weighted(s * s, b - a) + _weighted(2 * s * t, c - b) + _weighted(t * t, d - c))


def _weighted(weights: FloatArray, points: FloatArray) -> FloatArray:
    return weights[:, None] * points


def _cubed(values: FloatArray) -> FloatArray:
    # As Python's own power rounds, so that a point comes out the same alone and among many.
    return np.array([value**3 for value in values.tolist()], dtype=np.float64)


def _straight(steps: Steps, first: IntArray, second: IntArray) -> tuple[IntArray, FloatArray, FloatArray]:
    """Pairs of steps that, carried on a little, cross; and the shares of the steps where they do."""
    p, q = steps.ends[first], steps.ends[second]
    d, e, gap = p[:, 1] - p[:, 0], q[:, 1] - q[:, 0], q[:, 0] - p[:, 0]
    det = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    parallel = np.abs(det) < 1e-9 * np.linalg.norm(d, axis=1) * np.linalg.norm(e, axis=1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        s = (gap[:, 0] * e[:, 1] - gap[:, 1] * e[:, 0]) / det
        t = (gap[:, 0] * d[:, 1] - gap[:, 1] * d[:, 0]) / det
    rows = np.flatnonzero(
        ~parallel & (s >= -_BEYOND) & (s <= 1 + _BEYOND) & (t >= -_BEYOND) & (t <= 1 + _BEYOND)
    )
    return rows, s[rows], t[rows]


def _whole_and_rest(steps: Steps, index: IntArray, share: FloatArray) -> tuple[IntArray, FloatArray]:
    """The cubic that a share of a step lies on, and the parameter there."""
    whole = (steps.start[index] + 1e-9).astype(np.int64)
    return whole, np.clip(steps.start[index] - whole + share / SAMPLES, 0, 1)
