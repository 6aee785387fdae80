"""Random curves in a field of 100 by 100, for the planar graph."""

from __future__ import annotations

import itertools
import math

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from wrapit.drawing.svg.planar import Curve
from wrapit.geometry import FloatArray

FEW = settings(max_examples=30, deadline=None)

SEEDS = st.integers(0, 2**32 - 1)


def line(start: object, end: object) -> FloatArray:
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    return np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b])


def through(points: FloatArray) -> Curve:
    """The polyline through points; closed where it ends at its start."""
    cubics = np.array([line(a, b) for a, b in itertools.pairwise(points)])
    return Curve(cubics, closed=bool(np.array_equal(points[0], points[-1])))


def wavy(rng: np.random.Generator, closed: bool) -> Curve:
    """A smooth curve across a field of 100 by 100."""
    knots, slopes = rng.uniform(0, 100, (4, 2)), rng.normal(0, 20, (4, 2))
    ends = [*range(4), 0] if closed else range(4)
    cubics = [
        np.stack([knots[i], knots[i] + slopes[i], knots[j] - slopes[j], knots[j]])
        for i, j in itertools.pairwise(ends)
    ]
    return Curve(np.array(cubics), closed)


def drawing(rng: np.random.Generator) -> list[Curve]:
    """Lines, polylines, smooth curves and loops, in general position."""
    kinds = [
        lambda: through(rng.uniform(0, 100, (2, 2))),
        lambda: through(rng.uniform(0, 100, (5, 2))),
        lambda: wavy(rng, closed=False),
        lambda: wavy(rng, closed=True),
    ]
    return [kinds[rng.integers(len(kinds))]() for _ in range(rng.integers(1, 6))]


def short_strokes(count: int) -> list[Curve]:
    """Strokes a hundred long that cross no other, in a field of rows."""
    rng = np.random.default_rng(4)
    side = math.ceil(math.sqrt(count))
    starts = 150.0 * np.column_stack(np.divmod(np.arange(count), side))
    angles = rng.uniform(0, math.pi / 2, count)
    return [
        through([p, p + 100 * np.array([math.cos(a), math.sin(a)])])
        for p, a in zip(starts, angles, strict=True)
    ]


def long_lines(count: int) -> list[Curve]:
    """Lines from anywhere to anywhere in a field, so that nearly a quarter of all pairs cross."""
    return [through(ends) for ends in np.random.default_rng(5).uniform(0, 1000, (count, 2, 2))]
