"""Wires of cubics that turn back on themselves: bent where there is room, smoothed where it is a slip."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import cubics_with_tips
from wrapit.geometry import BezierChain, FloatArray, from_chain
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.centreline import join
from wrapit.wires.fairing import faired

RADIUS_MM, DIAMETER_MM = 1.0, 0.8


def chain(*cubics: list[tuple[float, float]]) -> BezierChain:
    return BezierChain(np.array(cubics, dtype=float))


@settings(max_examples=15, deadline=None)
@given(cubics_with_tips())
def test_a_wire_with_a_tip_has_a_sound_solid(cubic: FloatArray) -> None:
    joined = join([BezierChain(cubic[None])], RADIUS_MM)
    assert np.array_equal(joined.chain.start, cubic[0])
    assert np.array_equal(joined.chain.end, cubic[3])
    wire = round_wire(from_chain(joined.chain), DIAMETER_MM, (), "wire-01")
    assert wire.solid is not None, wire.flaw


@given(st.floats(0.2, 1.3), st.floats(-0.05, 0.05), st.floats(-0.05, 0.05))
def test_out_and_back_by_less_than_a_bend_is_a_slip(chord: float, one: float, other: float) -> None:
    """Handles of 1.5 mm along a way that is shorter: a drawing of 214 segments had 32 such."""
    slip = chain([(0, 0), (1.5, one), (chord - 1.5, other), (chord, 0)])
    fair = faired(slip, RADIUS_MM)
    assert len(fair) == 1
    assert fair.length < slip.length + 1e-9
    assert fair.length < chord * 1.1


def test_a_speck_within_a_line_goes() -> None:
    line = chain(
        [(0, 0), (10, 0), (30, 0), (40, 0)],
        [(40, 0), (40.6, 0), (40, 0.4), (40, 0)],
        [(40, 0), (50, 0), (60, 0), (70, 0)],
    )
    joined = join([line], RADIUS_MM)
    assert joined.chain.length == pytest.approx(70, abs=1e-9)
    assert joined.corners == ()


def test_two_sides_that_part_become_a_hairpin_and_a_doubled_wire_stays_folded() -> None:
    out = [(0.0, 0.0), (20.0, 0.0), (40.0, 20.0), (40.0, 40.0)]
    parting = join([chain(out, [(40, 40), (40, 20), (60, 0), (80, 0)])], RADIUS_MM)
    assert [round(corner.bend_rad, 6) for corner in parting.corners] == [round(np.pi, 6)]
    assert parting.corners[0].radius_mm >= 0.999 * RADIUS_MM
    assert join([chain(out, out[::-1])], RADIUS_MM).corners == ()


def test_a_long_way_out_and_back_stays_in_the_wire() -> None:
    """Over more than a bend it is meant, and folded at its tip."""
    there = chain([(0, 0), (20, 0), (60, 0), (40, 0)])
    joined = join([there], RADIUS_MM)
    assert joined.chain.length == pytest.approx(there.length, abs=0.01)
    assert len(joined.chain) == 2
