"""Corners with short sides between them: both edges of the ink show all of them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import CENTRE, TURNS, few, in_pixels, turned
from tests.drawing.generated import Points, degrees
from wrapit.drawing.bitmap.centre_lines import smoothed
from wrapit.drawing.bitmap.corners.edge_fit import chain_of, fitted, missed, turns
from wrapit.geometry.polyline import at_lengths, lengths

WIDE = st.floats(10, 18)


def chain(turn_degrees: list[float], side: float, width: float) -> Points:
    """Straight sides, the outer two seven widths long, around the middle of the picture."""
    courses = np.radians(np.cumsum([0.0, *turn_degrees]))
    sides = [7.0, *[side] * (len(turn_degrees) - 1), 7.0]
    steps = np.array(sides)[:, None] * np.column_stack([np.cos(courses), np.sin(courses)])
    points = np.vstack([np.zeros((1, 2)), np.cumsum(steps, axis=0)]) * width
    return points - (points.min(axis=0) + points.max(axis=0)) / 2 + CENTRE


def outline(corners: Points, width: float) -> Points:
    """Points on the edges of the ink of a chain with round joins, without its ends."""
    from shapely.geometry import LineString, Point

    ink = LineString(corners).buffer(width / 2, quad_segs=32).exterior
    along = np.arange(0, ink.length, width / 8)
    points = np.array([ink.interpolate(at).coords[0] for at in along])
    ends = [Point(corners[k]) for k in (0, -1)]
    return points[[all(end.distance(Point(point)) > width for end in ends) for point in points]]


@few
@given(st.floats(1.2, 2.5), st.floats(80, 100), st.floats(80, 100), WIDE, TURNS)
def test_a_step_has_both_its_corners(traced, side, first, second, width, turn):
    step = turned(chain([first, -second], side, width), turn)
    drawing, _ = traced([step], width)
    assert degrees(drawing) == [1, 1, 2, 2]
    places = [
        in_pixels(drawing, drawing.junctions[j].point)
        for j, ends in enumerate(drawing.half_edges())
        if len(ends) == 2
    ]
    for corner in step[1:-1]:
        assert min(np.linalg.norm(place - corner) for place in places) < 0.15 * width


@few
@given(st.floats(0.6, 1.2), WIDE, TURNS)
def test_a_rounded_step_has_none(traced, radius, width, turn):
    bend = np.linspace(0, math.pi / 2, 40)
    arc = radius * width * np.column_stack([np.sin(bend), 1 - np.cos(bend)])
    back = 2 * arc[-1] - arc[::-1]
    far = 7 * width
    points = np.vstack([[-far, 0], arc, back[1:], back[-1] + np.array([far, 0])])
    points = points - (points.min(axis=0) + points.max(axis=0)) / 2 + CENTRE
    drawing, _ = traced([turned(points, turn)], width)
    assert degrees(drawing) == [1, 1]


@few
@given(st.floats(1.2, 3), st.floats(60, 110), st.floats(60, 110))
def test_edges_alone_tell_the_corners(side, first, second):
    width = 10.0
    truth = chain([first, -second], side, width)
    along = lengths(truth)
    points = at_lengths(truth, along, np.arange(0, along[-1], width / 8))
    middle = smoothed(points, 3.0, loop=False)
    found = chain_of(middle, outline(truth, width), width, 0.02)
    assert found is not None
    assert len(found) == 4
    assert np.abs(found[1:-1] - truth[1:-1]).max() < 0.08 * width


def test_a_chain_misses_its_own_edges_nowhere():
    corners = chain([80, -100], 2.0, 10.0)
    assert missed(corners, outline(corners, 10.0), 10.0).rms < 0.002
    assert turns(corners) == pytest.approx(np.radians([80, 100]))


def test_a_fit_is_never_worse_than_its_start():
    corners = chain([80, -100], 2.0, 10.0)
    edge = outline(corners, 10.0)
    start = corners + np.array([[0, 0], [2.5, -1], [-2, 2], [0, 0]])
    before, (_, after) = missed(start, edge, 10.0), fitted(start, edge, 10.0)
    assert after.rms < 0.1 * before.rms
