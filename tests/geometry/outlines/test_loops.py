"""Edges moved, turned round and made keep what they promise."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon, box

from tests.exports.pieces_for_tests import arc_chain
from wrapit.geometry import Arc, Line, Loop, Region
from wrapit.geometry.outlines.loops import (
    as_chain,
    circle,
    is_circle,
    moved,
    oriented,
    reversed_edge,
    reversed_loop,
    rounded_rectangle,
    turns_left,
)

sizes = st.floats(1, 50)


def area(loop: Loop) -> float:
    return Polygon(loop.sampled(1e-5)).area


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 7), st.floats(-20, 20), st.floats(-20, 20))
def test_moving_keeps_length_and_turns_by_right_angles(quarters: int, x: float, y: float) -> None:
    edges = [Line((1, 2), (3, 5)), Arc((1, 1), 2.0, 0.3, 4.0), arc_chain((2, 0), 3.0, 0.5, 2.0)]
    turn = quarters * math.pi / 2
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    for edge in edges:
        got = moved(edge, quarters, (x, y)).sampled(0.1)
        assert np.allclose(got, edge.sampled(0.1) @ matrix.T + [x, y], atol=1e-9)


def test_orientation_is_set_and_turned_round() -> None:
    loop = Loop((arc_chain((0, 0), 8.0, 0.0, math.pi), Line((-8, 0), (8, 0))))
    assert turns_left(loop)
    assert not turns_left(reversed_loop(loop))
    region = oriented(Region(reversed_loop(loop), (circle((0, 3), 1.0),)))
    assert turns_left(region.outer)
    assert not turns_left(region.holes[0])
    assert area(region.outer) == pytest.approx(area(loop), rel=1e-6)


@given(st.floats(0.1, 50), st.floats(-6, 6), st.floats(0.05, math.tau), st.sampled_from([7.5, 22.5, 60.0]))
def test_arcs_become_cubics_as_near_as_they_say(
    radius: float, start: float, sweep: float, most: float
) -> None:
    piece = math.radians(most)
    stray = 2 / 27 * math.sin(piece / 4) ** 6 / math.cos(piece / 4) ** 2
    assert stray < {7.5: 1e-10, 22.5: 7e-8, 60.0: 2.5e-5}[most]
    for arc in (Arc((1.0, -2.0), radius, start, sweep), Arc((1.0, -2.0), radius, start, -sweep)):
        chain = as_chain(arc, piece)
        away = np.hypot(*(chain.sampled(radius / 100) - np.array(arc.centre)).T) / radius - 1
        assert away.min() > -1e-14
        assert away.max() < 1.01 * stray + 1e-14
        assert np.allclose(chain.start, arc.start, atol=1e-12)
        assert np.allclose(chain.end, arc.end, atol=1e-12)
        assert chain.length == pytest.approx(radius * sweep, rel=1e-4)


@given(sizes, sizes, st.just(0.0) | st.floats(0.01, 30))
def test_rounded_rectangles_are_shapelys(width: float, height: float, radius: float) -> None:
    loop = rounded_rectangle(-1, 2, width - 1, height + 2, radius)
    fits = min(radius, width / 2, height / 2)
    fits = min(fits, 0.9999999 * min(width, height) / 2)  # or nothing is left to grow
    inner = box(fits - 1, fits + 2, width - 1 - fits, height + 2 - fits)
    assert turns_left(loop)
    assert Polygon(loop.sampled(1e-4)).symmetric_difference(inner.buffer(fits, quad_segs=1000)).area < 0.03
    for before, after in zip(loop.edges, loop.edges[1:] + loop.edges[:1], strict=True):
        assert math.dist(before.end, after.start) < 1e-9


def test_a_full_circle_is_one_edge() -> None:
    assert is_circle(circle((1, 2), 3.0).edges)
    assert is_circle(reversed_loop(circle((1, 2), 3.0)).edges)
    assert not is_circle((Arc((1, 2), 3.0, 0.0, 6.0),))
    assert not is_circle((Line((0, 0), (1, 0)),))
    assert not is_circle((Arc((0, 0), 1.0, 0.0, math.pi), Arc((0, 0), 1.0, math.pi, math.pi)))


@given(st.floats(0.1, 20), st.floats(-6, 6), st.floats(-math.tau, math.tau).filter(lambda a: abs(a) > 0.01))
def test_travelled_back_twice_is_the_edge(radius: float, start: float, sweep: float) -> None:
    for edge in (
        Arc((1, 2), radius, start, sweep),
        Line((1, 2), (3, radius)),
        arc_chain((0, 0), radius, 0, 2),
    ):
        back = reversed_edge(edge)
        assert np.allclose(back.sampled(0.1), edge.sampled(0.1)[::-1], atol=1e-9)
        assert np.allclose(reversed_edge(back).sampled(0.1), edge.sampled(0.1), atol=1e-9)
