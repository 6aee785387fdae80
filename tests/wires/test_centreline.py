"""Corners beside a crossing: the segment that they lie in is shorter than a bend takes."""

from __future__ import annotations

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.jig.metal import line
from wrapit.geometry import BezierChain, from_chain
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.centreline import bend_rad, join

RADIUS_MM, DIAMETER_MM, ARM_MM = 1.0, 1.0, 20.0
LIFTS = ((0.0, 0.0), (17.0, 0.0), (19.5, 1.0), (20.5, 1.0), (23.0, 0.0), (30.0, 0.0))


def cornered(bend: float, beside_mm: float) -> list[BezierChain]:
    """Two arms that meet in a corner; the second is cut by a crossing so far behind it."""
    out = (math.cos(bend), math.sin(bend))
    corner = (ARM_MM, 0.0)
    crossing = (ARM_MM + beside_mm * out[0], beside_mm * out[1])
    end = (ARM_MM + ARM_MM * out[0], ARM_MM * out[1])
    return [line((0.0, 0.0), corner), line(corner, crossing), line(crossing, end)]


@settings(max_examples=12, deadline=None)
@given(st.floats(30, 145), st.floats(-5, 0.3), st.booleans())
@example(57.0, -4.9, True)
@example(115.0, -1.7, False)
@example(140.0, -3.0, True)
def test_a_corner_beside_a_crossing_is_rounded(degrees: float, exponent: float, lifted: bool) -> None:
    """From a hundredth of a micrometre to two diameters behind it, where the crossing is no corner itself."""
    joined = join(cornered(math.radians(degrees), 10**exponent), RADIUS_MM)
    assert min(corner.radius_mm for corner in joined.corners) >= 0.999 * RADIUS_MM
    cubics = [BezierChain(points[None]) for points in joined.chain.points]
    assert max(map(bend_rad, cubics, cubics[1:]), default=0.0) < 1e-3, "no kink is left"
    wire = round_wire(from_chain(joined.chain), DIAMETER_MM, LIFTS if lifted else (), "wire-01")
    assert wire.solid is not None, wire.flaw
    starts, ends = zip(*joined.spans_mm, strict=True)
    assert list(starts) == sorted(starts)
    assert starts[1:] == ends[:-1]


@pytest.mark.parametrize("beside_mm", [1e-5, 0.02])
def test_where_a_wire_is_widened_it_says_how_far_it_strays(beside_mm: float) -> None:
    bend = math.radians(110)
    (corner,) = join(cornered(bend, beside_mm), RADIUS_MM).corners
    assert corner.deviation_mm == pytest.approx(RADIUS_MM * (1 / math.cos(bend / 2) - 1), rel=0.3)
