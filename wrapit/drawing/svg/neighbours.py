"""Which curves can lie on each other: a tree over their boxes, and one over their short steps."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.drawing.svg.steps import queried
from wrapit.geometry import FloatArray, IntArray, unit

# Polylines in the smallest group, and groups that make a larger one: few trees to ask, few times built anew.
_GROUP = 4


@dataclass(frozen=True, eq=False)
class Polyline:
    """A curve as short steps: points (n, 2), parameters, and lengths from its start."""

    points: FloatArray
    at: FloatArray
    along: FloatArray

    @cached_property
    def directions(self) -> FloatArray:
        """Unit direction of travel at each point, (n, 2)."""
        return unit(np.gradient(self.points, axis=0))

    @cached_property
    def tree(self) -> Any:
        """A tree (scipy's cKDTree) over the points."""
        from scipy.spatial import cKDTree

        return cKDTree(self.points)

    @cached_property
    def box(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper corner around the points, (2,) each."""
        return self.points.min(axis=0), self.points.max(axis=0)

    def covered(self, first: int, last: int) -> float:
        """Length from one point to a later one; beyond the last point it goes round."""
        count = len(self.points)
        length = float(self.along[last % count] - self.along[first % count])
        return length + (float(self.along[-1]) if last >= count or (length <= 0 and last > first) else 0.0)


class Boxes:
    """The boxes around curves' control points, which hold the curves, widened on all sides."""

    def __init__(self, curves: list[FloatArray], margin: float) -> None:
        from shapely import STRtree, box

        low = np.array([cubics.min(axis=(0, 1)) for cubics in curves]) - margin
        high = np.array([cubics.max(axis=(0, 1)) for cubics in curves]) + margin
        self._boxes = box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
        self._tree = STRtree(self._boxes)

    def around(self, point: FloatArray) -> list[int]:
        """Numbers of the curves whose boxes hold a point, ascending."""
        from shapely import Point

        return sorted(self._tree.query(Point(point)).tolist())

    def apart(self) -> set[int]:
        """Numbers of the curves whose boxes meet no other."""
        _, other = self._tree.query(self._boxes)
        return set(np.flatnonzero(np.bincount(other, minlength=len(self._boxes)) == 1).tolist())


class Parallels:
    """Polylines, and which of them run beside another: near to it, and in much the same direction.

    Near: closer than `near` to a step of theirs; much the same: the sine of the angle is less than `sine`.
    Polylines are added one by one, so that what is never added costs nothing. Trees can't grow: the polylines
    are in groups, and as soon as there are several of one size they become one of the next.
    """

    def __init__(self, near: float, sine: float) -> None:
        self._near, self._sine = near, sine
        self._polylines: list[Polyline] = []
        self._waiting: list[int] = []
        self._groups: list[list[_Group]] = []

    def add(self, polyline: Polyline) -> None:
        """Adds a polyline."""
        self._waiting.append(len(self._polylines))
        self._polylines.append(polyline)
        if len(self._waiting) < _GROUP:
            return
        members, self._waiting = self._waiting, []
        for level in itertools.count():
            if level == len(self._groups):
                self._groups.append([])
            if len(self._groups[level]) < _GROUP - 1:
                self._groups[level].append(_Group(self._polylines, members))
                return
            members = [*itertools.chain.from_iterable(g.members for g in self._groups[level]), *members]
            self._groups[level] = []

    def beside(self, polyline: Polyline) -> list[Polyline]:
        """The polylines that may run beside another at two of its points or more, in the order of adding."""
        found = set(self._waiting)
        # A little more, so that nothing is lost to rounding.
        near = self._near * (1 + 1e-9) + 1e-12 * float(np.abs(polyline.points).max())
        for group in itertools.chain.from_iterable(self._groups):
            found |= group.beside(polyline, near, self._sine + 1e-9)
        return [self._polylines[number] for number in sorted(found)]


class _Group:
    """Some of a list of polylines, in a tree over their steps."""

    def __init__(self, polylines: list[Polyline], members: list[int]) -> None:
        from shapely import STRtree, linestrings

        self.members = members
        chosen = [polylines[number].points for number in members]
        self._owner = np.repeat(members, [len(points) - 1 for points in chosen])
        self._steps = np.concatenate([np.stack([points[:-1], points[1:]], axis=1) for points in chosen])
        self._tree = STRtree(linestrings(self._steps))

    def beside(self, polyline: Polyline, near: float, sine: float) -> set[int]:
        """Members that a polyline runs beside at two of its points or more."""
        from shapely import box

        points = polyline.points
        pairs = []
        for at, step in queried(
            self._tree, len(points), lambda some: box(*(points[some] - near).T, *(points[some] + near).T)
        ):
            kept = _beside(points[at], polyline.directions[at], self._steps[step], near, sine)
            pairs.append(np.unique(np.column_stack([self._owner[step], at])[kept], axis=0))
        members, count = np.unique(np.concatenate(pairs)[:, 0], return_counts=True)
        return set(members[count > 1].tolist())


def _beside(
    points: FloatArray, directions: FloatArray, steps: FloatArray, near: float, sine: float
) -> IntArray:
    """Which points are near to a step each, and run along it."""
    d = steps[:, 1] - steps[:, 0]
    along = unit(d)
    share = ((points - steps[:, 0]) * d).sum(axis=1) / np.maximum((d * d).sum(axis=1), 1e-18)
    away = points - steps[:, 0] - np.clip(share, 0, 1)[:, None] * d
    across = np.abs(directions[:, 0] * along[:, 1] - directions[:, 1] * along[:, 0])
    return np.flatnonzero((np.linalg.norm(away, axis=1) < near) & (across < sine))
