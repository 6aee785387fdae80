"""Chains of planar cubic Béziers: the shape of one segment of a drawing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from wrapit.geometry.arrays import FloatArray, IntArray, locked, norms, unit

# Gauss's rule for the length of each quarter of a Bézier: of 300 random ones in a square of 20 mm, half are
# exact to 4e-15 mm; 1 in 100 errs by 5e-4 mm or more, the worst by 1.5e-3: those that all but have a cusp.
QUARTER_NODES, QUARTER_WEIGHTS = np.polynomial.legendre.leggauss(24)
QUARTER_NODES, QUARTER_WEIGHTS = (QUARTER_NODES + 1) / 2, QUARTER_WEIGHTS / 2


@dataclass(frozen=True, eq=False)
class BezierChain:
    """n cubic Béziers, each starting exactly where the one before ends; `points` has shape (n, 4, 2).

    Raises ValueError for another shape, for numbers that are not finite, or for gaps.
    """

    points: FloatArray

    def __post_init__(self) -> None:
        points = locked(self.points)
        if points.ndim != 3 or points.shape[1:] != (4, 2) or not len(points):
            raise ValueError(f"a Bézier chain has shape (n, 4, 2), not {points.shape}")
        if not np.isfinite(points).all():
            raise ValueError("a Bézier chain has finite coordinates")
        if not np.array_equal(points[1:, 0], points[:-1, 3]):
            raise ValueError("each Bézier starts where the one before ends")
        object.__setattr__(self, "points", points)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def start(self) -> FloatArray:
        """First point, (2,)."""
        return self.points[0, 0]

    @property
    def end(self) -> FloatArray:
        """Last point, (2,)."""
        return self.points[-1, 3]

    @cached_property
    def start_tangent(self) -> FloatArray:
        """Unit direction of travel at the start, (2,)."""
        return _leaving(self.points.reshape(-1, 2))

    @cached_property
    def end_tangent(self) -> FloatArray:
        """Unit direction of travel at the end, (2,)."""
        return -_leaving(self.points.reshape(-1, 2)[::-1])

    @cached_property
    def lengths(self) -> FloatArray:
        """Arc length of each Bézier, (n,)."""
        quarters = np.concatenate([part for half in split(self.points, 0.5) for part in split(half, 0.5)])
        speed = norms(derivative(quarters, QUARTER_NODES))
        return (speed @ QUARTER_WEIGHTS).reshape(4, -1).sum(axis=0)

    @cached_property
    def length(self) -> float:
        """Arc length of the chain."""
        return float(self.lengths.sum())

    def reversed(self) -> BezierChain:
        """The same curve travelled the other way."""
        return BezierChain(self.points[::-1, ::-1])

    def mapped(self, matrix: ArrayLike, offset: ArrayLike = (0.0, 0.0)) -> BezierChain:
        """The chain under x → matrix · x + offset."""
        return BezierChain(self.points @ np.asarray(matrix, dtype=np.float64).T + np.asarray(offset))

    def sampled(self, step: float) -> FloatArray:
        """Points (m, 2) along the chain, both ends included, at most about `step` apart; write-locked."""
        if step not in self._sampled:  # outlines are asked two and three times for the same
            counts = np.maximum(np.ceil(self.lengths / step).astype(np.int64), 1)
            points = np.concatenate([self.start[None], evenly_evaluated(self.points, counts)])
            points.setflags(write=False)
            self._sampled[step] = points
        return self._sampled[step]

    @cached_property
    def _sampled(self) -> dict[float, FloatArray]:
        return {}


def joined(chains: Iterable[BezierChain]) -> BezierChain:
    """One chain from chains that follow one another exactly."""
    return BezierChain(np.concatenate([chain.points for chain in chains]))


def straight(start: ArrayLike, end: ArrayLike) -> BezierChain:
    """A straight line as one cubic Bézier with even speed."""
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    return BezierChain(np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b])[None])


def evaluate(points: FloatArray, t: FloatArray) -> FloatArray:
    """Points at parameters `t` (m,) of cubics (n, 4, 2): (n, m, 2)."""
    return np.einsum("kt,nkd->ntd", _bernstein(t), points)


def evenly_evaluated(points: FloatArray, counts: IntArray) -> FloatArray:
    """Points at parameters 1/c, 2/c … 1 of each cubic (n, 4, 2), c its own of the counts (n,): (sum, 2)."""
    which = np.repeat(np.arange(len(points)), counts)
    place = np.arange(1, len(which) + 1) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.einsum("km,mkd->md", _bernstein(place / counts[which]), points[which])


def derivative(points: FloatArray, t: FloatArray) -> FloatArray:
    """First derivatives at parameters `t` (m,) of cubics (n, 4, 2): (n, m, 2)."""
    s = 1 - t
    basis = np.stack([s**2, 2 * s * t, t**2])
    return 3 * np.einsum("kt,nkd->ntd", basis, np.diff(points, axis=1))


def second_derivative(points: FloatArray, t: FloatArray) -> FloatArray:
    """Second derivatives at parameters `t` (m,) of cubics (n, 4, 2): (n, m, 2)."""
    return 6 * np.einsum("kt,nkd->ntd", np.stack([1 - t, t]), np.diff(points, n=2, axis=1))


def split(points: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
    """De Casteljau: the cubics (n, 4, 2) before and after parameter t."""
    left, right, level = [points[:, 0]], [points[:, 3]], points
    while level.shape[1] > 1:
        level = (1 - t) * level[:, :-1] + t * level[:, 1:]
        left.append(level[:, 0])
        right.append(level[:, -1])
    return np.stack(left, axis=1), np.stack(right[::-1], axis=1)


def _bernstein(t: FloatArray) -> FloatArray:
    """Shares of a cubic's four control points at parameters (m,): (4, m)."""
    s = 1 - t
    return np.stack([s**3, 3 * s**2 * t, 3 * s * t**2, t**3])


def _leaving(control: FloatArray) -> FloatArray:
    """Direction from the first control point to the first one apart from it."""
    apart = control - control[0]
    far = norms(apart)
    index = int(np.argmax(far > 1e-9 * max(1.0, float(far.max()))))
    return unit(apart[index])
