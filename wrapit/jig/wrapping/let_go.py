"""What becomes of a wire that was wrapped round walls under tension, once it is let go."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths, steps
from wrapit.jig.model import Course
from wrapit.jig.wrapping.courses import grown

# A wire lies on a wall where the middle of a step of its course is so near to it. Courses follow walls from
# corner to corner; a hair of 1e-3 mm gives way where a drawn wire touches one.
LIES_MM = 5e-3
# What of the last wall's hold may be interrupted and is still the same hold: the narrowest wall's width.
INTERRUPTED_MM = 0.8


@dataclass(frozen=True, eq=False)
class Bends:
    """The bends of a taut wire, one at each inner point of its course (n, 2).

    `turned_rad` (n - 2,) is each bend's angle, `lies_mm` (n - 1,) how much of each step lies on a wall: all
    or nothing.
    """

    points: FloatArray
    turned_rad: FloatArray
    lies_mm: FloatArray

    @classmethod
    def of(cls, course: Course, walls: Iterable[Any], diameter_mm: float) -> Bends:
        """The bends of a wire laid round these walls and pins (shapely)."""
        import shapely

        points = course.taut
        along = np.diff(points, axis=0)
        heading = np.arctan2(along[:, 1], along[:, 0])
        turned = (np.diff(heading) + np.pi) % (2 * np.pi) - np.pi
        rims = grown(walls, diameter_mm).boundary
        middles = shapely.points((points[:-1] + points[1:]) / 2)
        return cls(points, turned, steps(points) * (shapely.distance(middles, rims) < LIES_MM))

    @property
    def held_mm(self) -> FloatArray:
        """How much wire lies on a wall around each bend (n - 2,)."""
        return (self.lies_mm[:-1] + self.lies_mm[1:]) / 2

    def let_go(self, loss_per_mm: float, of: NDArray[np.bool_] | None = None) -> FloatArray:
        """The wire (n, 2) once its bends, all or those `of`, have lost what its metal springs back."""
        lost = np.sign(self.turned_rad) * np.minimum(np.abs(self.turned_rad), loss_per_mm * self.held_mm)
        if of is not None:
            lost = np.where(of, lost, 0.0)
        back = -np.concatenate([[0.0], np.cumsum(lost)])
        (x, y), cos, sin = np.diff(self.points, axis=0).T, np.cos(back), np.sin(back)
        moved = np.column_stack([cos * x - sin * y, sin * x + cos * y])
        return np.concatenate([self.points[:1], self.points[0] + np.cumsum(moved, axis=0)])

    @property
    def last_hold(self) -> NDArray[np.bool_]:
        """Which bends (n - 2,) are those round the last wall before the wire's end."""
        lying = np.flatnonzero(self.lies_mm)
        if not len(lying):
            return np.zeros(len(self.turned_rad), dtype=bool)
        along = lengths(self.points)
        apart_mm = along[lying[1:]] - along[lying[:-1] + 1]
        breaks = np.flatnonzero(apart_mm > INTERRUPTED_MM)
        first = lying[breaks[-1] + 1] if len(breaks) else lying[0]
        return (np.arange(len(self.turned_rad)) >= first - 1) & (self.held_mm > 0)

    def end_moves_mm(self, loss_per_mm: float) -> float:
        """How far the wire's end springs aside that is let go after the last wall."""
        return math.dist(self.let_go(loss_per_mm, self.last_hold)[-1], self.points[-1])
