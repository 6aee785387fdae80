"""Cubics are cut where they turn back, and only there; what is left follows the curve."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from tests.geometry.shapes import cubics_with_tips
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.cusps import sharp_places, without_cusps

NEAR = 0.1


@given(cubics_with_tips())
@example(np.array([[0.0, 0], [40, 40], [0, 40], [40, 0]]))
@example(np.array([[0.0, 0], [20, 0], [60, 0], [40, 0]]))  # out and back on one line
@example(np.array([[0.0, 0], [-20, 0], [80, 0], [40, 0]]))
def test_a_cubic_with_a_tip_becomes_parts_without_one(cubic: FloatArray) -> None:
    assert sharp_places(cubic, NEAR)
    parts = without_cusps(cubic[None], NEAR)
    chain = BezierChain(parts)
    assert np.array_equal(chain.start, cubic[0])
    assert np.array_equal(chain.end, cubic[3])
    for part in parts:
        assert not sharp_places(part, NEAR / 2)
    drawn = evaluate(cubic[None], np.linspace(0, 1, 4001))[0]
    points = chain.sampled(NEAR / 10)
    far = [float(np.linalg.norm(drawn - point, axis=1).min()) for point in points[::7]]
    assert max(far) < NEAR


@given(st.floats(0.2, 0.8), st.floats(-2.6, 2.6), st.floats(20, 60), st.floats(20, 60))
def test_the_tip_itself_is_where_parts_meet(t: float, between: float, first: float, last: float) -> None:
    assume(abs(between) > 0.3)
    out, back = first * np.array([1.0, 0.0]), last * np.array([math.cos(between), math.sin(between)])
    middle = -((1 - t) ** 2 * out + t**2 * back) / (2 * t * (1 - t))
    cubic = np.cumsum([np.zeros(2), out, middle, back], axis=0)
    tip = evaluate(cubic[None], np.array([t]))[0, 0]
    assume(min(np.linalg.norm(tip - cubic[0]), np.linalg.norm(tip - cubic[3])) > 2 * NEAR)
    parts = without_cusps(cubic[None], NEAR)
    assert len(parts) == 2
    assert parts[0, 3] == pytest.approx(tip, abs=1e-5)


@pytest.mark.parametrize(
    "cubic",
    [
        [[0, 0], [0, 0], [40, 20], [40, 20]],  # handles of no length
        [[0, 0], [0, 0], [40, 20], [40, 0]],
        [[0, 0], [20, 40], [20, -40], [40, 0]],
        [[0, 0], [45, 30], [-5, 30], [40, 0]],  # crosses itself in a loop of 5 mm
        [[3, 3], [3, 3], [3, 3], [3, 3]],
    ],
)
def test_other_cubics_come_back_as_they_are(cubic: list[list[float]]) -> None:
    points = np.array([cubic], dtype=float)
    assert without_cusps(points, NEAR) is points or np.array_equal(without_cusps(points, NEAR), points)
