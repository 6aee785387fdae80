"""Curves at a fixed distance from others: points on them, and the same curve as exact cubics.

The parallel at `offset` mm lies to the left of its curve, at −offset to the right.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wrapit.geometry.arrays import FloatArray, norms, unit
from wrapit.geometry.bezier import BezierChain, evaluate
from wrapit.geometry.curveset import CurveSet
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Point, point_of

BoolArray: TypeAlias = NDArray[np.bool_]
# How near cubics are to a parallel. With what solids may add (3e-5 mm) walls measure 0.19995 mm from wires
# for a clearance of 0.2.
TOLERANCE_MM = 2e-5
# Where each is compared with the true parallel; where it turns more than the second, that is not enough.
_CHECKS = np.array([0.25, 0.5, 0.75])
_MAX_TURNING_RAD = 0.8
_NARROWEST = 1e-9  # a share of a cubic; a cusp all but turns at once


@dataclass(frozen=True, eq=False)
class Side:
    """The parallel of one curve of a set; its parameter is the place on that curve."""

    curves: CurveSet
    edge: Edge
    curve: int
    offset_mm: float

    def at(self, place: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Points (m, 2) and derivatives by place (m, 2)."""
        which = np.full(len(place), self.curve)
        piece, t = self.curves.split_place(which, place)
        return _parallel_points(self.curves.pieces[piece], t, self.offset_mm)

    def folds(self, start: FloatArray, end: FloatArray) -> BoolArray:
        """Whether the parallel runs backwards somewhere between places (m,) and (m,): (m,).

        It does where the curve bends more sharply than the offset, or at once; that part is never on an
        outline.
        """
        sharp = self._folding
        low, high = np.minimum(start, end), np.maximum(start, end)
        return np.searchsorted(sharp, high) > np.searchsorted(sharp, low)

    @cached_property
    def _folding(self) -> FloatArray:
        """Places, in order, where the parallel runs backwards."""
        kinks, angles = self.curves.kinks
        places, curvature = self.curves.curvatures
        folding = [kinks[self.offset_mm * angles > 0], places[self.offset_mm * curvature > 1.0]]
        return np.sort(np.concatenate(folding))

    @property
    def bounds(self) -> tuple[float, float]:
        """Places of the curve's ends."""
        return self.curves.start_of(self.curve), self.curves.end_of(self.curve)

    def between(self, start: float, end: float) -> Edge:
        """The parallel from one place to another (either may be the larger), within TOLERANCE_MM."""
        if isinstance(self.edge, Line):
            ends = self.at(np.array([start, end]))[0]
            return Line(point_of(ends[0]), point_of(ends[1]))
        if isinstance(self.edge, Arc):
            ends = self.at(np.array([start, end]))[0]
            return _arc_like(self.edge, self.offset_mm, ends[0], ends[1], forward=end > start)
        chain = self._cubics(min(start, end), max(start, end))
        if _is_straight(chain):
            a, b = (chain.start, chain.end) if end > start else (chain.end, chain.start)
            return Line(point_of(a), point_of(b))
        return chain if end > start else chain.reversed()

    def _cubics(self, start: float, end: float) -> BezierChain:
        first, begins = self.curves.cubic_place(self.curve, start)
        last, ends = self.curves.cubic_place(self.curve, end)
        which = np.arange(first, last + 1)
        low, high = np.zeros(len(which)), np.ones(len(which))
        low[0], high[-1] = begins, ends
        long = high - low > 1e-7
        long[int(long.argmax())] = True
        which, low, high = which[long], low[long], high[long]
        while True:
            cubics = _hermite(self.curves.cubics[which], low, high, self.offset_mm)
            error = _normal_error(self.curves.cubics[which], low, high, self.offset_mm, cubics)
            # Where the curve turns much inside a piece, the error at three places says nothing of the rest.
            turning = _turning(self.curves.cubics[which], low, high)
            bad = ((error > TOLERANCE_MM) | (turning > _MAX_TURNING_RAD)) & (high - low > _NARROWEST)
            if not bad.any():
                break
            middle = (low + high) / 2
            order = np.argsort(np.concatenate([np.arange(len(which)), np.flatnonzero(bad) + 0.5]))
            which = np.concatenate([which, which[bad]])[order]
            high = np.concatenate([np.where(bad, middle, high), high[bad]])[order]
            low = np.concatenate([low, middle[bad]])[order]
        cubics[1:, 0] = cubics[:-1, 3]
        return BezierChain(cubics)


@dataclass(frozen=True)
class Round:
    """The circle about a corner or an end of a curve; its parameter is the angle."""

    centre: Point
    radius_mm: float

    def at(self, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Points (m, 2) and derivatives by angle (m, 2)."""
        radial = self.radius_mm * np.column_stack([np.cos(angle), np.sin(angle)])
        return np.array(self.centre) + radial, np.column_stack([-radial[:, 1], radial[:, 0]])

    @property
    def bounds(self) -> tuple[float, float]:
        """A circle has no ends."""
        return -math.inf, math.inf

    def between(self, start: float, end: float) -> Edge:
        """The arc from one angle to another (either may be the larger)."""
        return Arc(self.centre, self.radius_mm, start, end - start)


Parallel = Side | Round


def _is_straight(chain: BezierChain) -> bool:
    points = chain.points.reshape(-1, 2) - chain.start
    along = unit(chain.end - chain.start)
    return bool(np.abs(along[0] * points[:, 1] - along[1] * points[:, 0]).max() < 1e-9)


def _parallel_points(cubics: FloatArray, t: FloatArray, offset: float) -> tuple[FloatArray, FloatArray]:
    s, u = (1 - t)[:, None], t[:, None]
    p0, p1, p2, p3 = (cubics[:, k] for k in range(4))
    point = s**3 * p0 + 3 * s**2 * u * p1 + 3 * s * u**2 * p2 + u**3 * p3
    d = 3 * (s**2 * (p1 - p0) + 2 * s * u * (p2 - p1) + u**2 * (p3 - p2))
    dd = 6 * (s * (p2 - 2 * p1 + p0) + u * (p3 - 2 * p2 + p1))
    speed = np.maximum(norms(d), 1e-12)[:, None]
    normal = np.column_stack([-d[:, 1], d[:, 0]]) / speed
    curvature = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0])[:, None] / speed**3
    return point + offset * normal, d * (1 - offset * curvature)


def _at_several(pieces: FloatArray, t: FloatArray, offset: float) -> tuple[FloatArray, FloatArray]:
    """The parallel's points and derivatives at several parameters (s, n) of each piece: (s, n, 2) each."""
    points, along = _parallel_points(np.tile(pieces, (len(t), 1, 1)), t.ravel(), offset)
    return points.reshape(*t.shape, 2), along.reshape(*t.shape, 2)


def _between(low: FloatArray, high: FloatArray, shares: ArrayLike) -> FloatArray:
    """Parameters (s, n) at shares (s,) of the way from low to high."""
    return low + np.asarray(shares)[:, None] * (high - low)


def _hermite(pieces: FloatArray, low: FloatArray, high: FloatArray, offset: float) -> FloatArray:
    """One cubic for each piece from low to high, with the parallel's points and derivatives at both ends."""
    (start, end), (leaving, arriving) = _at_several(pieces, np.stack([low, high]), offset)
    third = ((high - low) / 3)[:, None]
    return np.stack([start, start + third * leaving, end - third * arriving, end], axis=1)


def _turning(pieces: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """How much each piece turns from low to high, (n,), from its tangents at five places."""
    _, tangents = _at_several(pieces, _between(low, high, [0.0, *_CHECKS, 1.0]), 0.0)
    a, b = tangents[:-1], tangents[1:]
    return np.abs(np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(axis=2))).sum(axis=0)


def _normal_error(
    pieces: FloatArray, low: FloatArray, high: FloatArray, offset: float, cubics: FloatArray
) -> FloatArray:
    """How far each cubic strays sideways from the true parallel, (n,)."""
    true, along = _at_several(pieces, _between(low, high, _CHECKS), offset)
    apart = evaluate(cubics, _CHECKS).swapaxes(0, 1) - true
    norm = np.maximum(norms(along), 1e-12)
    aside = np.abs(along[..., 0] * apart[..., 1] - along[..., 1] * apart[..., 0]) / norm
    return np.asarray(aside.max(axis=0))


def _arc_like(arc: Arc, offset: float, start: FloatArray, end: FloatArray, *, forward: bool) -> Arc:
    """The part of the arc's parallel between two points on it, in the arc's direction or against it."""
    turn = 1.0 if (arc.sweep_rad > 0) == forward else -1.0
    radius = arc.radius_mm - offset * math.copysign(1.0, arc.sweep_rad)
    flip = 1.0 if radius > 0 else -1.0
    first, last = (
        math.atan2(flip * (p[1] - arc.centre[1]), flip * (p[0] - arc.centre[0])) for p in (start, end)
    )
    sweep = (turn * (last - first)) % (2 * math.pi)
    if sweep < 1e-9 and abs(arc.sweep_rad) > 1:
        sweep = 2 * math.pi
    if radius <= 0:
        first += math.pi
    return Arc(arc.centre, abs(radius), first, turn * sweep)
