"""The Bézier fit keeps ends, tangents and tolerance, and uses few pieces."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.geometry import unit
from wrapit.geometry.fitting.fit import Stroke, fit, fit_all


def wave(turns: float, noise: float = 0.0, count: int = 300) -> Stroke:
    t = np.linspace(0, 1, count)
    points = np.column_stack([200 * t, 40 * np.sin(2 * np.pi * turns * t)])
    points[1:-1] += np.random.default_rng(0).normal(0, noise, (count - 2, 2)) if noise else 0.0
    slope = 40 * 2 * np.pi * turns
    return Stroke(points, np.array([200, slope]), np.array([200, slope * np.cos(2 * np.pi * turns)]))


@settings(max_examples=25, deadline=None, derandomize=True)
@given(st.floats(0.1, 3), st.floats(0.05, 1.0))
def test_the_curve_stays_within_tolerance_and_keeps_ends_and_tangents(turns, tolerance):
    stroke = wave(turns)
    chain = fit(stroke, tolerance)
    near = chain.sampled(0.05)
    far = np.array([np.linalg.norm(near - point, axis=1).min() for point in stroke.points])
    assert far.max() <= tolerance * 1.02 + 0.03
    assert np.array_equal(chain.start, stroke.points[0])
    assert np.array_equal(chain.end, stroke.points[-1])
    assert chain.start_tangent == pytest.approx(unit(stroke.start_tangent), abs=1e-9)
    assert chain.end_tangent == pytest.approx(unit(stroke.end_tangent), abs=1e-9)


def test_joints_have_one_tangent():
    chain = fit(wave(2.5, 0.1), 0.3)
    assert len(chain) > 2
    for before, after in itertools.pairwise(chain.points):
        assert unit(before[3] - before[2]) == pytest.approx(unit(after[1] - after[0]), abs=1e-9)


def test_noise_within_tolerance_costs_no_pieces():
    assert len(fit(wave(0.2, 0.05), 0.3)) == 1
    assert len(fit(wave(2.0, 0.05), 0.3)) <= 9


def test_a_straight_line_is_one_piece():
    points = np.column_stack([np.linspace(0, 9, 50), np.zeros(50)])
    assert len(fit(Stroke(points, np.array([1.0, 0]), np.array([1.0, 0])), 0.01)) == 1


def test_many_strokes_at_once_are_as_each_alone():
    strokes = [
        wave(0.3),
        wave(1.7, 0.1),
        wave(0.9),
        Stroke(np.eye(2), np.array([1.0, 0]), np.array([0, 1.0])),
    ]
    for together, stroke in zip(fit_all(strokes, 0.2), strokes, strict=True):
        assert together.points == pytest.approx(fit(stroke, 0.2).points, abs=1e-6)


def test_a_single_point_is_no_stroke():
    with pytest.raises(ValueError, match="two points"):
        fit(Stroke(np.zeros((1, 2)), np.array([1.0, 0]), np.array([1.0, 0])), 0.1)
