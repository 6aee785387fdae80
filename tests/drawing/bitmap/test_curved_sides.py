"""Corners with short curved sides between them."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import CENTRE, TURNS, few, in_pixels, scallops, turned
from tests.drawing.bitmap.test_short_sides import outline
from tests.drawing.generated import Points, degrees
from wrapit.drawing.bitmap.corners.curved_sides import Curves, curves_of, fitted_curves
from wrapit.drawing.model import Drawing


def step(radius: float, side: float, turn_degrees: float, width: float) -> tuple[Points, Points]:
    """Two opposite corners with an arc between them and long straight outer sides; and the two corners."""
    along = np.linspace(0, side, 30) / radius
    arc = radius * np.column_stack([np.sin(along), 1 - np.cos(along)])
    start, end = -math.radians(turn_degrees), along[-1] - math.radians(turn_degrees)
    before = arc[0] - 7 * np.array([math.cos(start), math.sin(start)])
    after = arc[-1] + 7 * np.array([math.cos(end), math.sin(end)])
    points = np.vstack([before, arc, after]) * width
    shift = CENTRE - (points.min(axis=0) + points.max(axis=0)) / 2
    return points + shift, arc[[0, -1]] * width + shift


def has_corners(drawing: Drawing, corners: Points, width: float) -> bool:
    """Whether an open line has two corners, and one within a quarter of a width of each place."""
    places = [
        in_pixels(drawing, drawing.junctions[j].point)
        for j, ends in enumerate(drawing.half_edges())
        if len(ends) == 2
    ]
    near = [any(np.linalg.norm(place - corner) < 0.25 * width for place in places) for corner in corners]
    return degrees(drawing) == [1, 1, 2, 2] and all(near)


@few
@given(st.floats(1.5, 4), st.floats(1.3, 2), st.floats(85, 105), st.floats(10, 18), TURNS)
def test_a_step_with_a_curved_side_has_both_its_corners(traced, radius, side, turn_degrees, width, turn):
    points, corners = step(radius, side, turn_degrees, width)
    drawing, _ = traced([turned(points, turn)], width)
    assert has_corners(drawing, turned(corners, turn), width)


def bend_and_corner(bend: float, radius: float, side: float, corner: float, width: float) -> Points:
    """A round bend, a short straight side, and a corner that turns the other way, between long lines.

    The corner is the last point but one.
    """
    a = math.radians(bend)
    t = np.linspace(0, a, 24)
    arc = radius * np.column_stack([np.sin(t), 1 - np.cos(t)])
    apex = arc[-1] + side * np.array([math.cos(a), math.sin(a)])
    leaving = a - math.radians(corner)
    points = (
        np.vstack([[-7, 0], arc, apex, apex + 7 * np.array([math.cos(leaving), math.sin(leaving)])]) * width
    )
    return points + CENTRE - (points.min(axis=0) + points.max(axis=0)) / 2


@few
@given(
    st.floats(60, 95),
    st.floats(0.8, 1.4),
    st.floats(0.85, 1.4),
    st.floats(70, 95),
    st.floats(10, 16),
    TURNS,
)
def test_a_round_bend_beside_a_corner_moves_it_nowhere(traced, bend, radius, side, corner, width, turn):
    """As at a shirt's armpit: the bend is no part of the corner's side."""
    points = turned(bend_and_corner(bend, radius, side, corner, width), turn)
    drawing, _ = traced([points], width)
    assert degrees(drawing) == [1, 1, 2]
    course = np.concatenate(
        [[in_pixels(drawing, at) for at in s.curve.sampled(0.05)] for s in drawing.segments]
    )
    away = min(np.linalg.norm(course - points[-2], axis=1))
    assert away < 0.1 * width


def hook(side: float, turns: tuple[float, float], radius: float, width: float) -> tuple[Points, Points]:
    """A straight side between two long arcs, which it meets at turns of one sense; and where it meets them.

    The line turns everywhere, so that its corners stand in a crowd; with a `radius` they are round.
    """
    first, second = (math.radians(angle) for angle in turns)
    # Length and turn of each part: an arc, a corner, the side, a corner, an arc. (Arcs bend the other way.)
    parts = [
        (12.0, -12 / 5),
        (radius * first, first),
        (side, 0.0),
        (radius * second, second),
        (12.0, -12 / 5),
    ]
    points, course, corners = [np.zeros(2)], 0.0, []
    for k, (length, by) in enumerate(parts):
        if k in (1, 3):
            corners.append(points[-1])
        for _ in range(80):
            course += by / 160
            points.append(points[-1] + length / 80 * np.array([math.cos(course), math.sin(course)]))
            course += by / 160
    chain = np.array(points) * width
    shift = CENTRE - (chain.min(axis=0) + chain.max(axis=0)) / 2
    return chain + shift, np.array(corners) * width + shift


HOOKS = st.tuples(st.floats(66, 80), st.floats(66, 80))


@few
# (Closer than a width and a half, three in ten such hooks read as bends.)
@given(st.floats(1.55, 2), HOOKS, st.floats(9, 14), TURNS)
def test_two_close_corners_of_one_sense_between_arcs_are_found(traced, side, turns, width, turn):
    points, corners = hook(side, turns, 0.0, width)
    drawing, _ = traced([turned(points, turn)], width)
    assert has_corners(drawing, turned(corners, turn), width)


@few
@given(st.floats(0.4, 1.2), HOOKS, st.floats(0.5, 0.9), st.floats(9, 14), TURNS)
def test_two_close_bends_between_arcs_are_no_corners(traced, side, turns, radius, width, turn):
    points, _ = hook(side, turns, radius, width)
    drawing, _ = traced([turned(points, turn)], width)
    assert degrees(drawing) == [1, 1]


@few
# (Of tighter arcs and gentler cusps more are lost: see `tests.bench cusps`.)
@given(st.floats(2.4, 4.5), st.floats(88, 115), st.floats(6, 12), TURNS)
def test_cusps_between_arcs_are_corners(traced, radius, turn_degrees, width, turn):
    points, cusps = scallops(radius, turn_degrees, 3, width)
    drawing, _ = traced([turned(points, turn)], width)
    assert has_corners(drawing, turned(cusps, turn), width)


@few
@given(st.floats(2.4, 4.5), st.floats(20, 50), st.floats(6, 12), TURNS)
def test_a_wavy_line_has_no_cusps(traced, radius, half_degrees, width, turn):
    """Arcs to one side and the other in turn, without a corner between them."""
    half = math.radians(half_degrees)
    angles, chord = np.linspace(-half, half, 60), 2 * radius * math.sin(half)
    arcs = [
        np.column_stack(
            [k * chord + radius * np.sin(angles), (-1) ** k * radius * (np.cos(half) - np.cos(angles))]
        )
        for k in range(4)
    ]
    points = np.vstack(arcs) * width
    drawing, _ = traced([turned(points + CENTRE - points.mean(axis=0), turn)], width)
    assert degrees(drawing) == [1, 1]


def test_edges_alone_tell_corners_between_arcs():
    width = 10.0
    points, corners = step(2.0, 1.8, 95, width)
    middle = np.vstack([np.linspace(a, b, 9)[:-1] for a, b in itertools.pairwise(points)])
    found = curves_of(middle, [], outline(points, width), width, 0.02)
    assert found is not None
    assert len(found.corners) == 4
    assert np.abs(found.corners[1:-1] - corners).max() < 0.08 * width


def test_a_side_starts_and_ends_in_its_own_directions():
    curves = Curves(np.array([[0.0, 0.0], [4.0, 0.0]]), np.array([[0.0, 1.0]]))
    assert curves.leaving[0] == pytest.approx([math.sqrt(0.5), math.sqrt(0.5)])
    assert curves.arriving[0] == pytest.approx([math.sqrt(0.5), -math.sqrt(0.5)])
    assert curves.points(0, np.array([0.5]))[0] == pytest.approx([2, 1])
    assert curves.facets[2] == pytest.approx([2, 1])


def test_a_fit_is_never_worse_than_its_start():
    width = 10.0
    points, corners = step(2.0, 1.8, 95, width)
    start = Curves(
        np.vstack([points[:1], corners + np.array([[2, 1], [-1, 2]]), points[-1:]]), np.zeros((3, 2))
    )
    edge = outline(points, width)
    found, seen = fitted_curves(start, edge, width)
    assert seen.rms < 0.02
    assert (found.bulges * np.diff(found.corners, axis=0)).sum(axis=1) == pytest.approx(0, abs=1e-6)
