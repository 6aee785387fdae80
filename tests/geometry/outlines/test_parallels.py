"""Parallels lie at their distance, on their side, and fold back where the curve is too tight."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, motions, tame_cubics
from wrapit.geometry import Arc, BezierChain, FloatArray, Line
from wrapit.geometry.curveset import CurveSet
from wrapit.geometry.outlines.loops import as_chain
from wrapit.geometry.outlines.parallels import TOLERANCE_MM, Round, Side

offsets = st.floats(-1.5, 1.5).filter(lambda offset: abs(offset) > 0.05)


def whole(edge: BezierChain | Line | Arc, offset: float) -> Side:
    return Side(CurveSet.of([as_chain(edge)]), edge, 0, offset)


@settings(max_examples=60)
@given(tame_cubics(), offsets)
def test_the_parallel_is_at_its_distance_on_its_side(cubic: FloatArray, offset: float) -> None:
    chain = BezierChain(cubic[None])
    side = whole(chain, offset)
    assume(not side.folds(np.array([side.bounds[0]]), np.array([side.bounds[1]]))[0])
    parallel = side.between(*side.bounds)
    found = as_chain(parallel).sampled(0.05)
    # Away from the curve's ends the foot is square to it.
    near = side.curves.nearest(found, abs(offset) + 1)
    assert near.distance.max() <= abs(offset) + 2 * TOLERANCE_MM
    point, tangent, _ = side.curves.frame(near.curve, near.at)
    away = found - point
    inner = np.abs((tangent * away).sum(axis=1)) < 1e-6
    left = tangent[:, 0] * away[:, 1] - tangent[:, 1] * away[:, 0]
    far = near.distance >= abs(offset) - 2 * TOLERANCE_MM
    # The curve itself may come nearer from elsewhere; where it doesn't, the side is the offset's.
    assert (np.sign(left[inner & far]) == np.sign(offset)).all()
    places = np.linspace(*side.bounds, 15)
    exact, _ = side.at(places)
    feet, tangents, _ = side.curves.frame(np.zeros(15, dtype=int), places)
    assert np.allclose(np.linalg.norm(exact - feet, axis=1), abs(offset), atol=1e-9)
    assert np.allclose(((exact - feet) * tangents).sum(axis=1), 0, atol=1e-9)


@settings(max_examples=30)
@given(tame_cubics(), offsets, motions)
def test_parallels_move_with_their_curves(cubic: FloatArray, offset: float, motion: Motion) -> None:
    chain = BezierChain(cubic[None])
    first, second = whole(chain, offset), whole(chain.mapped(motion.matrix, motion.shift), offset)
    places = np.linspace(*first.bounds, 9)
    assert np.allclose(second.at(places)[0], motion.of(first.at(places)[0]), atol=1e-7)


@given(st.floats(1, 20), st.floats(-3, 3), st.floats(0.1, 6), offsets)
def test_the_parallel_of_an_arc_is_an_arc(radius: float, start: float, sweep: float, offset: float) -> None:
    assume(offset < radius - 0.1)
    parallel = whole(Arc((2.0, 1.0), radius, start, sweep), offset)
    found = parallel.between(*parallel.bounds)
    assert isinstance(found, Arc)
    assert found.radius_mm == pytest.approx(radius - offset)
    assert found.sweep_rad == pytest.approx(sweep, abs=1e-6)
    back = parallel.between(*parallel.bounds[::-1])
    assert np.allclose(back.start, found.end, atol=1e-6)


def test_the_parallel_of_a_line_is_a_line_to_its_left() -> None:
    parallel = whole(Line((0, 0), (4, 3)), 1.0)
    found = parallel.between(*parallel.bounds)
    assert isinstance(found, Line)
    assert np.allclose([found.start, found.end], [(-0.6, 0.8), (3.4, 3.8)])


@given(st.floats(1, 10), st.floats(0.2, 3))
def test_a_parallel_folds_only_inside_a_bend_tighter_than_itself(radius: float, share: float) -> None:
    assume(abs(share - 1) > 0.01)
    chain = as_chain(Arc((0.0, 0.0), radius, 0.0, math.pi))
    for offset in (share * radius, -share * radius):
        side = whole(chain, offset)
        folds = side.folds(np.array([side.bounds[0]]), np.array([side.bounds[1]]))[0]
        assert folds == (offset > radius)


def test_a_round_is_a_circle_by_angle() -> None:
    circle = Round((1.0, 2.0), 0.5)
    points, along = circle.at(np.array([0.0, math.pi / 2]))
    assert np.allclose(points, [(1.5, 2.0), (1.0, 2.5)])
    assert np.allclose(along, [(0.0, 0.5), (-0.5, 0.0)])
    assert circle.between(3.0, 1.0) == Arc((1.0, 2.0), 0.5, 3.0, -2.0)
