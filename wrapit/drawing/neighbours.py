"""Which curves can lie on each other: a tree over their boxes, and one over their short steps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.drawing.steps import queried
from wrapit.geometry import FloatArray, IntArray, unit


@dataclass(frozen=True, eq=False)
class Course:
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


class Boxes:
    """The boxes around curves' control points, which hold the curves, widened on all sides."""

    def __init__(self, curves: list[FloatArray], margin: float) -> None:
        from shapely import STRtree, box

        low = np.array([cubics.min(axis=(0, 1)) for cubics in curves]) - margin
        high = np.array([cubics.max(axis=(0, 1)) for cubics in curves]) + margin
        self._boxes = box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
        self._tree = STRtree(self._boxes)

    def meeting(self, curve: int) -> set[int]:
        """Numbers of the curves whose boxes meet that of a curve, its own among them."""
        return set(self._tree.query(self._boxes[curve]).tolist())

    def around(self, point: FloatArray) -> list[int]:
        """Numbers of the curves whose boxes hold a point, ascending."""
        from shapely import Point

        return sorted(self._tree.query(Point(point)).tolist())

    def apart(self) -> set[int]:
        """Numbers of the curves whose boxes meet no other."""
        _, other = self._tree.query(self._boxes)
        return set(np.flatnonzero(np.bincount(other, minlength=len(self._boxes)) == 1).tolist())


def parallels(courses: dict[int, Course], near: float, sine: float) -> dict[int, set[int]]:
    """For each course the earlier ones that it is near to and parallel with at two of its points or more.

    Near: closer than `near` to a step of theirs; parallel: the sine of the angle is less than `sine`.
    """
    from shapely import STRtree, box, linestrings

    found: dict[int, set[int]] = {number: set() for number in courses}
    if len(courses) < 2:
        return found
    points = np.concatenate([course.points for course in courses.values()])
    directions = np.concatenate([course.directions for course in courses.values()])
    owner = np.repeat(list(courses), [len(course.points) for course in courses.values()])
    steps = np.stack([points[:-1], points[1:]], axis=1)[owner[:-1] == owner[1:]]
    of_step = owner[:-1][owner[:-1] == owner[1:]]
    tree = STRtree(linestrings(steps))
    # A little more, so that nothing is lost to rounding.
    near = near * (1 + 1e-9) + 1e-12 * float(np.abs(points).max())
    pairs = []
    for at, step in queried(
        tree, len(points), lambda some: box(*(points[some] - near).T, *(points[some] + near).T)
    ):
        earlier = of_step[step] < owner[at]
        both = np.column_stack([owner[at], of_step[step], at, step])[earlier]
        at_point, at_step = both[:, 2], both[:, 3]
        kept = _beside(points[at_point], directions[at_point], steps[at_step], near, sine + 1e-9)
        pairs.append(np.unique(both[kept, :3], axis=0))
    curves, count = np.unique(np.concatenate(pairs)[:, :2], axis=0, return_counts=True)
    for number, other in curves[count > 1].tolist():
        found[number].add(other)
    return found


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
