"""Places that are one: found by a grid, joined as disjoint sets, both in about constant time."""

from __future__ import annotations

import math

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.disjoint_sets import Sets


class Places:
    """Numbered places; points closer than a tolerance are one place, and so are those that are joined."""

    def __init__(self, tolerance: float) -> None:
        self._tolerance = tolerance
        # Cells twice as wide as the tolerance: what is near a point lies in at most four of them.
        self._cell = max(2 * tolerance, 1e-200)
        self._grid: dict[tuple[int, int], list[int]] = {}
        self._at: dict[tuple[float, float], int] = {}
        self._points: list[tuple[float, float]] = []
        self._joined = Sets()
        self._place: dict[int, FloatArray] = {}
        self._settled: set[int] = set()

    def join(self, points: list[FloatArray], place: FloatArray) -> None:
        """Says that several points are one place, which lies at `place` unless it had one before."""
        found = sorted({self.find(point) for point in points})
        keep = found[0]
        fresh = self._settled.isdisjoint(found)
        for other in found[1:]:
            self._joined.merge(keep, other)
            self._place.pop(other)
        if fresh:
            self._place[keep] = np.asarray(place, dtype=np.float64)
        self._settled.add(keep)

    def find(self, point: FloatArray) -> int:
        """Number of the place at a point, a new one if there is none."""
        x, y = float(point[0]), float(point[1])
        known = self._at.get((x, y))
        if known is None:
            known = self._nearest(x, y)
        if known is not None:
            return self._joined.find(known)
        number = len(self._points)
        self._points.append((x, y))
        self._at[x, y] = number
        self._grid.setdefault((math.floor(x / self._cell), math.floor(y / self._cell)), []).append(number)
        self._place[number] = np.asarray(point, dtype=np.float64)
        return number

    def place(self, number: int) -> FloatArray:
        """Where a place lies, (2,)."""
        return self._place[number]

    def all(self) -> dict[int, FloatArray]:
        """Where each place lies."""
        return dict(self._place)

    def _nearest(self, x: float, y: float) -> int | None:
        """The nearest point within the tolerance; of two as near, the earlier."""
        reach, cell = self._tolerance, self._cell
        best: tuple[float, int] | None = None
        for column in range(math.floor((x - reach) / cell), math.floor((x + reach) / cell) + 1):
            for row in range(math.floor((y - reach) / cell), math.floor((y + reach) / cell) + 1):
                for number in self._grid.get((column, row), ()):
                    dx, dy = self._points[number][0] - x, self._points[number][1] - y
                    far = (math.sqrt(dx * dx + dy * dy), number)
                    if far[0] <= reach and (best is None or far < best):
                        best = far
        return None if best is None else best[1]
