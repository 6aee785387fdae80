"""Arc length along curves: parameter from length, and cutting at a length."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, derivative, split
from wrapit.geometry.bspline import BSpline

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
NEWTON_STEPS = 2


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
        for _ in range(NEWTON_STEPS):
            speed = np.maximum(np.linalg.norm(self.spline.derivative(u), axis=1), 1e-9)
            step = (self.length(u) - at_mm) / speed
            piece = np.clip(np.searchsorted(table_s, at_mm, side="right") - 1, 0, len(table_u) - 2)
            u = np.clip(u - step, table_u[piece], table_u[piece + 1])
        return u

    def length(self, u: FloatArray) -> FloatArray:
        """Arc lengths (m,) at parameters (m,)."""
        table_u, table_s = self._table
        piece = np.clip(np.searchsorted(table_u, u, side="right") - 1, 0, len(table_u) - 2)
        widths = u - table_u[piece]
        inner = table_u[piece][:, None] + widths[:, None] * _NODES
        speed = np.linalg.norm(self.spline.derivative(inner.ravel()), axis=1).reshape(-1, len(_NODES))
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
            rough = float(np.linalg.norm(self.spline.derivative(u), axis=1) @ _WEIGHTS) * (high - low)
            count = max(4, int(np.ceil(rough / self.step_mm)))
            pieces.append(np.linspace(low, high, count + 1)[:-1])
        u = np.append(np.concatenate(pieces), breaks[-1])
        widths = np.diff(u)
        inner = (u[:-1, None] + widths[:, None] * _NODES).ravel()
        speed = np.linalg.norm(self.spline.derivative(inner), axis=1).reshape(-1, len(_NODES))
        return u, np.concatenate([[0.0], np.cumsum((speed @ _WEIGHTS) * widths)])


def cut(chain: BezierChain, at_mm: float) -> tuple[BezierChain, BezierChain]:
    """The chain before and after an arc length strictly inside it; ValueError at or beyond an end."""
    if not 0 < at_mm < chain.length:
        raise ValueError(f"can't cut a chain of {chain.length} mm at {at_mm} mm")
    ends = np.cumsum(chain.lengths)
    index = min(int(np.searchsorted(ends, at_mm, side="left")), len(chain) - 1)
    cubic = chain.points[index : index + 1]
    left, right = split(cubic, _parameter(cubic, at_mm - (float(ends[index - 1]) if index else 0.0)))
    return (
        BezierChain(np.concatenate([chain.points[:index], left])),
        BezierChain(np.concatenate([right, chain.points[index + 1 :]])),
    )


def _parameter(cubic: FloatArray, at_mm: float) -> float:
    t = np.linspace(0, 1, 65)
    inner = (t[:-1, None] + np.diff(t)[:, None] * _NODES).ravel()
    speed = np.linalg.norm(derivative(cubic, inner)[0], axis=1).reshape(-1, len(_NODES))
    lengths = np.concatenate([[0.0], np.cumsum((speed @ _WEIGHTS) / 64)])
    return float(np.clip(np.interp(at_mm, lengths, t), 1e-9, 1 - 1e-9))
