"""Smooth runs of cubics as few long edges: one polynomial each, so that whoever integrates them is exact."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import comb
from typing import Any

import numpy as np

from wrapit.geometry import BSpline, FloatArray, IntArray
from wrapit.geometry.arrays import unit
from wrapit.geometry.bezier import derivative
from wrapit.geometry.polyline import steps

# How many spans may an edge have? OCCT (and every program on it) integrates areas and volumes along a whole
# edge with ONE Gauss rule, of 2 (degree + 1) nodes a span and 61 at most: exact over one polynomial, wrong by
# up to 1.4e-3 of a jig's volume over cubics in a row, whose second derivatives leap. So an edge is one
# polynomial, and it gets long by its degree. The table of spans and degrees is in README.md.
DEGREES = (5, 8, 12, 16)
# How near is it to the cubics where both are compared? Between these places up to 3e-5; together with
# theirs to the true parallel (2e-5) this is 5e-5.
RUN_TOLERANCE_MM = 2.5e-5
# How far may an edge turn? Short of a full turn, so that no edge closes on itself; the rest is met by the
# tolerance.
MOST_TURNING_RAD = np.pi
# Which cubics are too short for an edge? The kernel takes points within 1e-7 for one, and edges of no length
# broke meshes.
SLIVER_MM = 1e-6
# Which joints are smooth? Rounding leaves less than a milliradian of one tangent over handles of 1 um; the
# gaps between cubics of one parallel are far smaller.
SMOOTH_RAD = 1e-3
# Into how many parts is a cubic divided where it is compared and its length measured, and with which rule?
# A turn of 0.8 rad is measured to 1e-9.
PARTS = 8
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)
# How many points for each free pole hold a run to its cubics?
POINTS_A_POLE = 3
# How much does it count that points are late or early along the cubics, against how far they lie beside them?
# Nobody sees the first, and a polynomial that may choose follows farther: the jigs of butterfly, leaf and owl
# have 958 runs with 0.02 and 0.03, 969 with 0.01; with 0.001 some slow down to half their speed.
ALONG_WEIGHT = 0.02
# How much do the poles' third differences count, in tolerances, and how long may the line through the poles
# be, in lengths of the run? Left free, poles of degree 16 leap 2000 lengths away; the kernel sums up powers,
# which lose nine digits then, and finds ends 1e-6 mm apart ("courbes non jointives"). So they lose 3e-10 mm.
# The same jigs have 957 runs with 0.7 tolerances, 966 with 2.0.
POLES_WEIGHT = 1.0
LONGEST_POLES = 1.5
# How often is a point's nearest place on the cubics bettered? It starts within 1 % of the run's length.
_FOOT_STEPS = 2


@cache
def _trials(degree: int) -> tuple[FloatArray, FloatArray]:
    """Shares of a run where it is held to its cubics, and Bernstein's polynomials there."""
    count = POINTS_A_POLE * degree
    # Dense at the ends, as polynomials of a high degree want it.
    places = (1 - np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2
    return places, _bernstein(degree, places)


@dataclass(frozen=True, eq=False)
class _Measured:
    """Cubics (n, 4, 2), each divided in PARTS: lengths and speeds (n, PARTS + 1) there, turning (n,)."""

    cubics: FloatArray
    upto: FloatArray
    speeds: FloatArray
    turning: FloatArray

    @cached_property
    def end_tangents(self) -> tuple[FloatArray, FloatArray]:
        """Unit directions of travel at the start and at the end, (2,) each."""
        first, last = self.cubics[0], self.cubics[-1]
        return unit(first[1] - first[0]), unit(last[3] - last[2])

    def part(self, first: int, last: int) -> _Measured:
        """Some of the cubics."""
        at = slice(first, last)
        return _Measured(self.cubics[at], self.upto[at], self.speeds[at], self.turning[at])


def smooth_runs(cubics: FloatArray, tolerance_mm: float = RUN_TOLERANCE_MM) -> list[BSpline]:
    """Cubics (n, 4, 2) without corners as few splines of one span each, end to end.

    Ends are those of the cubics, exactly, tangents there too; between them the tolerance holds.
    """
    whole = _measured(cubics)
    runs, first = [], 0
    while first < len(whole.cubics):
        run, count = _longest(whole, first, tolerance_mm)
        runs.append(run)
        first += count
    return runs


def between_corners(cubics: FloatArray) -> list[FloatArray]:
    """Cubics (n, 4, 2) in groups, each without a corner inside."""
    long = without_slivers(cubics)
    leaving, arriving = unit(long[1:, 1] - long[1:, 0]), unit(long[:-1, 3] - long[:-1, 2])
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    smooth = (np.abs(cross) < SMOOTH_RAD) & ((arriving * leaving).sum(axis=1) > 0)
    return np.split(long, np.flatnonzero(~smooth) + 1)


def without_slivers(points: FloatArray) -> FloatArray:
    """The cubics (n, 4, 2) less those too short for an edge of their own; the ends stay where they are."""
    long = steps(points).sum(axis=1) > SLIVER_MM
    if long.all() or not long.any():
        return points
    kept = points[long].copy()
    kept[1:, 0] = kept[:-1, 3]
    kept[0, 0], kept[-1, 3] = points[0, 0], points[-1, 3]
    return kept


def swept_area_mm2(run: BSpline) -> float:
    """Exact signed area between the run, of one span, and the origin (Green's theorem, Gauss's rule)."""
    low, high = run.domain
    nodes, weights = np.polynomial.legendre.leggauss(run.degree)
    u = (low + high) / 2 + nodes * (high - low) / 2
    (x, y), (dx, dy) = run.at(u).T, run.derivative(u).T
    return float(((x * dy - y * dx) * weights).sum() * (high - low) / 4)


def _longest(whole: _Measured, first: int, tolerance_mm: float) -> tuple[BSpline, int]:
    """The longest run from one cubic on: its length doubled while it fits, then halved in."""
    count, step = 1, 1
    best = _as_it_is(whole.cubics[first])
    grows = True
    while step:
        tried = min(count + step, len(whole.cubics) - first)
        run = None
        if tried > count:  # what is longer wants no lower a degree
            degrees = [degree for degree in DEGREES if degree >= best.degree]
            run = _fitted(whole.part(first, first + tried), degrees, tolerance_mm)
        if run is not None:
            best, count = run, tried
            step = step * 2 if grows else step // 2
        else:
            grows, step = False, step // 2
    return best, count


def _as_it_is(cubic: FloatArray) -> BSpline:
    return BSpline(3, cubic, np.repeat([0.0, max(float(steps(cubic).sum()), SLIVER_MM)], 4))


def _fitted(part: _Measured, degrees: Sequence[int], tolerance_mm: float) -> BSpline | None:
    """One polynomial, of the first of the degrees that follows all the cubics, or None."""
    if float(part.turning.sum()) > MOST_TURNING_RAD:
        return None
    ends = np.concatenate([[0.0], np.cumsum(part.upto[:, -1])])
    length = float(ends[-1])
    everywhere = ((part.upto[:, 1:-1] + ends[:-1, None]) / length).ravel()
    for degree in degrees:
        poles = _least_squares(part, ends, degree, POLES_WEIGHT * tolerance_mm)
        if not _is_tame(part, poles, length):
            continue
        places = np.sort(np.concatenate([_trials(degree)[0], everywhere]))
        if _error(part, ends, poles, places) <= tolerance_mm:
            return BSpline(degree, poles, np.repeat([0.0, length], degree + 1))
    return None


def _least_squares(part: _Measured, ends: FloatArray, degree: int, evenness: float) -> FloatArray:
    """Poles (degree + 1, 2) with the ends and end tangents of the cubics, nearest to them between.

    Unknown are the lengths of both handles and the poles between; what lies along the cubics counts
    ALONG_WEIGHT of what lies across, third differences of the poles between count `evenness`.
    """
    leaving, arriving = part.end_tangents
    handle = ends[-1] / degree
    poles = np.repeat(np.stack([part.cubics[0, 0], part.cubics[-1, 3]]), [2, degree - 1], axis=0)
    poles[1] += handle * leaving
    poles[-2] -= handle * arriving
    poles[2:-2] = 0.0
    places, basis = _trials(degree)
    points, along = _at(part, ends, places)
    rest = points - basis @ poles
    rows, values = [], []
    for axis, weight in ((np.column_stack([-along[:, 1], along[:, 0]]), 1.0), (along, ALONG_WEIGHT)):
        pulls = [basis[:, 1] * (axis @ leaving), -basis[:, -2] * (axis @ arriving)]
        inner = basis[:, 2:-2]
        rows.append(weight * np.column_stack([*pulls, inner * axis[:, :1], inner * axis[:, 1:]]))
        values.append(weight * (rest * axis).sum(axis=1))
    even = evenness * np.diff(np.eye(degree - 3), 3, axis=0)
    none, handles = np.zeros_like(even), np.zeros((len(even), 2))
    rows += [np.column_stack([handles, even, none]), np.column_stack([handles, none, even])]
    values.append(np.zeros(2 * len(even)))
    found = np.linalg.lstsq(np.concatenate(rows), np.concatenate(values), rcond=None)[0]
    poles[1] += found[0] * leaving
    poles[-2] -= found[1] * arriving
    poles[2:-2] = found[2:].reshape(2, -1).T
    return poles


def _is_tame(part: _Measured, poles: FloatArray, length: float) -> bool:
    """Whether the poles stay near one another, and both handles point the way of the cubics."""
    leaving, arriving = part.end_tangents
    forwards = min((poles[1] - poles[0]) @ leaving, (poles[-1] - poles[-2]) @ arriving) > 0
    return bool(forwards and float(steps(poles).sum()) <= LONGEST_POLES * length)


def _error(part: _Measured, ends: FloatArray, poles: FloatArray, places: FloatArray) -> float:
    """How far the polynomial lies beside the cubics, at most, at places in order; no end if it turns back."""
    got = _bernstein(len(poles) - 1, places) @ poles
    feet = places
    for _ in range(_FOOT_STEPS):
        points, along = _at(part, ends, feet)
        feet = _clipped(feet + ((got - points) * along).sum(axis=1) / ends[-1], 0.0, 1.0)
    if (np.diff(feet) <= 0).any():
        return float("inf")
    points, along = _at(part, ends, feet)
    apart = got - points
    return float(np.abs(apart[:, 0] * along[:, 1] - apart[:, 1] * along[:, 0]).max())


def _at(part: _Measured, ends: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points and unit tangents (m, 2) of the cubics at shares (m,) of their length."""
    along = places * ends[-1]
    which = _clipped(np.searchsorted(ends, along, side="right") - 1, 0, len(part.cubics) - 1)
    rest, upto = along - ends[which], part.upto[which]
    step = _clipped(np.count_nonzero(upto <= rest[:, None], axis=1) - 1, 0, PARTS - 1)
    every = np.arange(len(places))
    low, high = upto[every, step], upto[every, step + 1]
    # t by length, between two places where both it and its derivative are known (Hermite).
    width = high - low
    x = _clipped((rest - low) / width, 0.0, 1.0)
    leaving, arriving = PARTS * width / part.speeds[which, step], PARTS * width / part.speeds[which, step + 1]
    t = x * x * (3 - 2 * x) + x * (1 - x) * ((1 - x) * leaving - x * arriving)
    t = (step + _clipped(t, 0.0, 1.0)) / PARTS
    # Axis by axis, as it takes a third of the time.
    a, b, c, d = part.cubics.transpose(1, 2, 0)[:, :, which]
    s = 1 - t
    ss, tt = s**2, t**2
    points = s**3 * a + 3 * ss * t * b + 3 * s * tt * c + t**3 * d
    pace = ss * (b - a) + 2 * s * t * (c - b) + tt * (d - c)
    return np.ascontiguousarray(points.T), unit(np.ascontiguousarray(pace.T))


def _clipped(values: Any, low: float, high: float) -> Any:
    """As `np.clip`, which takes several times as long for the few places of a run."""
    return np.minimum(np.maximum(values, low), high)


def _bernstein(degree: int, places: FloatArray) -> FloatArray:
    """Bernstein's polynomials at places (m,) from 0 to 1: (m, degree + 1)."""
    k, counts = _powers(degree)
    return counts * places[:, None] ** k * (1 - places[:, None]) ** (degree - k)


@cache
def _powers(degree: int) -> tuple[IntArray, IntArray]:
    """The powers and the factors of Bernstein's polynomials, (degree + 1,) each."""
    k = np.arange(degree + 1)
    return k, np.array([comb(degree, index) for index in k.tolist()])


def _measured(cubics: FloatArray) -> _Measured:
    nodes = ((np.arange(PARTS)[:, None] + (_NODES + 1) / 2) / PARTS).ravel()
    paces = np.linalg.norm(derivative(cubics, nodes), axis=2).reshape(len(cubics), PARTS, -1)
    upto = np.zeros((len(cubics), PARTS + 1))
    upto[:, 1:] = np.cumsum((paces * _WEIGHTS).sum(axis=2) / (2 * PARTS), axis=1)
    along = derivative(cubics, np.linspace(0, 1, PARTS + 1))
    a, b = along[:, :-1], along[:, 1:]
    turns = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(axis=2))
    speeds = np.maximum(np.linalg.norm(along, axis=2), 1e-9)
    return _Measured(cubics, upto, speeds, np.abs(turns).sum(axis=1))
