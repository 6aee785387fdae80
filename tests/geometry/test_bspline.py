"""One B-spline from a chain and back: the same points, no refit, corners only where there are any."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, motions, smooth_chains, tame_chains
from wrapit.geometry import BezierChain, BSpline, from_chain, joined, straight
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.bspline import SMOOTH_JOINT_MM, chain_of

T = np.linspace(0, 1, 9)


def on_spans(spline: BSpline) -> np.ndarray:
    """Points at even parameters in each span, (n, 9, 2)."""
    breaks = spline.breaks
    u = breaks[:-1, None] + np.diff(breaks)[:, None] * T
    return spline.at(u.ravel()).reshape(-1, len(T), 2)


@given(tame_chains() | smooth_chains())
def test_the_spline_is_the_chain(chain: BezierChain) -> None:
    spline = from_chain(chain)
    assert len(spline.breaks) == len(chain) + 1
    assert np.abs(on_spans(spline) - evaluate(chain.points, T)).max() <= SMOOTH_JOINT_MM + 1e-9
    assert np.array_equal(spline.poles[[0, -1]], [chain.start, chain.end])


@given(smooth_chains())
def test_a_joint_with_one_tangent_needs_no_pole(chain: BezierChain) -> None:
    spline = from_chain(chain)
    assert len(spline.poles) == 4 + 2 * (len(chain) - 1)
    for knot in spline.breaks[1:-1]:
        before, after = spline.derivative(np.array([knot - 1e-9, knot + 1e-9]))
        assert np.allclose(before, after, atol=1e-5)


@given(tame_chains() | smooth_chains())
def test_the_chain_comes_back(chain: BezierChain) -> None:
    again = chain_of(from_chain(chain))
    assert np.abs(again.points - chain.points).max() <= SMOOTH_JOINT_MM + 1e-9
    assert np.array_equal(again.start, chain.start)
    assert np.array_equal(again.end, chain.end)


def test_a_corner_stays_a_corner() -> None:
    chain = joined([straight((0, 0), (5, 0)), straight((5, 0), (5, 5))])
    spline = from_chain(chain)
    assert len(spline.poles) == 7
    assert (spline.poles == [5.0, 0.0]).all(axis=1).any()


@settings(max_examples=30)
@given(st.integers(0, 10_000))
def test_any_cubic_spline_becomes_the_same_curve(seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots = np.concatenate([[0] * 4, np.cumsum(rng.uniform(0.2, 2, 6)), [20] * 4])
    spline = BSpline(3, rng.uniform(0, 10, (10, 2)), knots)
    assert np.abs(evaluate(chain_of(spline).points, T) - on_spans(spline)).max() < 1e-9


@given(smooth_chains(), motions)
def test_curvature_is_signed_and_stays_under_rigid_motion(chain: BezierChain, motion: Motion) -> None:
    spline, moved = from_chain(chain), from_chain(chain.mapped(motion.matrix, motion.shift))
    mirrored = from_chain(chain.mapped(np.diag([1.0, -1.0])))
    inside = np.linspace(*spline.domain, 23)[1:-1]
    inside = inside[np.abs(inside[:, None] - spline.breaks).min(axis=1) > 1e-3]
    share = inside / spline.domain[1]
    curvature = spline.curvature(inside)
    assert np.allclose(moved.curvature(share * moved.domain[1]), curvature, atol=1e-6, rtol=1e-6)
    assert np.allclose(mirrored.curvature(share * mirrored.domain[1]), -curvature, atol=1e-6, rtol=1e-6)


def test_what_is_no_spline_is_refused() -> None:
    with pytest.raises(ValueError, match="knots"):
        BSpline(3, np.zeros((4, 2)), np.zeros(7))
    with pytest.raises(ValueError, match="fall"):
        BSpline(1, np.zeros((2, 2)), np.array([0.0, 1.0, 0.0, 1.0]))
    with pytest.raises(ValueError, match="degree 1"):
        chain_of(BSpline(1, np.zeros((2, 2)), np.array([0.0, 0.0, 1.0, 1.0])))
