"""Length along curves and its inverse are exact; parts of curves have their lengths and meet."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import arc_chain
from tests.geometry.shapes import finely_measured, tame_chains
from wrapit.geometry import BezierChain, from_chain, joined, straight
from wrapit.geometry.arclength import ArcLength, cut, piece
from wrapit.geometry.bspline import SMOOTH_JOINT_MM, chain_of

CORNERED = joined([arc_chain((0, 0), 5, -np.pi / 2, np.pi / 2), straight((5.0, 0.0), (9.0, -3.0))])
CUT_ERRS_MM = 6e-3
shares = st.floats(0.001, 0.999)


@settings(max_examples=40)
@given(tame_chains(), st.lists(shares, min_size=1, max_size=9))
def test_the_table_is_exact_and_inverts(chain: BezierChain, at: list[float]) -> None:
    lengths = ArcLength(from_chain(chain))
    # Of the spline: where a joint is all but smooth it leaves out a pole, and is as much off the chain.
    assert lengths.total_mm == pytest.approx(finely_measured(chain_of(lengths.spline)), abs=1e-9)
    at_mm = np.array(sorted(at)) * lengths.total_mm
    u = lengths.parameter(at_mm)
    assert np.allclose(lengths.length(u), at_mm, atol=1e-9)
    assert (np.diff(u) >= 0).all()


@given(st.sampled_from([0.0, 1e-12, 5e-8, 1e-6]), st.floats(-3, 3), st.lists(shares, min_size=1, max_size=9))
def test_the_inverse_is_exact_where_a_curve_starts_from_rest(
    handle_mm: float, heading: float, at: list[float]
) -> None:
    handle = handle_mm * np.array([np.cos(heading), np.sin(heading)])
    resting = BezierChain(np.array([[(0.0, 0.0), handle, (9.0, 3.0), (10.0, 0.0)]]))
    lengths = ArcLength(from_chain(resting))
    at_mm = np.array(sorted(at)) ** 3 * lengths.total_mm
    assert np.allclose(lengths.length(lengths.parameter(at_mm)), at_mm, rtol=0, atol=1e-8)


def test_a_joint_that_is_all_but_smooth_is_measured_as_the_spline_has_it() -> None:
    before = [(0.0, 0.0), (0.2026, 0.3156), (0.75, 0.0), (1.0, 0.0)]
    after = [(1.0, 0.0), (1.25, 1.5e-8), (1.75, 0.0), (2.0, 0.0)]
    chain = BezierChain(np.array([before, after]))
    lengths = ArcLength(from_chain(chain))
    assert lengths.total_mm == pytest.approx(finely_measured(chain_of(lengths.spline)), abs=1e-12)
    assert lengths.total_mm == pytest.approx(chain.length, abs=SMOOTH_JOINT_MM)


@settings(max_examples=40)
@given(tame_chains(), shares)
def test_the_table_and_the_piece_agree(chain: BezierChain, share: float) -> None:
    lengths = ArcLength(from_chain(chain))
    at_mm = share * lengths.total_mm
    found = lengths.spline.at(lengths.parameter(np.array([at_mm])))[0]
    assert np.allclose(piece(chain, 0.0, at_mm).end, found, atol=2e-6)


def test_beyond_the_ends_is_the_end() -> None:
    lengths = ArcLength(from_chain(CORNERED))
    assert lengths.parameter(np.array([-1.0, 1e9])).tolist() == list(lengths.spline.domain)


@given(st.floats(0.01, 3))
def test_stations_are_even_and_hold_both_ends(step: float) -> None:
    lengths = ArcLength(from_chain(CORNERED))
    at_mm = lengths.stations(step)
    assert at_mm[0] == 0
    assert at_mm[-1] == lengths.total_mm
    assert np.ptp(np.diff(at_mm)) < 1e-9
    assert np.diff(at_mm).max() <= step + 1e-9


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


@given(tame_chains(), shares, shares)
def test_any_piece_has_its_length_to_the_nanometre(chain: BezierChain, a: float, b: float) -> None:
    start, end = sorted((a * chain.length, b * chain.length))
    if end - start > 1e-6:
        assert piece(chain, start, end).length == pytest.approx(end - start, abs=1e-8)


@settings(max_examples=25)
@given(tame_chains(), st.sampled_from([-1e-10, -1e-12, 0.0, 1e-12, 1e-10]))
def test_pieces_that_end_at_joints_have_no_cubic_of_no_length(chain: BezierChain, off: float) -> None:
    reach = [0.0, *np.cumsum(chain.lengths)]
    for start, end in itertools.combinations(reach, 2):
        part = piece(chain, start + off, end + off)
        assert part.lengths.min() > 1e-3
        assert part.length == pytest.approx(end - start, abs=1e-6)
    for joint in reach[1:-1]:
        for half in cut(chain, joint + off):
            assert half.lengths.min() > 1e-3


@given(tame_chains(), shares)
def test_both_parts_of_a_cut_are_the_chain(chain: BezierChain, share: float) -> None:
    at_mm = share * chain.length
    before, after = cut(chain, at_mm)
    assert np.array_equal(before.end, after.start)
    assert before.length == pytest.approx(at_mm, abs=CUT_ERRS_MM)
    assert before.length + after.length == pytest.approx(chain.length, rel=1e-9)


@pytest.mark.parametrize("at_mm", [-1.0, 0.0, 7.0, 8.0])
def test_nothing_is_cut_off_at_or_beyond_an_end(at_mm: float) -> None:
    with pytest.raises(ValueError, match="can't cut"):
        cut(straight((0, 0), (7, 0)), at_mm)
