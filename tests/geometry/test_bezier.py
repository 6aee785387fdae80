"""Chains of cubics: exact where they are split, turned, measured and sampled."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, finely_measured, mirrorings, motions, tame_chains, tame_cubics
from wrapit.geometry import BezierChain, FloatArray, joined, straight
from wrapit.geometry.bezier import derivative, evaluate, second_derivative, split

PLACES = np.linspace(0, 1, 9)


@given(tame_cubics(), st.floats(0.01, 0.99))
def test_the_parts_of_a_split_are_the_curve(cubic: FloatArray, t: float) -> None:
    left, right = split(cubic[None], t)
    assert np.array_equal(left[0, 3], right[0, 0])
    assert np.allclose(evaluate(left, PLACES), evaluate(cubic[None], t * PLACES), atol=1e-12)
    assert np.allclose(evaluate(right, PLACES), evaluate(cubic[None], t + (1 - t) * PLACES), atol=1e-12)


@given(tame_cubics())
def test_derivatives_are_those_of_the_points(cubic: FloatArray) -> None:
    t, step = np.linspace(0.1, 0.9, 5), 1e-4
    ahead, here, behind = (evaluate(cubic[None], t + shift)[0] for shift in (step, 0.0, -step))
    assert np.allclose(derivative(cubic[None], t)[0], (ahead - behind) / (2 * step), atol=1e-4)
    second = (ahead - 2 * here + behind) / step**2
    assert np.allclose(second_derivative(cubic[None], t)[0], second, atol=1e-3)


@settings(max_examples=40)
@given(tame_chains(), motions | mirrorings)
def test_lengths_are_exact_and_stay_under_rigid_motion(chain: BezierChain, motion: Motion) -> None:
    assert chain.length == pytest.approx(finely_measured(chain), rel=1e-9)
    moved = chain.mapped(motion.matrix, motion.shift)
    assert moved.length == pytest.approx(chain.length, rel=1e-12)
    places = evaluate(chain.points, PLACES)
    assert np.allclose(evaluate(moved.points, PLACES), motion.of(places), atol=1e-9)
    assert np.allclose(moved.start_tangent, motion.matrix @ chain.start_tangent, atol=1e-9)


@given(tame_chains())
def test_backwards_is_the_same_curve(chain: BezierChain) -> None:
    back = chain.reversed()
    assert np.array_equal(back.reversed().points, chain.points)
    assert back.length == pytest.approx(chain.length, rel=1e-12)
    assert np.array_equal(back.start_tangent, -chain.end_tangent)


@given(tame_chains(), st.floats(0.05, 5))
def test_samples_hold_both_ends_and_lie_close_enough(chain: BezierChain, step: float) -> None:
    sampled = chain.sampled(step)
    assert np.array_equal(sampled[0], chain.start)
    assert np.allclose(sampled[-1], chain.end, atol=1e-12)
    # Even in parameter, not in length: a tame cubic runs at most three times as fast as on average.
    assert np.linalg.norm(np.diff(sampled, axis=0), axis=1).max() <= 3 * step + 1e-12


def test_a_handle_of_no_length_takes_the_next_for_its_tangent() -> None:
    chain = BezierChain(np.array([[(0, 0), (0, 0), (3, 4), (3, 4)]], dtype=float))
    assert chain.start_tangent == pytest.approx([0.6, 0.8])
    assert chain.end_tangent == pytest.approx([0.6, 0.8])


@pytest.mark.parametrize(
    ("points", "said"),
    [
        (np.zeros((4, 2)), "shape"),
        (np.zeros((0, 4, 2)), "shape"),
        (np.full((1, 4, 2), np.nan), "finite"),
        (np.arange(16.0).reshape(2, 4, 2), "starts where"),
    ],
)
def test_what_is_no_chain_is_refused(points: FloatArray, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        BezierChain(points)


def test_chains_are_joined_only_where_they_meet() -> None:
    first = straight((0, 0), (3, 0))
    assert joined([first, straight((3, 0), (3, 4))]).length == pytest.approx(7)
    with pytest.raises(ValueError, match="starts where"):
        joined([first, straight((3.0000001, 0), (3, 4))])


def test_points_are_locked() -> None:
    with pytest.raises(ValueError, match="read-only"):
        straight((0, 0), (1, 0)).points[0, 0, 0] = 5.0
