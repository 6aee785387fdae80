"""Free ground cut into triangles that know their neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from wrapit.geometry import FloatArray, IntArray, locked

# What stands for a neighbour where the ground ends.
OUTSIDE = -1


@dataclass(frozen=True, eq=False)
class Triangles:
    """`points` (v, 2) in mm; `corners` (t, 3), each triangle's points counter-clockwise; `neighbours` (t, 3).

    Side k of a triangle runs from its corner k to its corner k + 1; `neighbours[t, k]` is the triangle beyond
    it, or OUTSIDE.
    """

    points: FloatArray
    corners: IntArray
    neighbours: IntArray

    @classmethod
    def of(cls, ground: BaseGeometry) -> Triangles:
        """The constrained Delaunay triangulation of polygons; it has no points but theirs."""
        cut = shapely.constrained_delaunay_triangles(ground)
        rings = shapely.get_coordinates(cut).reshape(-1, 4, 2)[:, :3]
        (ax, ay), (bx, by), (cx, cy) = rings.transpose(1, 2, 0)
        clockwise = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) < 0
        rings[clockwise] = rings[clockwise, ::-1]
        # One number for each point, so that equal ones are found by one sort of numbers.
        places, numbers = np.unique(rings[..., 0] + 1j * rings[..., 1], return_inverse=True)
        corners = numbers.reshape(-1, 3).astype(np.int64)
        points = np.column_stack([places.real, places.imag])
        neighbours = _neighbours(corners, len(points))
        corners.setflags(write=False)
        neighbours.setflags(write=False)
        return cls(locked(points), corners, neighbours)

    def holding(self, place: FloatArray) -> int:
        """The triangle that `place` (2,) lies deepest in; OUTSIDE if it lies in none."""
        start = self.points[self.corners] - place
        end = np.roll(start, -1, axis=1)
        along = np.hypot(*(end - start).transpose(2, 0, 1))
        depth = ((start[..., 0] * end[..., 1] - start[..., 1] * end[..., 0]) / np.maximum(along, 1e-300)).min(
            axis=1
        )
        deepest = int(np.argmax(depth))
        return deepest if depth[deepest] > -ROUNDING_MM else OUTSIDE


# A place that lies no further outside of a triangle lies in it: far more than doubles lose at coordinates
# of 1000 mm (1e-13), a millionth of the hair that keeps paths off the ground's edge. Starts in 400 random
# fields of 40 mm lay at least 8e-6 inside: it takes effect only for what was not given to `around`.
ROUNDING_MM = 1e-9


def _neighbours(corners: IntArray, points: int) -> IntArray:
    """Which triangle lies beyond each side (t, 3)."""
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    key = np.minimum(start, end) * points + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    twins = np.flatnonzero(key[order][1:] == key[order][:-1])
    here, there = order[twins], order[twins + 1]
    beyond = np.full(len(key), OUTSIDE, dtype=np.int64)
    beyond[here], beyond[there] = there // 3, here // 3
    return beyond.reshape(-1, 3)
