"""Which stations of wires lie near one another: a few at a time, so that no drawing fills the memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import FloatArray
from wrapit.geometry.arrays import IntArray

# How many pairs are looked at together? So many take 30 MB.
PAIRS_AT_ONCE = 300_000


@dataclass(frozen=True, eq=False)
class Near:
    """Pairs of stations by their numbers, (m,) each, and the squares of their distances (mm²)."""

    later: IntArray
    earlier: IntArray
    apart2: FloatArray

    def chosen(self, which: NDArray[np.bool_]) -> Near:
        """Some of the pairs."""
        return Near(self.later[which], self.earlier[which], self.apart2[which])


@dataclass(frozen=True, eq=False)
class Neighbours:
    """Stations (n, 2) in the order in which they are laid, and how far (mm) is near."""

    points: FloatArray
    reach_mm: float
    _tree: Any

    @classmethod
    def of(cls, points: FloatArray, reach_mm: float) -> Neighbours:
        """Sorts the stations by place, once for all questions."""
        from scipy.spatial import cKDTree

        return cls(points, reach_mm, cKDTree(points))

    def __len__(self) -> int:
        return len(self.points)

    def before(self, laid: slice) -> Iterator[Near]:
        """All pairs of one of the stations `laid` and one with a lower number that is near it."""
        counts = self._tree.query_ball_point(self.points[laid], self.reach_mm, return_length=True)
        part = np.cumsum(counts) // PAIRS_AT_ONCE
        for group in np.split(np.arange(laid.start, laid.stop), np.flatnonzero(np.diff(part)) + 1):
            yield self._pairs(group)

    def _pairs(self, stations: IntArray) -> Near:
        found = self._tree.query_ball_point(self.points[stations], self.reach_mm)
        later = np.repeat(stations, [len(near) for near in found])
        earlier = np.concatenate([np.asarray(near, dtype=np.int64) for near in found])
        below = earlier < later
        later, earlier = later[below], earlier[below]
        return Near(later, earlier, ((self.points[earlier] - self.points[later]) ** 2).sum(axis=1))
