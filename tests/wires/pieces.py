"""Small drawings with known answers."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from wrapit.decomposition.model import Decomposition, Energy, Solution, Trail, Traversal, Weights
from wrapit.drawing.model import Drawing, Junction, Segment
from wrapit.geometry import BezierChain, straight


def drawing_of(
    points: Sequence[tuple[float, float]], edges: Sequence[tuple[int, int, BezierChain | None]]
) -> Drawing:
    """A drawing with the junctions at `points`; edges without a curve are straight."""
    return Drawing(
        tuple(Junction(i, np.array(p, float)) for i, p in enumerate(points)),
        tuple(
            Segment(i, a, b, curve if curve is not None else straight(points[a], points[b]))
            for i, (a, b, curve) in enumerate(edges)
        ),
    )


def solution_of(
    drawing: Drawing, trails: Sequence[Sequence[tuple[int, bool]]], closed: bool = False
) -> Solution:
    """A solution with the given trails (segment, reversed)."""
    mate = [-1] * (2 * len(drawing.segments))
    for trail in trails:
        for (e, back), (f, forth) in itertools.pairwise(trail):
            leaving, arriving = (2 * e if back else 2 * e + 1), (2 * f + 1 if forth else 2 * f)
            mate[leaving], mate[arriving] = arriving, leaving
    return Solution(
        Decomposition(drawing, tuple(mate)),
        tuple(Trail(tuple(Traversal(*step) for step in trail), closed) for trail in trails),
        Energy(len(trails), 0.0, 0, 0, float(len(trails))),
        Weights(),
        "exact",
        1,
        0,
    )


def circle(radius: float, centre: tuple[float, float] = (0.0, 0.0)) -> BezierChain:
    """A counter-clockwise circle of four cubics from its rightmost point."""
    k = 4 / 3 * np.tan(np.pi / 8)
    quarter = np.array([[1, 0], [1, k], [k, 1], [0, 1]], float)
    turn = np.array([[0, -1], [1, 0]], float)
    quarters = [quarter]
    for _ in range(3):
        quarters.append(np.round(quarters[-1] @ turn.T, 15))
    points = np.array(quarters) * radius + np.array(centre)
    points[1:, 0] = points[:-1, 3]
    points[-1, 3] = points[0, 0]
    return BezierChain(points)
