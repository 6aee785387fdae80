"""Write-locked arrays: what flows between stages can't be changed by accident."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.int64]


def locked(values: ArrayLike) -> FloatArray:
    """A private, write-locked copy as float64."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def norms(vectors: FloatArray) -> FloatArray:
    """Lengths (…,) of vectors (…, 2).

    >>> norms(np.array([(3.0, 4.0), (0.0, 2.0)])).tolist()
    [5.0, 2.0]
    """
    x, y = vectors[..., 0], vectors[..., 1]
    # A sum over an axis of two takes several times as long.
    return np.asarray(np.sqrt(x * x + y * y))


def unit(vector: FloatArray) -> FloatArray:
    """The vector at length one (zero stays zero); works on (2,), (n, 2) and (n, 3)."""
    if vector.shape == (2,):
        # For a single one plain numbers take a third of the time.
        x, y = vector.tolist()
        length = math.sqrt(x * x + y * y)
        return np.array([x / length, y / length] if length > 0 else [0.0, 0.0])
    if vector.shape[-1] == 2:
        norm = norms(vector)[..., None]
    else:
        norm = np.sqrt(np.add.reduce(vector * vector, axis=-1, keepdims=True))
    some = norm > 0
    if some.all():
        return np.asarray(vector / norm)
    return np.divide(vector, norm, out=np.zeros_like(vector, dtype=np.float64), where=some)


def median(values: FloatArray) -> float:
    """The median of values (n,), nan where one of them is, in a fraction of the time of numpy's own.

    >>> median(np.array([4.0, 1.0, 2.0, 9.0]))
    3.0
    """
    ordered = np.sort(values)
    low, high = ordered[[(len(ordered) - 1) // 2, len(ordered) // 2]].tolist()
    last = float(ordered[-1])
    return last if math.isnan(last) else float(low + high) / 2


def runs(mask: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last place of each run of what is true (n,).

    >>> runs(np.array([True, False, True, True]))
    [(0, 0), (2, 3)]
    """
    change = np.diff(np.concatenate([[False], mask, [False]]).astype(int))
    ends = zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1, strict=True)
    return [(int(first), int(last)) for first, last in ends]
