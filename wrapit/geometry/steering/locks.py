"""Least squares whose unknowns are bent no further than a lock."""

from __future__ import annotations

from typing import Final

import numpy as np

from wrapit.geometry.arrays import FloatArray

# From here a bend counts as at full lock.
NEARLY: Final = 1e-9
# Conditions yield by so much of what it takes to keep them: solvable even where all arcs are at full lock.
YIELDING: Final = 1e-8
# How often the set of arcs at full lock is mended. Most are found in 2 or 3.
MOST_SETS: Final = 12


def within_bounds(
    square: FloatArray,
    pull: FloatArray,
    rows: FloatArray,
    missing: FloatArray,
    bends: FloatArray,
    most: float,
) -> FloatArray:
    """Least squares with conditions and bounds, by primal and dual active sets.

    The step d (4 + n,) with rows·d = missing and the least ½ d·square·d − pull·d, of which the last n, added
    to `bends`, stay within `most`.
    """
    size, held = len(pull), len(missing)
    lock = np.where(np.abs(bends) > most - NEARLY, np.sign(bends), 0.0).astype(int)
    step = np.zeros(size)
    for _ in range(MOST_SETS):
        free = np.concatenate([np.ones(4, dtype=bool), lock == 0])
        fixed = np.zeros(size)
        fixed[4:] = np.where(lock != 0, lock * most - bends, 0.0)
        count = int(free.sum())
        system = np.zeros((count + held, count + held))
        system[:count, :count] = square[np.ix_(free, free)]
        system[:count, count:] = rows[:, free].T
        system[count:, :count] = rows[:, free]
        system[range(count, count + held), range(count, count + held)] = -YIELDING
        right = np.concatenate([(pull - square @ fixed)[free], missing - rows @ fixed])
        solved = np.linalg.solve(system, right)
        step = fixed.copy()
        step[free] = solved[:count]
        force = (pull - square @ step - rows.T @ solved[count:])[4:]
        bent = bends + step[4:]
        new = np.where(lock == 0, np.where(bent > most, 1, np.where(bent < -most, -1, 0)), lock)
        new = np.where((lock != 0) & (force * lock < 0), 0, new)
        if np.array_equal(new, lock):
            return step
        lock = new
    return step
