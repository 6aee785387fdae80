"""Corners beside a crossing, another corner or an end: the side between is shorter than a bend takes."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.jig.metal import line
from wrapit.geometry import BezierChain, from_chain
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.centreline import join
from wrapit.wires.rounding import bend_rad

RADIUS_MM, DIAMETER_MM, ARM_MM = 1.0, 1.0, 20.0
LIFTS = ((0.0, 0.0), (17.0, 0.0), (19.5, 1.0), (20.5, 1.0), (23.0, 0.0), (30.0, 0.0))


def cornered(bend: float, beside_mm: float, then: float | None) -> list[BezierChain]:
    """Two arms that meet in a corner. So far behind it the line bends again, or ends there with None."""
    first, second = (np.array([math.cos(a), math.sin(a)]) for a in (bend, bend + (then or 0.0)))
    corner = np.array([ARM_MM, 0.0])
    crossing = corner + beside_mm * first
    places = [np.zeros(2), corner, crossing]
    if then is not None:
        places.append(crossing + ARM_MM * second)
    return [line(tuple(a), tuple(b)) for a, b in itertools.pairwise(places)]


BENDS = st.floats(30, 145)
# From a hundredth of a micrometre to two diameters.
EXPONENTS = st.floats(-5, 0.3)


def assert_sound(curves: list[BezierChain], lifted: bool) -> None:
    """These curves become a wire without kinks, with a solid and spans in their order."""
    joined = join(curves, RADIUS_MM)
    cubics = [BezierChain(points[None]) for points in joined.chain.points]
    assert max(map(bend_rad, cubics, cubics[1:]), default=0.0) < 1e-3, "no kink is left"
    wire = round_wire(from_chain(joined.chain), DIAMETER_MM, LIFTS if lifted else (), "wire-01")
    assert wire.solid is not None, wire.flaw
    starts, ends = zip(*joined.spans_mm, strict=True)
    assert len(starts) == len(curves)
    assert list(starts) == sorted(starts)
    assert starts[1:] == ends[:-1]
    assert (starts[0], ends[-1]) == (0.0, pytest.approx(joined.chain.length))
    assert np.array_equal(joined.chain.start, curves[0].start)
    assert np.array_equal(joined.chain.end, curves[-1].end)


@settings(max_examples=12, deadline=None)
@given(BENDS, st.floats(-5, -0.01), st.booleans(), st.booleans())  # nearer than a bend's radius
@example(57.0, -4.9, True, False)
@example(115.0, -1.7, False, True)
@example(140.0, -3.0, True, False)
def test_a_corner_beside_a_crossing_is_rounded(
    degrees: float, exponent: float, lifted: bool, backwards: bool
) -> None:
    curves = cornered(math.radians(degrees), 10**exponent, 0.0)
    if backwards:
        curves = [curve.reversed() for curve in curves[::-1]]
    assert_sound(curves, lifted)
    corners = join(curves, RADIUS_MM).corners
    assert min(corner.radius_mm for corner in corners) >= 0.999 * RADIUS_MM


@settings(max_examples=12, deadline=None)
@given(BENDS, EXPONENTS, st.floats(-60, 60), st.booleans())
@example(145.0, -3.7, -0.09, True)
@example(84.0, -3.55, 0.01, False)
@example(117.0, -1.84, 30.7, False)
def test_corners_with_a_sliver_between_are_one(
    degrees: float, exponent: float, then: float, lifted: bool
) -> None:
    assert_sound(cornered(math.radians(degrees), 10**exponent, math.radians(then)), lifted)


@settings(max_examples=12, deadline=None)
@given(BENDS, EXPONENTS, st.booleans(), st.booleans())
@example(145.0, -3.6, False, False)
@example(139.0, -1.56, False, True)
def test_a_line_that_ends_just_behind_a_corner_ends_there(
    degrees: float, exponent: float, lifted: bool, backwards: bool
) -> None:
    curves = cornered(math.radians(degrees), 10**exponent, None)
    assert_sound([curve.reversed() for curve in curves[::-1]] if backwards else curves, lifted)


@settings(max_examples=12, deadline=None)
@given(st.floats(40, 100), st.floats(0.15, 0.6), st.floats(15, 40))
@example(100.0, 0.4, 15.0)
def test_a_corner_between_sides_of_short_lines_has_their_room(
    degrees: float, step_mm: float, radius_mm: float
) -> None:
    """Two arcs, written as short straight lines, meet in a corner."""
    arc = np.full(30, step_mm / radius_mm)
    courses = np.cumsum(np.r_[0.0, arc, math.radians(degrees), arc])
    steps = step_mm * np.column_stack([np.cos(courses), np.sin(courses)])
    places = np.cumsum(np.vstack([[0.0, 0.0], steps]), axis=0)
    curves = [line(tuple(a), tuple(b)) for a, b in itertools.pairwise(places)]
    assert_sound(curves, lifted=False)
    (corner,) = [corner for corner in join(curves, RADIUS_MM).corners if corner.bend_rad > 0.6]
    assert corner.radius_mm >= 0.999 * RADIUS_MM


def test_many_short_sides_are_a_curve_and_stay() -> None:
    """A circle of sides of a tenth of a millimetre, as some programs write it."""
    angles = np.linspace(0, math.pi, 320)
    places = 10 * np.column_stack([np.cos(angles), np.sin(angles)])
    joined = join([line(tuple(a), tuple(b)) for a, b in itertools.pairwise(places)], RADIUS_MM)
    radii = np.linalg.norm(joined.chain.sampled(0.02), axis=1)
    assert np.abs(radii - 10).max() < 0.01
    assert joined.chain.length == pytest.approx(10 * math.pi, rel=1e-3)


@pytest.mark.parametrize("beside_mm", [1e-5, 0.02])
def test_where_a_wire_is_widened_it_says_how_far_it_strays(beside_mm: float) -> None:
    bend = math.radians(110)
    (corner,) = join(cornered(bend, beside_mm, 0.0), RADIUS_MM).corners
    assert corner.deviation_mm == pytest.approx(RADIUS_MM * (1 / math.cos(bend / 2) - 1), rel=0.3)
