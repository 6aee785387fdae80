"""The steps that are compared grow with the steps and the crossings: counted, not timed."""

from __future__ import annotations

import numpy as np
import pytest

from tests.drawing.svg.curves import long_lines, short_strokes, through
from wrapit.drawing.svg.intersections import crossings
from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.steps import SAMPLES, steps_of


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
