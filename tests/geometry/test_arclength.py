"""Splines as Béziers and parts of curves are exact."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import arc_chain
from wrapit.geometry import BSpline, from_chain, joined, straight
from wrapit.geometry.arclength import piece
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.bspline import chain_of

CORNERED = joined([arc_chain((0, 0), 5, -np.pi / 2, np.pi / 2), straight((5.0, 0.0), (9.0, -3.0))])


def test_a_chain_comes_back_from_its_spline() -> None:
    again = chain_of(from_chain(CORNERED))
    assert np.abs(again.points - CORNERED.points).max() < 1e-12


def test_any_cubic_spline_becomes_the_same_curve() -> None:
    rng = np.random.default_rng(0)
    knots = np.concatenate([[0] * 4, np.cumsum(rng.uniform(0.2, 2, 6)), [20] * 4])
    spline = BSpline(3, rng.uniform(0, 10, (10, 2)), knots)
    chain = chain_of(spline)
    breaks = spline.breaks
    t = np.linspace(0, 1, 9)
    u = breaks[:-1, None] + np.diff(breaks)[:, None] * t
    assert np.abs(evaluate(chain.points, t) - spline.at(u.ravel()).reshape(-1, 9, 2)).max() < 1e-9


@given(st.floats(0, 1), st.floats(0, 1))
def test_pieces_have_their_lengths_and_meet(a: float, b: float) -> None:
    start, end = sorted((a * CORNERED.length, b * CORNERED.length))
    if end - start < 1e-6:
        with pytest.raises(ValueError, match="no curve"):
            piece(CORNERED, end + 1e-6, start)
        return
    part = piece(CORNERED, start, end)
    assert part.length == pytest.approx(end - start, abs=1e-6)
    if start > 1e-6:
        assert np.allclose(piece(CORNERED, 0, start).end, part.start, atol=1e-6)
