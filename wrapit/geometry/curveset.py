"""The nearest point on any of several curves, for thousands of points at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.geometry.arrays import FloatArray, IntArray, norms, unit
from wrapit.geometry.bezier import BezierChain, evaluate, split
from wrapit.geometry.polyline import steps

# How short and straight pieces are: then the best of nine starts leads Newton's steps to the nearest point.
# A third more or less leaves the walls of two of our drawings as they are, but for one handover.
MAX_PIECE_MM, MAX_PIECE_TURNING_RAD = 1.0, 0.6
_STARTS = np.linspace(0.0, 1.0, 9)
_NEWTON_STEPS = 7
# A tangent that turns less is rounding: wires count the same bend as none (`wires/centreline.py`).
KINK_RAD = 1e-4
# Where curvature is looked at in each piece, closest at its ends, where a cubic bends most.
_CURVATURE_SAMPLES = 48


@dataclass(frozen=True, eq=False)
class Nearest:
    """For each point (m,): its distance, and the curve and place on it that is nearest.

    `at` is the place as piece index + parameter in the piece; `distance` is inf, `curve` -1 beyond reach.
    """

    distance: FloatArray
    curve: IntArray
    at: FloatArray


@dataclass(frozen=True, eq=False)
class CurveSet:
    """Several chains of cubics, cut into short pieces that turn little.

    `pieces` (n, 4, 2) are all pieces in order, `curve` (n,) the chain each belongs to. A place on any
    curve is one number: piece index + parameter; places grow along each curve. `cubics` (k, 4, 2) are the
    chains' own Béziers; piece i covers the parameters from `share[i, 0]` to `share[i, 1]` of `cubic[i]`.
    """

    pieces: FloatArray
    curve: IntArray
    first: IntArray
    last: IntArray
    cubics: FloatArray
    cubic: IntArray
    share: FloatArray

    @staticmethod
    def of(chains: Sequence[BezierChain]) -> CurveSet:
        """The set of these chains, in their order."""
        cubics = np.concatenate([chain.points for chain in chains])
        parts = [_short_pieces(cubic) for cubic in cubics]
        cubic = np.repeat(np.arange(len(cubics)), [len(part) for part in parts])
        share = np.concatenate(
            [np.column_stack([np.arange(n), np.arange(n) + 1]) / n for n in map(len, parts)]
        )
        curve = np.repeat(np.arange(len(chains)), [len(chain) for chain in chains])[cubic]
        ends = np.searchsorted(curve, np.arange(len(chains)), side="right")
        first = np.searchsorted(curve, np.arange(len(chains)), side="left")
        return CurveSet(np.concatenate(parts), curve, first, ends - 1, cubics, cubic, share)

    def start_of(self, curve: int) -> float:
        """Place of the curve's first point."""
        return float(self.first[curve])

    def end_of(self, curve: int) -> float:
        """Place of the curve's last point."""
        return float(self.last[curve]) + 1.0

    def split_place(self, curve: IntArray, at: FloatArray) -> tuple[IntArray, FloatArray]:
        """Piece and parameter of places on the given curves; a curve's end is on its last piece."""
        piece = np.clip(np.floor(at).astype(np.int64), self.first[curve], self.last[curve])
        return piece, at - piece

    def cubic_place(self, curve: int, at: float) -> tuple[int, float]:
        """The chain's own Bézier and the parameter in it at a place."""
        pieces, t = self.split_place(np.array([curve]), np.array([at]))
        low, high = self.share[pieces[0]]
        return int(self.cubic[pieces[0]]), float(low + t[0] * (high - low))

    def frame(self, curve: IntArray, at: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Points (m, 2), unit tangents (m, 2) and signed curvatures (m,) at places."""
        piece, t = self.split_place(curve, at)
        point, d, dd = _values(_by_axis(self.pieces[piece]), t)
        curvature = (d[0] * dd[1] - d[1] * dd[0]) / np.maximum(norms(d.T), 1e-12) ** 3
        return point.T, unit(d.T), curvature

    def nearest(self, points: FloatArray, reach_mm: float) -> Nearest:
        """The nearest place within reach of each point (m, 2)."""
        index, piece = self._pairs(points, reach_mm)
        start, apart = _nearest_starts(points[index], self.pieces[piece])
        # No place of a piece is further from the nearest start than half the way between two: what starts
        # further away than the point's best start by more than that can't win, and is left out.
        bound = np.full(len(points), np.inf)
        np.minimum.at(bound, index, apart)
        hopeful = np.flatnonzero(apart - self._between_starts[piece] <= bound[index])
        index, piece = index[hopeful], piece[hopeful]
        at, distance = _descended(points[index], self.pieces[piece], start[hopeful])
        within = distance <= reach_mm
        index, piece, at, distance = index[within], piece[within], at[within], distance[within]
        best = np.full(len(points), np.inf)
        curve = np.full(len(points), -1, dtype=np.int64)
        where = np.full(len(points), np.nan)
        # Sorted by point, then distance, then piece: the first of each point wins, always the same one.
        order = np.lexsort((piece, distance, index))
        first = order[np.unique(index[order], return_index=True)[1]] if len(order) else order
        best[index[first]] = distance[first]
        curve[index[first]] = self.curve[piece[first]]
        where[index[first]] = piece[first] + at[first]
        return Nearest(best, curve, where)

    def all_near(
        self, points: FloatArray, reach_mm: float
    ) -> tuple[IntArray, IntArray, FloatArray, FloatArray]:
        """Every (point, piece) pair within reach: point index, piece, parameter, distance, (k,) each."""
        index, piece = self._pairs(points, reach_mm)
        start, _ = _nearest_starts(points[index], self.pieces[piece])
        t, distance = _descended(points[index], self.pieces[piece], start)
        near = distance <= reach_mm
        return index[near], piece[near], t[near], distance[near]

    def _pairs(self, points: FloatArray, reach_mm: float) -> tuple[IntArray, IntArray]:
        """Point index and piece of all that may be within reach."""
        import shapely

        index, piece = self._tree.query(
            shapely.points(points), predicate="dwithin", distance=reach_mm + 2 * self._sag
        )
        return index, piece

    @cached_property
    def kinks(self) -> tuple[FloatArray, FloatArray]:
        """Places where a curve's tangent turns at once, in order, and the angles (left is positive), (k,)."""
        before, after = self.pieces[:-1], self.pieces[1:]
        arriving, leaving = unit(before[:, 3] - before[:, 2]), unit(after[:, 1] - after[:, 0])
        cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
        angle = np.arctan2(cross, (arriving * leaving).sum(axis=1))
        at = np.flatnonzero((np.abs(angle) > KINK_RAD) & (self.curve[:-1] == self.curve[1:])) + 1
        return at.astype(np.float64), angle[at - 1]

    @cached_property
    def curvatures(self) -> tuple[FloatArray, FloatArray]:
        """Places, in order and close together at the ends of pieces, and the signed curvature there, (k,)."""
        t = (1 - np.cos(np.linspace(0.0, np.pi, _CURVATURE_SAMPLES))) / 2
        place = (np.arange(len(self.pieces))[:, None] + t).ravel()
        piece = np.repeat(np.arange(len(self.pieces)), len(t))
        _, d, dd = _values(_by_axis(self.pieces[piece]), np.tile(t, len(self.pieces)))
        return place, (d[0] * dd[1] - d[1] * dd[0]) / np.maximum(norms(d.T), 1e-12) ** 3

    @cached_property
    def _between_starts(self) -> FloatArray:
        """Most that a piece runs between a place on it and the nearest start, (n,)."""
        speed = 3 * np.linalg.norm(np.diff(self.pieces, axis=1), axis=2).max(axis=1)
        return speed * (_STARTS[1] - _STARTS[0]) / 2 + 1e-9

    @cached_property
    def _tree(self) -> Any:
        import shapely

        lines = evaluate(self.pieces, np.linspace(0, 1, 5))
        return shapely.STRtree(shapely.linestrings(lines))

    @cached_property
    def _sag(self) -> float:
        ends = evaluate(self.pieces, np.linspace(0, 1, 5))
        middles = evaluate(self.pieces, np.linspace(0.125, 0.875, 4))
        return float(np.linalg.norm(middles - (ends[:, 1:] + ends[:, :-1]) / 2, axis=2).max()) + 1e-6


def _short_pieces(cubic: FloatArray) -> FloatArray:
    """The cubic (4, 2), cut in 1, 2, 4 … equal parts until short and nearly straight: (n, 4, 2)."""
    legs = np.diff(cubic, axis=0)
    sizes = steps(cubic)
    length = float(sizes.sum())
    directions = legs[sizes > 1e-9 * max(length, 1e-9)]
    turning = 0.0
    if len(directions) > 1:
        a, b = directions[:-1], directions[1:]
        crosses = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        turning = float(np.abs(np.arctan2(crosses, (a * b).sum(axis=1))).sum())
    need = max(length / MAX_PIECE_MM, turning / MAX_PIECE_TURNING_RAD, 1.0)
    part = cubic[None]
    for _ in range(int(np.ceil(np.log2(need)))):
        left, right = split(part, 0.5)
        part = np.stack([left, right], axis=1).reshape(-1, 4, 2)
    return part


def _by_axis(points: FloatArray) -> FloatArray:
    """Points (m, …, 2) as (…, 2, m): what is reckoned of many at once takes a third of the time so."""
    return np.ascontiguousarray(np.moveaxis(points, 0, -1))


def _values(cubics: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Point, first and second derivative of cubic i of (4, 2, m) at t[i]: (2, m) each."""
    s = 1 - t
    p0, p1, p2, p3 = cubics
    point = s**3 * p0 + 3 * s**2 * t * p1 + 3 * s * t**2 * p2 + t**3 * p3
    first = 3 * (s**2 * (p1 - p0) + 2 * s * t * (p2 - p1) + t**2 * (p3 - p2))
    second = 6 * (s * (p2 - 2 * p1 + p0) + t * (p3 - 2 * p2 + p1))
    return point, first, second


def _nearest_starts(points: FloatArray, cubics: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The best of nine parameters of cubic i for point i, and the distance there."""
    if not len(points):
        return np.empty(0), np.empty(0)
    apart = evaluate(cubics, _STARTS) - points[:, None]
    squared = apart[..., 0] ** 2 + apart[..., 1] ** 2
    best = squared.argmin(axis=1)
    return _STARTS[best], np.sqrt(squared[np.arange(len(points)), best])


def _descended(points: FloatArray, cubics: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Parameter and distance of the nearest point of cubic i to point i: Newton from a start."""
    if not len(points):
        return np.empty(0), np.empty(0)
    points, cubics = _by_axis(points), _by_axis(cubics)
    for _ in range(_NEWTON_STEPS):
        point, d, dd = _values(cubics, t)
        apart = point - points
        slope = apart[0] * d[0] + apart[1] * d[1]
        bend = d[0] * d[0] + d[1] * d[1]
        full = bend + (apart[0] * dd[0] + apart[1] * dd[1])
        # Gauss-Newton where the full second derivative would lead uphill.
        step = slope / np.where(full > 0.1 * bend, full, np.maximum(bend, 1e-18))
        t = np.clip(t - np.clip(step, -0.2, 0.2), 0.0, 1.0)
    return t, norms((_values(cubics, t)[0] - points).T)
