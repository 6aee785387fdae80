"""Arc length along curves and its inverse: the place at a length, and the part between two lengths.

`ArcLength` answers for thousands of places on one B-spline at once, from a table that Newton's method
refines; `piece` solves for each end of a part of a chain by itself. Both are exact to 1e-9 of the length.
`cut`, which the corners of wires are rounded with, is not: see there.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.geometry.arrays import FloatArray, norms
from wrapit.geometry.bezier import QUARTER_NODES, QUARTER_WEIGHTS, BezierChain, derivative, split
from wrapit.geometry.bspline import BSpline

# Gauss's rule for the short pieces of the table.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
# The rule by which a Bézier has its length (`BezierChain.lengths`): a quarter at a time.
_QUARTER_NODES = ((np.arange(4)[:, None] + QUARTER_NODES) / 4).ravel()
_QUARTER_WEIGHTS = np.tile(QUARTER_WEIGHTS / 4, 4)
# How exact the inverse is: the table is within its step, and each of two steps of Newton's squares that.
# Where a curve starts from rest (a handle of no length) its parameter runs as the root of the length, and two
# steps leave up to 1e-4 mm: it goes on until it is as near as this (mm), within 12 steps in all tried.
NEWTON_STEPS, NEAR_MM = 2, 1e-9
# So near to an end (as a share of the cubic) is the end: what is left would have no direction in a file.
END_SHARE = 1e-9
# So near to the length asked for (as a share) is there; bisection alone would take 40 steps, never 60.
CLOSE_SHARE, MOST_STEPS = 1e-12, 60
# How far `cut` errs: up to 6e-3 mm of 20 mm where a cubic all but has a cusp.
TABLE_SIZE = 64


@dataclass(frozen=True, eq=False)
class ArcLength:
    """Maps arc length (mm) to the parameter of a B-spline and back, by a table of short pieces."""

    spline: BSpline
    step_mm: float = 0.05

    @property
    def total_mm(self) -> float:
        """Length of the whole curve."""
        return float(self._table[1][-1])

    def parameter(self, at_mm: FloatArray) -> FloatArray:
        """Parameters (m,) at arc lengths (m,)."""
        table_u, table_s = self._table
        at_mm = np.clip(at_mm, 0.0, self.total_mm)
        u = np.interp(at_mm, table_s, table_u)
        piece = np.clip(np.searchsorted(table_s, at_mm, side="right") - 1, 0, len(table_u) - 2)
        for steps in range(MOST_STEPS):
            excess = self.length(u) - at_mm
            if steps >= NEWTON_STEPS and np.abs(excess).max(initial=0.0) <= NEAR_MM:
                break
            speed = np.maximum(norms(self.spline.derivative(u)), 1e-9)
            u = np.clip(u - excess / speed, table_u[piece], table_u[piece + 1])
        return u

    def length(self, u: FloatArray) -> FloatArray:
        """Arc lengths (m,) at parameters (m,)."""
        table_u, table_s = self._table
        piece = np.clip(np.searchsorted(table_u, u, side="right") - 1, 0, len(table_u) - 2)
        widths = u - table_u[piece]
        inner = table_u[piece][:, None] + widths[:, None] * _NODES
        speed = norms(self.spline.derivative(inner.ravel())).reshape(-1, len(_NODES))
        return table_s[piece] + (speed @ _WEIGHTS) * widths

    def stations(self, step_mm: float) -> FloatArray:
        """Arc lengths from 0 to the end, evenly spaced, about `step_mm` apart."""
        return np.linspace(0.0, self.total_mm, max(2, 1 + int(np.ceil(self.total_mm / step_mm))))

    @cached_property
    def _table(self) -> tuple[FloatArray, FloatArray]:
        breaks = self.spline.breaks
        pieces = []
        for low, high in itertools.pairwise(breaks):
            u = low + (high - low) * _NODES
            rough = float(norms(self.spline.derivative(u)) @ _WEIGHTS) * (high - low)
            count = max(4, int(np.ceil(rough / self.step_mm)))
            pieces.append(np.linspace(low, high, count + 1)[:-1])
        u = np.append(np.concatenate(pieces), breaks[-1])
        widths = np.diff(u)
        inner = (u[:-1, None] + widths[:, None] * _NODES).ravel()
        speed = norms(self.spline.derivative(inner)).reshape(-1, len(_NODES))
        return u, np.concatenate([[0.0], np.cumsum((speed @ _WEIGHTS) * widths)])


def piece(chain: BezierChain, start_mm: float, end_mm: float) -> BezierChain:
    """The part of the chain between two arc lengths, cut to the chain; ValueError if nothing is left.

    >>> from wrapit.geometry.bezier import straight
    >>> piece(straight((0, 0), (9, 0)), 2.0, 5.0).points[0, [0, 3]].round(9).tolist()
    [[2.0, 0.0], [5.0, 0.0]]
    """
    reach = np.concatenate([[0.0], np.cumsum(chain.lengths)])
    start, end = max(0.0, start_mm), min(float(reach[-1]), end_mm)
    if end - start <= 1e-9:
        raise ValueError(f"no curve between {start_mm:g} mm and {end_mm:g} mm of {reach[-1]:g} mm")
    first = min(int(np.searchsorted(reach, start, side="right")) - 1, len(chain) - 1)
    last = max(int(np.searchsorted(reach, end, side="left")) - 1, first)
    at_start = _parameter(chain.points[first], start - reach[first])
    at_end = _parameter(chain.points[last], end - reach[last])
    # Where an end all but falls on a joint, nothing is left of the cubic beyond it.
    if at_start == 1 and first < last:
        first, at_start = first + 1, 0.0
    if at_end == 0 and first < last:
        last, at_end = last - 1, 1.0
    cubics = chain.points[first : last + 1].copy()
    if at_end < 1:
        cubics[-1] = split(cubics[-1:], at_end)[0][0]
    if at_start > 0:
        within = at_start / at_end if first == last else at_start
        cubics[0] = split(cubics[:1], within)[1][0]
    cubics[1:, 0] = cubics[:-1, 3]
    return BezierChain(cubics)


def cut(chain: BezierChain, at_mm: float) -> tuple[BezierChain, BezierChain]:
    """The chain before and after an arc length strictly inside it; ValueError at or beyond an end.

    Only about there, by up to 6e-3 mm: the parameter comes from a table without a step of Newton's. A corner
    may be trimmed there as well as beside it, and the exact place moves every wire's last digits and with
    them numbers that people compare (the leaf's supported share of turns from 0.943 to 0.946).
    """
    if not 0 < at_mm < chain.length:
        raise ValueError(f"can't cut a chain of {chain.length} mm at {at_mm} mm")
    ends = np.cumsum(chain.lengths)
    index = min(int(np.searchsorted(ends, at_mm, side="left")), len(chain) - 1)
    cubic = chain.points[index : index + 1]
    at = _parameter_nearly(cubic, at_mm - (float(ends[index - 1]) if index else 0.0))
    # At a joint both sides keep their cubics whole: a cubic of no length has no direction.
    joint = index + round(at)
    if min(at, 1 - at) <= END_SHARE and 0 < joint < len(chain):
        return BezierChain(chain.points[:joint]), BezierChain(chain.points[joint:])
    left, right = split(cubic, float(np.clip(at, END_SHARE, 1 - END_SHARE)))
    return (
        BezierChain(np.concatenate([chain.points[:index], left])),
        BezierChain(np.concatenate([right, chain.points[index + 1 :]])),
    )


def _parameter(cubic: FloatArray, length_mm: float) -> float:
    """Parameter at which the cubic (4, 2) has run `length_mm`: Newton's method, held between two bounds.

    0 and 1 exactly where the length is within END_SHARE of an end.
    """
    legs = 3 * np.diff(cubic, axis=0)
    velocity = np.stack([legs[0], 2 * (legs[1] - legs[0]), legs[0] - 2 * legs[1] + legs[2]])
    total = _run_mm(velocity, 1.0)
    if length_mm <= END_SHARE * total:
        return 0.0
    if length_mm >= total * (1 - END_SHARE):
        return 1.0
    low, high, t = 0.0, 1.0, length_mm / total
    for _ in range(MOST_STEPS):
        excess = _run_mm(velocity, t) - length_mm
        if abs(excess) <= CLOSE_SHARE * total:
            break
        low, high = (low, t) if excess > 0 else (t, high)
        speed = float(_speeds(velocity, np.array([t]))[0])
        step = t - excess / speed if speed > 0 else -1.0
        t = step if low < step < high else (low + high) / 2
    return t


def _parameter_nearly(cubic: FloatArray, at_mm: float) -> float:
    """The same for a cubic (1, 4, 2) by interpolation between TABLE_SIZE even parameters."""
    t = np.linspace(0, 1, TABLE_SIZE + 1)
    inner = (t[:-1, None] + np.diff(t)[:, None] * _NODES).ravel()
    speed = np.linalg.norm(derivative(cubic, inner)[0], axis=1).reshape(-1, len(_NODES))
    lengths = np.concatenate([[0.0], np.cumsum((speed @ _WEIGHTS) / TABLE_SIZE)])
    return float(np.interp(at_mm, lengths, t))


def _run_mm(velocity: FloatArray, t: float) -> float:
    """Length of a cubic from its start to parameter t."""
    return t * float(_speeds(velocity, t * _QUARTER_NODES) @ _QUARTER_WEIGHTS)


def _speeds(velocity: FloatArray, t: FloatArray) -> FloatArray:
    """Speeds (m,) at parameters (m,), from the velocity's coefficients (3, 2), lowest power first."""
    x, y = ((c * t + b) * t + a for a, b, c in velocity.T)
    return np.hypot(x, y)
