"""Where strokes truly meet: found from the clean part of each arm, not from the ink where they overlap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.strand_graph import Network
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import angle, angle_of, horner, nearest_along, polynomial

# In stroke widths.
_ARM = 3.0
# On noisy strokes models look farther, as long as they miss the points no more for it.
_NOISY = 0.006
_FARTHER = (4.5, 6.5)
_SAME = 1.1
_SLACK = 0.001
_MARGIN = 0.1
_SNAP_RAD = math.radians(20)
PAIR_RAD = math.radians(40)
_KINK_RAD = math.radians(18)
_CLOSE = 2.5


@dataclass(frozen=True, eq=False)
class Arm:
    """The clean part of a strand at one of its ends, walked outward; `cut` counts the points before it."""

    strand: int
    end: int
    cut: int
    points: FloatArray
    width_px: float

    @cached_property
    def along(self) -> FloatArray:
        """Length from the first point, (n,)."""
        return lengths(self.points)

    @property
    def length(self) -> float:
        """Length in pixels."""
        return float(self.along[-1])

    def near(self, reach: float) -> tuple[FloatArray, FloatArray]:
        """Lengths and points up to `reach` from the cut, at least three."""
        count = max(3, int(np.searchsorted(self.along, reach, side="right")))
        return self.along[:count], self.points[:count]

    @property
    def model(self) -> FloatArray:
        """Coefficients (3, 2) of a quadratic in the length from the cut (negative towards the junction)."""
        return self._fit[0]

    @property
    def reach(self) -> float:
        """How far the model looks; farther where the stroke is noisy and keeps its course."""
        return self._fit[1]

    @cached_property
    def _fit(self) -> tuple[FloatArray, float]:
        best, rms = (np.zeros((3, 2)), 0.0), np.inf
        for share in (_ARM, *_FARTHER):
            reach = share * self.width_px
            along, points = self.near(reach)
            if along[-1] <= 1.2 * self.width_px:
                return np.vstack([polynomial(along, points, 1), np.zeros((1, 2))]), reach
            a, b, c = model = polynomial(along, points, 2)
            x = along[:, None]
            missed = float(np.sqrt(((a + x * (b + x * c) - points) ** 2).sum() / len(points)))
            if missed > _SAME * rms + _SLACK * self.width_px:
                return best
            best, rms = (model, reach), min(missed, rms)
            if missed < _NOISY * self.width_px or along[-1] < 0.9 * reach:
                return best
        return best

    def at(self, along: float) -> tuple[FloatArray, FloatArray]:
        """Place and outward unit direction on the model."""
        x, y, dx, dy = horner(self.terms, along)
        return np.array([x, y]), np.array([dx, dy])

    @cached_property
    def terms(self) -> list[list[float]]:
        return self.model.tolist()


@dataclass(frozen=True, eq=False)
class Ending:
    """How a strand leaves a junction: outward unit tangent, points that lead to the cut, and the cut."""

    tangent: FloatArray
    lead: FloatArray
    cut: int


def arm(line: Line, strand: int, end: int, width_px: float) -> Arm:
    """The arm of a strand at one end: from its first three clean points on, or its middle if it has none."""
    points = line.points if end == 0 else line.points[::-1]
    clean = line.clean if end == 0 else line.clean[::-1]
    along = line.along if end == 0 else line.along[-1] - line.along[::-1]
    run = clean[:-2] & clean[1:-1] & clean[2:]
    first = int(np.argmax(run)) if run.any() else -1
    if first >= 0:
        first = int(np.searchsorted(along, along[first] + _MARGIN * width_px))
        after = clean[first + 1 :]
        stop = first + 1 + (len(after) if after.all() else int(np.argmin(after)))
        if stop - first < 4 and first + 4 <= len(points):
            stop = first + 4
    if first < 0 or stop - first < 4:
        first, stop = len(points) // 3, max(len(points) - len(points) // 3, len(points) // 3 + 2)
    return Arm(strand, end, first, points[first:stop], width_px)


def arms_at(net: Network, lines: dict[int, Line], node: int, width_px: float) -> list[Arm]:
    """The arms of a node."""
    return [arm(lines[strand], strand, end, width_px) for strand, end in net.ends_at(node)]


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


def kinked(a: Arm, b: Arm) -> bool:
    """Whether two arms meet at an angle rather than in one smooth curve: where both are known up close."""
    gap = float(np.linalg.norm(b.points[0] - a.points[0]))
    if gap > _CLOSE * a.width_px or min(a.length, b.length) < _MARGIN * 10 * a.width_px:
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


def place(
    arms: list[Arm], around: FloatArray, pairs: list[tuple[int, int]]
) -> tuple[FloatArray, list[Ending]]:
    """The point where the arms meet, and how each leaves it; `pairs` of arms continue each other.

    The point minimises the weighted squared distance to one curve through each pair of arms (weight 1),
    to the extrapolated single arms (0.3), and weakly to `around`.
    """
    curves = [through(arms[i], arms[j]) for i, j in pairs]
    single = [k for k in range(len(arms)) if not any(k in pair_ for pair_ in pairs)]
    point: FloatArray = around
    feet = [0.0] * len(curves)
    # Two curves fix the point, even where they cross at an acute angle.
    prior = 0.01 if len(curves) < 2 else 1e-4
    for _ in range(3):
        pulls = []
        for k, curve in enumerate(curves):
            feet[k] = curve.foot(point, feet[k])
            pulls.append((1.0, *horner(curve.terms, feet[k])))
        for k in single:
            along = nearest_along(arms[k].terms, point, 0.0, -4 * arms[k].width_px, 0.0)
            pulls.append((0.3, *horner(arms[k].terms, along)))
        point = _pulled(point, prior, pulls)
    endings: dict[int, Ending] = {}
    for (i, j), curve, foot in zip(pairs, curves, feet, strict=True):
        foot_now = curve.foot(point, foot)
        direction = curve.at(foot_now)[1]
        offset = point - curve.at(foot_now)[0]
        endings[i] = Ending(-direction, _lead(curve, foot_now, -curve.gap / 2, offset, arms[i]), arms[i].cut)
        endings[j] = Ending(direction, _lead(curve, foot_now, curve.gap / 2, offset, arms[j]), arms[j].cut)
    through_tangents = [endings[k].tangent for k in endings]
    for k in single:
        endings[k] = _single_ending(arms[k], point, through_tangents)
    return point, [endings[k] for k in range(len(arms))]


def _pulled(
    point: FloatArray, prior: float, pulls: list[tuple[float, float, float, float, float]]
) -> FloatArray:
    """The point nearest to lines, each with a weight, a place and a direction, and weakly to itself."""
    xx = yy = prior
    xy, right_x, right_y = 0.0, prior * float(point[0]), prior * float(point[1])
    for weight, x, y, dx, dy in pulls:
        across = weight * (dx * y - dy * x)
        xx, xy, yy = xx + weight * dy * dy, xy - weight * dx * dy, yy + weight * dx * dx
        right_x, right_y = right_x - dy * across, right_y + dx * across
    determinant = xx * yy - xy * xy
    return np.array([yy * right_x - xy * right_y, xx * right_y - xy * right_x]) / determinant


def _extrapolated(single: Arm, point: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Place and direction of the arm's model nearest to a point before its cut."""
    return single.at(nearest_along(single.terms, point, 0.0, -4 * single.width_px, 0.0))


def _single_ending(single: Arm, point: FloatArray, tangents: list[FloatArray]) -> Ending:
    on, direction = _extrapolated(single, point)
    start = single.points[0]
    gap = float(np.linalg.norm(start - point))
    for tangent in tangents:
        if angle(tangent, direction) < _SNAP_RAD:
            return Ending(tangent, np.zeros((0, 2)), single.cut)
    if np.linalg.norm(on - point) > 0.3 * gap:
        # The extrapolation misses the junction: a plain line from there is the better guess.
        direction = unit(start - point) if gap > 1e-6 else direction
    return Ending(direction, np.zeros((0, 2)), single.cut)


def _lead(curve: Through, foot: float, cut: float, offset: FloatArray, to: Arm) -> FloatArray:
    """Points on the curve between the junction and the cut, the junction's offset fading out."""
    count = int(abs(cut - foot) / max(to.width_px / 4, 1.0))
    if count < 2 or (cut - foot) * cut <= 0:
        return np.zeros((0, 2))
    share = np.arange(1, count) / count
    powers = (foot + share * (cut - foot))[:, None] ** np.arange(len(curve.coefficients))
    return powers @ curve.coefficients + (1 - share)[:, None] * offset
