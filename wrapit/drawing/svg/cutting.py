"""Cuts chains of cubics at parameters, many stretches at once."""

from __future__ import annotations

import itertools

import numpy as np
import shapely
from numpy.typing import ArrayLike

from wrapit.geometry import BezierChain, FloatArray, IntArray, unit
from wrapit.geometry.cusps import without_cusps

# Parts shorter than this share of a cubic are rounding: nobody drew them.
_LEAST_SHARE = 1e-7
# In reaches: a cubic that turns sharply within so much has a tip there; ink shows nothing of how it turns.
_TIP = 0.1
# At so many places a part is held against another, which is as smooth as it is.
_PLACES = 32


def stretches(cubics: FloatArray, starts: ArrayLike, ends: ArrayLike) -> list[FloatArray | None]:
    """The cubics (m, 4, 2) from each start to its end; beyond the last cubic the chain goes round.

    Parameters count the cubics before them. None where nothing lies between start and end.
    """
    start, end = np.asarray(starts, dtype=np.float64), np.asarray(ends, dtype=np.float64)
    whole = np.floor(start).astype(np.int64)
    rows = np.maximum(np.ceil(end - 1e-9).astype(np.int64) - whole, 0)
    owner = np.repeat(np.arange(len(start)), rows)
    k = whole[owner] + np.arange(len(owner)) - np.repeat(np.cumsum(rows) - rows, rows)
    low, high = np.maximum(start[owner] - k, 0.0), np.minimum(end[owner] - k, 1.0)
    kept = high - low > _LEAST_SHARE
    owner, k, low, high = owner[kept], k[kept], low[kept], high[kept]
    parts = _between(cubics[k % len(cubics)], low, high)
    bounds = np.searchsorted(owner, np.arange(len(start) + 1)).tolist()
    return [_chained(parts[a:b]) if b > a else None for a, b in itertools.pairwise(bounds)]


def moved(cubics: FloatArray, start: FloatArray, end: FloatArray) -> BezierChain:
    """The cubics with their ends moved exactly onto places, each handle along with its end."""
    moved = cubics.copy()
    moved[0, 1] += start - moved[0, 0]
    moved[-1, 2] += end - moved[-1, 3]
    moved[0, 0], moved[-1, 3] = start, end
    return BezierChain(moved)


def cut_at_tips(cubics: FloatArray, closed: bool, reach: float) -> list[tuple[FloatArray, bool]]:
    """The chain with its cubics cut where they turn back, as one or several: cubics, and whether closed.

    Short tips that ink hides stay. What comes back on its own ink is left out, which parts the chain.
    """
    runs: list[list[FloatArray]] = [[]]
    for cubic in cubics:
        parts = without_cusps(cubic[None], _TIP * reach)
        if len(parts) > 1 and float(BezierChain(parts).lengths.min()) < reach:
            parts = cubic[None]
        for index, part in enumerate(parts):
            beside = [*parts[max(index - 1, 0) : index], *parts[index + 1 : index + 2]]
            if any(_lies_on(part, other, _TIP * reach) for other in beside):
                runs.append([])
            else:
                runs[-1].append(part)
    if len(runs) == 1:
        return [(np.stack(runs[0]), closed)]
    if closed:
        runs[0] = [*runs.pop(), *runs[0]]
    return [(np.stack(run), False) for run in runs if run]


def _lies_on(part: FloatArray, other: FloatArray, near: float) -> bool:
    """Whether a cubic lies on another that is longer, all along."""
    one, whole = BezierChain(part[None]), BezierChain(other[None])
    if one.length >= whole.length:
        return False
    points, ground = one.sampled(one.length / _PLACES), shapely.LineString(whole.sampled(near))
    return bool((shapely.distance(shapely.points(points), ground) <= near).all())


def corners(cubics: FloatArray, closed: bool, turn_rad: float) -> IntArray:
    """Joints of a chain where it turns by more than an angle; joint k lies before cubic k."""
    arriving, leaving = -_leaving(cubics[:, ::-1]), _leaving(cubics)
    if closed:
        arriving = np.roll(arriving, 1, axis=0)
        first = 0
    else:
        arriving, leaving, first = arriving[:-1], leaving[1:], 1
    # matmul of single vectors, so that a turn of just that angle rounds as it does for one joint alone.
    cosine = np.matmul(arriving[:, None], leaving[:, :, None])[:, 0, 0]
    return np.flatnonzero(np.arccos(np.clip(cosine, -1, 1)) > turn_rad) + first


def _leaving(cubics: FloatArray) -> FloatArray:
    """Directions (n, 2) from each cubic's first control point to the first one apart from it."""
    apart = cubics - cubics[:, :1]
    far = np.linalg.norm(apart, axis=-1)
    index = np.argmax(far > 1e-9 * np.maximum(1.0, far.max(axis=1))[:, None], axis=1)
    return unit(apart[np.arange(len(cubics)), index])


def _between(cubics: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Each cubic's part between two parameters of its own."""
    parts = cubics.copy()
    cut = high < 1
    parts[cut] = _halves(parts[cut], high[cut])[0]
    cut = low > 0
    parts[cut] = _halves(parts[cut], low[cut] / high[cut])[1]
    return parts


def _halves(cubics: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """De Casteljau: each cubic before and after a parameter of its own."""
    t = t[:, None, None]
    left, right, level = [cubics[:, 0]], [cubics[:, 3]], cubics
    while level.shape[1] > 1:
        level = (1 - t) * level[:, :-1] + t * level[:, 1:]
        left.append(level[:, 0])
        right.append(level[:, -1])
    return np.stack(left, axis=1), np.stack(right[::-1], axis=1)


def _chained(parts: FloatArray) -> FloatArray:
    cubics = parts.copy()
    cubics[1:, 0] = cubics[:-1, 3]
    return cubics
