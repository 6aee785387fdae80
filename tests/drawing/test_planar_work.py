"""The work of cutting grows with what is there: counted, not timed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drawing.test_planar import through
from wrapit.drawing.svg import duplicates, shared_places
from wrapit.drawing.svg.duplicates import without_coincident
from wrapit.drawing.svg.intersections import crossings
from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.steps import SAMPLES, steps_of


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


def zigzag(count: int) -> list[Curve]:
    """One polyline of many segments that meets itself nowhere."""
    return [through(np.column_stack([np.arange(count + 1.0), 3.0 * (np.arange(count + 1) % 2)]))]


def pairs(curves: list[Curve]) -> int:
    return sum(len(first) for first, _ in steps_of([curve.cubics for curve in curves]).pairs())


@pytest.mark.parametrize("drawn", [short_strokes, zigzag])
def test_steps_that_are_compared_grow_with_the_steps(drawn):
    few, many = pairs(drawn(100)), pairs(drawn(1600))
    assert many < 17 * few
    assert many < 3 * 1600 * SAMPLES


def test_steps_that_are_compared_grow_with_steps_and_crossings():
    for count in (50, 100, 200):
        curves = long_lines(count)
        steps = steps_of([curve.cubics for curve in curves])
        met = len(crossings(steps, [False] * count))
        assert met > 0.15 * count * (count - 1) / 2
        assert pairs(curves) < 2 * len(steps.ends) + 3 * met


@pytest.mark.parametrize(("drawn", "most"), [(short_strokes, 0), (long_lines, 400)])
def test_curves_that_do_not_lie_on_each_other_are_hardly_ever_compared(drawn, most, monkeypatch):
    compared = []
    spans = duplicates._spans
    monkeypatch.setattr(duplicates, "_spans", lambda *args: compared.append(1) or spans(*args))
    without_coincident(drawn(200), 0.5)
    # Of 19,900 pairs of the long lines, 5,000 cross; those at the most acute angles run on each other.
    assert len(compared) <= most


def test_points_in_the_grid_are_compared_with_few_others(monkeypatch):
    compared = []
    sqrt = math.sqrt
    monkeypatch.setattr(shared_places.math, "sqrt", lambda value: compared.append(1) or sqrt(value))
    rng = np.random.default_rng(6)
    known = shared_places.Places(1.0)
    for point in rng.uniform(0, 100, (20_000, 2)):
        known.find(point)
    # Points that are kept lie farther apart than the tolerance: at most 4 in a cell, 4 cells around each.
    assert len(compared) < 16 * 20_000
    assert len(known.all()) > 4_000
