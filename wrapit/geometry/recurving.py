"""A curve with more or less curvature everywhere: each point keeps its place along the curve."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.bspline import BSpline, from_chain

# How finely a curve is taken apart: circles come out within 2e-4 mm and 1e-5 of their length (tested).
PIECE_MM, PIECE_RAD = 4.0, 0.5
STEPS = 12  # of integration in each piece
LEAST_PIECE = 1e-7  # of the whole; what is shorter has no direction of its own
# Gauss's rule with three nodes, for the steps.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
# Integrals of the three Lagrange polynomials from 0 to each node (collocation at Gauss points).
_TO_NODES: Final = np.column_stack(
    [
        np.polynomial.polynomial.polyval(
            _NODES, np.polynomial.polynomial.polyint(np.linalg.solve(np.vander(_NODES, 3, True), column))
        )
        for column in np.eye(3)
    ]
)


def recurved(
    spline: BSpline,
    change: Callable[[FloatArray], FloatArray],
    within: Sequence[tuple[float, float]] | None = None,
) -> BSpline:
    """The curve whose signed curvature is κ + change(κ), from the same start in the same direction.

    `change` maps curvatures (m,) in 1/mm to what is added, everywhere or `within` these intervals of the
    parameter, which don't overlap. Lengths stay: each tangent is turned by what
    the change adds up to before it, and the turned tangents are summed up (Gauss, three points). Corners
    keep their angles. With no change the curve comes back exactly; else it is within about 1e-4 mm.
    """
    ends = np.array(within if within is not None else [spline.domain], dtype=float).reshape(-1, 2)
    nodes = _apart(np.unique(np.concatenate([[spline.breaks[0]], *_pieces(spline), ends.ravel()])))
    u = np.concatenate(
        [np.linspace(a, b, STEPS + 1)[:-1] for a, b in itertools.pairwise(nodes)] + [nodes[-1:]]
    )
    width = np.diff(u)
    inner = u[:-1, None] + width[:, None] * _NODES
    velocity = spline.derivative(inner.ravel()).reshape(-1, 3, 2)
    middle = (u[:-1] + u[1:]) / 2
    changes = ((ends[:, :1] < middle) & (middle < ends[:, 1:])).any(axis=0)
    gain = change(spline.curvature(inner.ravel())).reshape(-1, 3) * np.linalg.norm(velocity, axis=2)
    gain *= changes[:, None]
    before = np.concatenate([[0.0], np.cumsum((gain @ _WEIGHTS) * width)])
    angle = before[:-1, None] + width[:, None] * (gain @ _TO_NODES.T)
    steps = np.einsum("ink,n->ik", _turned(velocity, angle), _WEIGHTS) * width[:, None]
    points = spline.at(u[:1]) + np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    return _hermite(spline, nodes, points[::STEPS], before[::STEPS])


@dataclass(frozen=True, eq=False)
class Fit:
    """A turn and shift of a curve that brings it nearest to another, and how far apart they stay."""

    matrix: FloatArray
    offset: FloatArray
    apart_mm: float

    def moved(self, spline: BSpline) -> BSpline:
        """The curve, turned and shifted."""
        return BSpline(spline.degree, spline.poles @ self.matrix.T + self.offset, spline.knots)


def best_fit(points: FloatArray, onto: FloatArray) -> Fit:
    """The rigid motion that brings points (m, 2) nearest to others (m, 2), in the least squares (Kabsch)."""
    centre, target = points.mean(axis=0), onto.mean(axis=0)
    a, b = points - centre, onto - target
    angle = math.atan2(float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()), float((a * b).sum()))
    matrix = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    apart = np.linalg.norm(a @ matrix.T - b, axis=1)
    return Fit(matrix, target - matrix @ centre, float(apart.max(initial=0.0)))


def _apart(nodes: FloatArray) -> FloatArray:
    """Nodes (n,) in order without those that all but repeat the one before, or the last."""
    least = LEAST_PIECE * (nodes[-1] - nodes[0])
    inner = nodes[1:-1]
    kept = (np.diff(nodes)[:-1] > least) & (nodes[-1] - inner > least)
    return np.concatenate([nodes[:1], inner[kept], nodes[-1:]])


def _pieces(spline: BSpline) -> list[FloatArray]:
    """Parameters after which each piece ends: none longer or more bent than the limits."""
    ends = []
    for a, b in itertools.pairwise(spline.breaks):
        u = np.linspace(a, b, 18)[1:-1]
        speed = np.linalg.norm(spline.derivative(u), axis=1)
        length = float(speed.mean()) * (b - a)
        bend = float((np.abs(spline.curvature(u)) * speed).mean()) * (b - a)
        count = max(1, math.ceil(length / PIECE_MM), math.ceil(bend / PIECE_RAD))
        ends.append(np.linspace(a, b, count + 1)[1:])
    return ends


def _hermite(spline: BSpline, nodes: FloatArray, points: FloatArray, angle: FloatArray) -> BSpline:
    """Cubics through the points with the turned tangents; a corner has one before and one after it."""
    tiny = 1e-9 * np.diff(nodes)
    third = np.diff(nodes)[:, None] / 3
    leaving = _turned(spline.derivative(nodes[:-1] + tiny), angle[:-1]) * third
    arriving = _turned(spline.derivative(nodes[1:] - tiny), angle[1:]) * third
    return from_chain(
        BezierChain(np.stack([points[:-1], points[:-1] + leaving, points[1:] - arriving, points[1:]], axis=1))
    )


def _turned(vectors: FloatArray, angle: FloatArray) -> FloatArray:
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
