"""Short polynomials: values, least squares, nearest places and angles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, motions, points
from wrapit.geometry.polynomials import angle, angle_of, horner, nearest_along, polynomial

terms = st.lists(points, min_size=2, max_size=4).map(lambda found: [list(pair) for pair in found])


@given(terms, st.floats(-3, 3))
def test_values_are_numpys(wanted: list[list[float]], along: float) -> None:
    x, y, dx, dy = horner(wanted, along)
    exact = np.array([np.polynomial.polynomial.polyval(along, column) for column in np.array(wanted).T])
    slope = np.array(
        [
            np.polynomial.polynomial.polyval(along, np.polynomial.polynomial.polyder(c))
            for c in np.array(wanted).T
        ]
    )
    assert np.allclose([x, y], exact, atol=1e-9)
    if np.hypot(*slope) > 1e-6:
        assert np.allclose([dx, dy], slope / np.hypot(*slope), atol=1e-6)


@given(terms)
def test_a_polynomial_comes_back_from_its_own_points(wanted: list[list[float]]) -> None:
    along = np.linspace(-2, 3, 25)
    values = np.array([horner(wanted, float(s))[:2] for s in along])
    assert np.allclose(polynomial(along, values, len(wanted) - 1), wanted, atol=1e-4)


@given(st.floats(0, 2 * math.pi), st.floats(-3, 3), points)
def test_the_foot_on_a_straight_line_is_square(heading: float, start: float, point: tuple) -> None:
    direction = [math.cos(heading), math.sin(heading)]
    at = nearest_along([[1.0, 2.0], direction], np.array(point), start, -1e3, 1e3)
    x, y, dx, dy = horner([[1.0, 2.0], direction], at)
    assert (point[0] - x) * dx + (point[1] - y) * dy == pytest.approx(0, abs=1e-9)
    assert nearest_along([[1.0, 2.0], direction], np.array(point), start, -0.5, 0.5) == pytest.approx(
        min(max(at, -0.5), 0.5)
    )


@given(st.floats(-3.1, 3.1), st.floats(0.1, 9), motions)
def test_angles_are_between_directions(turn: float, size: float, motion: Motion) -> None:
    a, b = np.array([1.0, 0.0]), size * np.array([math.cos(turn), math.sin(turn)])
    assert angle(a, b) == pytest.approx(abs(turn), abs=1e-9)
    assert angle(motion.matrix @ b, motion.matrix @ a) == pytest.approx(abs(turn), abs=1e-9)
    assert angle_of([0.0, 1.0], [0.0, -3.0]) == pytest.approx(math.pi)
