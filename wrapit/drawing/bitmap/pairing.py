"""Which arms of a junction continue each other, and the curve through each such pair."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.drawing.bitmap.arms import Arm
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polynomials import angle, angle_of, horner, nearest_along, polynomial

# How much may a stroke turn at a junction? Set on prototypes; 28 or 52 degrees make no difference to the
# pictures measured.
PAIR_RAD = math.radians(40)
# When are two arms an angle, not a curve? Where both are known (a width of clean points each) within 2.5
# widths of each other and still differ by 18 degrees. 23 degrees, or 1.75 widths, smooth true kinks over:
# tangents 0.88 instead of 0.81 degrees off.
_KINK_RAD = math.radians(18)
_CLOSE = 2.5
_KNOWN = 1.0
# When is there a step from one arm to another? Where they are as good as parallel and, carried on to the
# middle between them, lie more than half a width beside each other: a step that the ink shows on both sides.
_PARALLEL_RAD = math.radians(25)
_BESIDE = 0.5


def turn(a: Arm, b: Arm) -> float:
    """How much a wire would bend that leaves by `b` after arriving by `a`, in radians."""
    (ax, ay), (bx, by) = a.points[0].tolist(), b.points[0].tolist()
    chord = (bx - ax, by - ay)
    gap = math.hypot(*chord)
    straight = math.pi
    if gap > 1e-9:
        straight = angle_of(_arriving(a, 0.0), chord) + angle_of(chord, horner(b.terms, 0.0)[2:])
    reach = -min(gap / 2, 1.5 * a.width_px)
    extrapolated = angle_of(_arriving(a, reach), horner(b.terms, reach)[2:])
    return min(straight, extrapolated + straight / 4)


def _arriving(arm: Arm, along: float) -> tuple[float, float]:
    """Direction of travel towards the junction."""
    _, _, dx, dy = horner(arm.terms, along)
    return -dx, -dy


def stepped(a: Arm, b: Arm) -> bool:
    """Whether two arms run on beside each other: two strokes that end on either side of a third."""
    if min(a.length, b.length) < _KNOWN * a.width_px:
        return False
    gap = b.points[0] - a.points[0]
    reach = -float(np.linalg.norm(gap)) / 2
    (at, leaving), (to, arriving) = a.at(reach), b.at(reach)
    if angle(-leaving, arriving) > _PARALLEL_RAD:
        return False
    along = unit(arriving - leaving)
    return abs(float((to - at) @ np.array([-along[1], along[0]]))) > _BESIDE * a.width_px


def kinked(a: Arm, b: Arm) -> bool:
    """Whether two arms meet at an angle rather than in one smooth curve: where both are known up close."""
    gap = float(np.linalg.norm(b.points[0] - a.points[0]))
    if gap > _CLOSE * a.width_px or min(a.length, b.length) < _KNOWN * a.width_px:
        return False
    return angle(-a.at(-gap / 2)[1], b.at(-gap / 2)[1]) > _KINK_RAD


def pair(arms: list[Arm], limit: float = PAIR_RAD) -> list[tuple[int, int]]:
    """The pairs of arms that continue each other, by the least sum of squared turns; others stay single.

    A single arm costs as much as a turn at the limit.
    """
    cost = {(i, j): turn(arms[i], arms[j]) ** 2 for i in range(len(arms)) for j in range(i + 1, len(arms))}
    allowed = {pair_: value for pair_, value in cost.items() if value < limit**2}

    def best(free: tuple[int, ...]) -> tuple[float, list[tuple[int, int]]]:
        if len(free) < 2:
            return limit**2 / 2 * len(free), []
        first, rest = free[0], free[1:]
        value, pairs = best(rest)
        value += limit**2 / 2
        for other in rest:
            if (first, other) in allowed:
                inner, found = best(tuple(k for k in rest if k != other))
                if inner + allowed[first, other] < value:
                    value, pairs = inner + allowed[first, other], [(first, other), *found]
        return value, pairs

    if len(arms) > 10:
        return _greedy(allowed)
    return best(tuple(range(len(arms))))[1]


def unkinked(arms: list[Arm], pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Those of the pairs that don't meet at an angle."""
    return [(i, j) for i, j in pairs if not kinked(arms[i], arms[j])]


def _greedy(allowed: dict[tuple[int, int], float]) -> list[tuple[int, int]]:
    taken: set[int] = set()
    pairs = []
    for i, j in sorted(allowed, key=lambda key: (allowed[key], key)):
        if i not in taken and j not in taken:
            taken |= {i, j}
            pairs.append((i, j))
    return pairs


@dataclass(frozen=True, eq=False)
class Through:
    """One curve through two arms: quartic in the length, zero midway between the cuts."""

    coefficients: FloatArray
    gap: float

    def at(self, along: float) -> tuple[FloatArray, FloatArray]:
        """Place and unit direction (from the first arm to the second)."""
        x, y, dx, dy = horner(self.terms, along)
        return np.array([x, y]), np.array([dx, dy])

    @cached_property
    def terms(self) -> list[list[float]]:
        return self.coefficients.tolist()

    def foot(self, point: FloatArray, along: float) -> float:
        """Where the curve comes nearest to a point, starting the search at `along`."""
        return nearest_along(self.terms, point, along, -0.75 * self.gap, 0.75 * self.gap)


def through(a: Arm, b: Arm) -> Through:
    """The curve through two arms that continue each other."""
    gap = float(np.linalg.norm(b.points[0] - a.points[0]))
    along_a, points_a = a.near(max(a.reach, 0.6 * gap))
    along_b, points_b = b.near(max(b.reach, 0.6 * gap))
    shortest = min(along_a[-1], along_b[-1]) / a.width_px
    degree = 4 if shortest > 1.5 else 3 if shortest > 0.7 else 2
    along = np.concatenate([-along_a - gap / 2, along_b + gap / 2])
    return Through(polynomial(along, np.vstack([points_a, points_b]), degree), gap)
