"""One exact B-spline from a chain of Béziers and back: no refit, corners only where the chain has them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.geometry.arrays import FloatArray, locked
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.polyline import total_length

# A joint pole nearer than this (mm) to the place that one smooth spline gives it is dropped. That is what
# rounding leaves of a joint with one tangent; the kernel's own tolerance for one point is 1e-7 mm. On two of
# our drawings a third more or less changes nothing.
SMOOTH_JOINT_MM = 5e-7


@dataclass(frozen=True, eq=False)
class BSpline:
    """A clamped planar B-spline; `poles` (n, 2), `knots` (n + degree + 1,) with every repetition."""

    degree: int
    poles: FloatArray
    knots: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "poles", locked(self.poles))
        object.__setattr__(self, "knots", locked(self.knots))
        if len(self.knots) != len(self.poles) + self.degree + 1:
            raise ValueError("a B-spline has poles + degree + 1 knots")
        if (np.diff(self.knots) < 0).any():
            raise ValueError("the knots of a B-spline don't fall")

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return float(self.knots[0]), float(self.knots[-1])

    @cached_property
    def breaks(self) -> FloatArray:
        """Distinct knots, (m,)."""
        return np.unique(self.knots)

    def at(self, u: FloatArray) -> FloatArray:
        """Points at parameters (m,): (m, 2)."""
        return self._pieces(u)

    def derivative(self, u: FloatArray, order: int = 1) -> FloatArray:
        """Derivatives at parameters (m,): (m, 2)."""
        if order not in self._derivatives:
            self._derivatives[order] = self._pieces.derivative(order)
        return np.asarray(self._derivatives[order](u))

    def curvature(self, u: FloatArray) -> FloatArray:
        """Signed curvature at parameters (m,), positive where the curve turns left."""
        d, dd = self.derivative(u), self.derivative(u, 2)
        speed = np.linalg.norm(d, axis=1)
        return (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.maximum(speed, 1e-12) ** 3

    @cached_property
    def chain(self) -> BezierChain:
        """See `chain_of`."""
        if self.degree != 3:
            raise ValueError(f"only cubic splines become cubic Béziers, not degree {self.degree}")
        cubics = [
            [_blossom(self, index, values) for values in ((a, a, a), (a, a, b), (a, b, b), (b, b, b))]
            for index, (a, b) in enumerate(itertools.pairwise(self.knots))
            if b > a
        ]
        points = np.array(cubics)
        points[1:, 0] = points[:-1, 3]
        points[0, 0], points[-1, 3] = self.poles[0], self.poles[-1]
        return BezierChain(points)

    @cached_property
    def _derivatives(self) -> dict[int, Any]:
        """Those of `_pieces` that were asked for, by their order."""
        return {}

    @cached_property
    def _pieces(self) -> Any:
        """The same curve as polynomials between the breaks: these have derivatives at corners too."""
        from scipy.interpolate import BSpline as ScipyBSpline
        from scipy.interpolate import PPoly

        spline = ScipyBSpline(self.knots, self.poles, self.degree)
        orders = range(self.degree, -1, -1)
        taylor = [spline(self.breaks[:-1], nu=order) / math.factorial(order) for order in orders]
        return PPoly(np.array(taylor), self.breaks)


def from_chain(chain: BezierChain) -> BSpline:
    """The chain as ONE clamped cubic B-spline with the same points, within SMOOTH_JOINT_MM at joints.

    Knot steps follow the ratio of the derivatives at each joint, so a joint with one tangent (G1)
    becomes a double knot (C1) and its pole disappears; triple knots stay only at corners.
    """
    steps, smooth = _knot_steps(chain.points)
    poles = [chain.points[0, 0], chain.points[0, 1], chain.points[0, 2]]
    knots = [0.0] * 4
    at = 0.0
    for index in range(1, len(chain)):
        at += steps[index - 1]
        knots += [at] * (2 if smooth[index - 1] else 3)
        if not smooth[index - 1]:
            poles.append(chain.points[index, 0])
        poles += [chain.points[index, 1], chain.points[index, 2]]
    poles.append(chain.end)
    knots += [at + steps[-1]] * 4
    return BSpline(3, np.array(poles), np.array(knots))


def chain_of(spline: BSpline) -> BezierChain:
    """The same curve as cubic Béziers, one for each knot span; ValueError unless the degree is 3.

    Control points are the spline's blossoms at the span's ends (Ramshaw 1987), so corners stay corners.
    """
    return spline.chain


def _knot_steps(points: FloatArray) -> tuple[list[float], list[bool]]:
    """Knot step of each Bézier, and for each joint whether one tangent passes it."""
    steps = [_chord(points[0])]
    smooth = []
    for before, after in itertools.pairwise(points):
        arriving, leaving = np.linalg.norm(before[3] - before[2]), np.linalg.norm(after[1] - after[0])
        if min(arriving, leaving) > 1e-6:
            step = steps[-1] * float(leaving / arriving)
            pole = (step * before[2] + steps[-1] * after[1]) / (step + steps[-1])
            if np.linalg.norm(pole - after[0]) <= SMOOTH_JOINT_MM:
                steps.append(step)
                smooth.append(True)
                continue
        steps.append(_chord(after))
        smooth.append(False)
    return steps, smooth


def _chord(cubic: FloatArray) -> float:
    return max(total_length(cubic), 1e-6)


def _blossom(spline: BSpline, index: int, values: tuple[float, float, float]) -> FloatArray:
    """Polar form of the polynomial on knot span `index` (de Boor's recursion with three parameters)."""
    poles = [spline.poles[index - 3 + j] for j in range(4)]
    for level, value in enumerate(values, start=1):
        for j in range(3, level - 1, -1):
            low, high = spline.knots[index - 3 + j], spline.knots[index + 1 + j - level]
            share = (value - low) / (high - low)
            poles[j] = (1 - share) * poles[j - 1] + share * poles[j]
    return poles[3]
