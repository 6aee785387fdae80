"""Smooth runs of cubics as few long edges: one polynomial each, so that whoever integrates them is exact."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

import numpy as np

from wrapit.geometry import BSpline, FloatArray
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


@dataclass(frozen=True, eq=False)
class _Measured:
    """Cubics (n, 4, 2), each divided in PARTS: lengths and speeds (n, PARTS + 1) there, turning (n,)."""

    cubics: FloatArray
    upto: FloatArray
    speeds: FloatArray
    turning: FloatArray

    def part(self, first: int, last: int) -> _Measured:
        """Some of the cubics."""
        at = slice(first, last)
        return _Measured(self.cubics[at], self.upto[at], self.speeds[at], self.turning[at])


def smooth_runs(cubics: FloatArray) -> list[BSpline]:
    """Cubics (n, 4, 2) without corners as few splines of one span each, end to end, by arc length.

    Ends are those of the cubics, exactly, tangents there too; between them RUN_TOLERANCE_MM holds.
    """
    whole = _measured(cubics)
    runs, first = [], 0
    while first < len(whole.cubics):
        run, count = _longest(whole, first)
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


def _longest(whole: _Measured, first: int) -> tuple[BSpline, int]:
    """The longest run from one cubic on: its length doubled while it fits, then halved in."""
    count, step = 1, 1
    best = _as_it_is(whole.cubics[first])
    grows = True
    while step:
        tried = min(count + step, len(whole.cubics) - first)
        run = _fitted(whole.part(first, first + tried)) if tried > count else None
        if run is not None:
            best, count = run, tried
            step = step * 2 if grows else step // 2
        else:
            grows, step = False, step // 2
    return best, count


def _as_it_is(cubic: FloatArray) -> BSpline:
    return BSpline(3, cubic, np.repeat([0.0, max(float(steps(cubic).sum()), SLIVER_MM)], 4))


def _fitted(part: _Measured) -> BSpline | None:
    """One polynomial of the lowest degree that follows all the cubics, or None."""
    if float(part.turning.sum()) > MOST_TURNING_RAD:
        return None
    ends = np.concatenate([[0.0], np.cumsum(part.upto[:, -1])])
    length = float(ends[-1])
    everywhere = ((part.upto[:, 1:-1] + ends[:-1, None]) / length).ravel()
    for degree in DEGREES:
        count = POINTS_A_POLE * degree
        # Dense at the ends, as polynomials of a high degree want it.
        chosen = (1 - np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2
        poles = _least_squares(part, ends, degree, chosen)
        if _error(part, ends, poles, np.concatenate([chosen, everywhere])) <= RUN_TOLERANCE_MM:
            return BSpline(degree, poles, np.repeat([0.0, length], degree + 1))
    return None


def _least_squares(part: _Measured, ends: FloatArray, degree: int, places: FloatArray) -> FloatArray:
    """Poles (degree + 1, 2) with the ends and end tangents of the cubics, nearest to them between."""
    poles = np.zeros((degree + 1, 2))
    poles[0], poles[-1] = part.cubics[0, 0], part.cubics[-1, 3]
    handle = ends[-1] / degree
    poles[1] = poles[0] + handle * unit(part.cubics[0, 1] - part.cubics[0, 0])
    poles[-2] = poles[-1] - handle * unit(part.cubics[-1, 3] - part.cubics[-1, 2])
    basis = _bernstein(degree, places)
    rest = _at(part, ends, places)[0] - basis @ poles
    poles[2:-2] = np.linalg.lstsq(basis[:, 2:-2], rest, rcond=None)[0]
    return poles


def _error(part: _Measured, ends: FloatArray, poles: FloatArray, places: FloatArray) -> float:
    """How far the polynomial lies beside the cubics, at most."""
    points, along = _at(part, ends, places)
    apart = _bernstein(len(poles) - 1, places) @ poles - points
    return float(np.abs(apart[:, 0] * along[:, 1] - apart[:, 1] * along[:, 0]).max())


def _at(part: _Measured, ends: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points and unit tangents (m, 2) of the cubics at shares (m,) of their length."""
    along = places * ends[-1]
    which = np.clip(np.searchsorted(ends, along, side="right") - 1, 0, len(part.cubics) - 1)
    rest = along - ends[which]
    step = np.clip((part.upto[which] <= rest[:, None]).sum(axis=1) - 1, 0, PARTS - 1)
    low, high = part.upto[which, step], part.upto[which, step + 1]
    # t by length, between two places where both it and its derivative are known (Hermite).
    width = high - low
    x = np.clip((rest - low) / width, 0.0, 1.0)
    leaving, arriving = PARTS * width / part.speeds[which, step], PARTS * width / part.speeds[which, step + 1]
    t = x * x * (3 - 2 * x) + x * (1 - x) * ((1 - x) * leaving - x * arriving)
    t = ((step + np.clip(t, 0.0, 1.0)) / PARTS)[:, None]
    a, b, c, d = (part.cubics[which, k] for k in range(4))
    s = 1 - t
    points = s**3 * a + 3 * s**2 * t * b + 3 * s * t**2 * c + t**3 * d
    return points, unit(s**2 * (b - a) + 2 * s * t * (c - b) + t**2 * (d - c))


def _bernstein(degree: int, places: FloatArray) -> FloatArray:
    """Bernstein's polynomials at places (m,) from 0 to 1: (m, degree + 1)."""
    k = np.arange(degree + 1)
    counts = np.array([comb(degree, index) for index in range(degree + 1)])
    return counts * places[:, None] ** k * (1 - places[:, None]) ** (degree - k)


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
