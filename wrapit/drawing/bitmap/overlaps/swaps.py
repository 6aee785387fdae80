"""Where two strokes of a ribbon change sides, told by the distance between their centre lines.

At each waist they may cross or bounce back. Each choice gives a signed distance between the strokes; it is
drawn again as a smooth function, and the choice is kept that explains the ribbon's width best.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.overlaps.ribbon_axis import LONGEST_FLAT, longest_run
from wrapit.geometry import FloatArray, IntArray

# All in stroke widths, and varied as those of `ribbons.py`.
# Where may two strokes change sides? At waists, where their centres are less than 0.35 apart; of two waists
# within 0.8 the narrower counts. Waists between which the strokes part by 0.6 are judged by themselves (0.42
# or 0.78: one of 12 tangles more goes wrong), six at a time at most, which are 64 choices.
_NARROW = 0.35
_APART = 0.8
_ALONE = 0.6
_MOST_WAISTS = 6
# Which choice is right? The one whose signed distance is smooth: a polynomial with one more degree for each 3
# of length misses it by less than 0.06, and by less than 0.75 times what the next best one misses (at 0.53,
# one of six windings is left alone). Distances above 1.6 tell nothing: there the edges are another stroke's.
_KNOT = 3.0
_MISFIT = 0.06
_BETTER = 0.75
_WIDEST = 1.6
# What is one stroke that two share, not two strokes? Where they are less than 0.1 apart over more than
# `LONGEST_FLAT`, or where an end doesn't open to 0.5 within 1.5.
_FLAT = 0.1
_END = 1.5
_OPEN = 0.5
# What is one stroke between two joints, not a crossing? Strokes that cross are within 0.15 of each other over
# at most 0.25 of the length over which they are within 0.6, as they part evenly; of 14 stretches of one to
# two widths between joints that were taken for crossings, over 0.67 to 0.82.
_TOGETHER = 0.15
_PARTED = 0.6
_STILL = 0.45


def swaps_of(gap: FloatArray, known: NDArray[np.bool_], step: float) -> tuple[list[int], float] | None:
    """The points where two strokes change sides, from their distance along the ribbon (all in widths)."""
    reach = max(3, int(_END / step))
    if min(gap[:reach].max(), gap[-reach:].max()) < _OPEN or longest_run(gap < _FLAT) * step > LONGEST_FLAT:
        return None
    waists = _waists(gap, step)
    known = known & (gap < _WIDEST)
    if not waists:
        return _best_choice(gap, np.flatnonzero(known), [], step)
    swaps: list[int] = []
    worst = 0.0
    for group, low, high in _sections(gap, waists):
        if len(group) > _MOST_WAISTS:
            return None
        found = _best_choice(gap, np.flatnonzero(known[low:high]) + low, group, step)
        if found is None:
            return None
        swaps += found[0]
        worst = max(worst, found[1])
    return None if any(_is_still(gap, swap) for swap in swaps) else (swaps, worst)


def _is_still(gap: FloatArray, swap: int) -> bool:
    """Whether two strokes run as one around a swap before they part abruptly: there is one stroke."""
    return _around(gap < _TOGETHER, swap) > _STILL * _around(gap < _PARTED, swap)


def _around(near: NDArray[np.bool_], at: int) -> int:
    """How many flags (n,) in a row are set around one of them; none where that one isn't."""
    unset = np.concatenate([[-1], np.flatnonzero(~near), [len(near)]])
    after = int(np.searchsorted(unset, at))
    return int(unset[after] - unset[after - 1]) - 1 if near[at] else 0


def _sections(gap: FloatArray, waists: list[int]) -> list[tuple[list[int], int, int]]:
    """Waists that have to be judged together, and the stretch around them."""
    groups: list[list[int]] = []
    for at in waists:
        if groups and gap[groups[-1][-1] : at].max() < _ALONE:
            groups[-1].append(at)
        else:
            groups.append([at])
    tops = [one[-1] + int(np.argmax(gap[one[-1] : other[0]])) for one, other in itertools.pairwise(groups)]
    bounds = [0, *tops, len(gap)]
    return [(group, bounds[k], bounds[k + 1]) for k, group in enumerate(groups)]


def _best_choice(
    gap: FloatArray, index: IntArray, waists: list[int], step: float
) -> tuple[list[int], float] | None:
    """The waists at which the strokes cross, and the misfit; nothing where two choices fit alike."""
    if len(index) * step < 1.0:
        return None
    choices = [
        list(chosen) for count in range(len(waists) + 1) for chosen in itertools.combinations(waists, count)
    ]
    signs = np.array([(-1.0) ** np.searchsorted(chosen, index, side="right") for chosen in choices])
    misfits = _misfits(signs * gap[index], np.asarray(index * step, dtype=np.float64))
    order = np.argsort(misfits, kind="stable")
    best = int(order[0])
    if misfits[best] > _MISFIT or (len(order) > 1 and misfits[best] > _BETTER * misfits[order[1]]):
        return None
    return choices[best], float(misfits[best])


def _misfits(signed: FloatArray, along: FloatArray) -> FloatArray:
    """How far each row is from a smooth function of the length, in the mean."""
    reach = max(float(np.ptp(along)), 1e-9)
    degree = min(int(np.clip(3 + reach / _KNOT, 3, 9)), len(along) - 2)
    basis = np.polynomial.legendre.legvander(2 * (along - along[0]) / reach - 1, degree)
    q, _ = np.linalg.qr(basis)
    rest = signed - signed @ q @ q.T
    return np.sqrt((rest * rest).mean(axis=1))


def _waists(gap: FloatArray, step: float) -> list[int]:
    """Where the ribbon is narrowest, and hardly wider than one stroke."""
    from scipy.ndimage import gaussian_filter1d

    even = gaussian_filter1d(gap, max(0.25 / step, 0.5), mode="nearest")
    low = np.flatnonzero((even[1:-1] <= even[:-2]) & (even[1:-1] < even[2:]) & (even[1:-1] < _NARROW)) + 1
    kept: list[int] = []
    for at in sorted(low.tolist(), key=lambda k: even[k]):
        if all(abs(at - other) * step > _APART for other in kept):
            kept.append(at)
    return sorted(kept)
