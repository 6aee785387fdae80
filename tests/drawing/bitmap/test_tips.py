"""Acute tips of open and closed shapes, joints side by side, and how segments start."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import CENTRE, TURNS, few, in_pixels, line, turned
from tests.drawing.generated import degrees

ANGLES = st.floats(20, 60)
CLOSED = st.floats(28, 60)
THICK = st.floats(9.0, 30.0)
PENS = st.floats(9.0, 12.0)


def tip(angle: float) -> list[tuple[float, float]]:
    """Two ends and the apex between them."""
    half = 150 * math.tan(math.radians(angle / 2))
    return [(CENTRE - half, CENTRE + 150), (CENTRE, CENTRE - 150), (CENTRE + half, CENTRE + 150)]


def misses(drawing, points):
    """How far the farthest of the points (n, 2) in pixels is from a junction."""
    places = np.array([in_pixels(drawing, junction.point) for junction in drawing.junctions])
    return np.linalg.norm(places[:, None] - points[None], axis=2).min(axis=0).max()


@few
@given(ANGLES, THICK, TURNS)
def test_an_open_tip_is_one_corner_at_its_apex(traced, angle, width, turn):
    points = turned(line(*tip(angle)), turn)
    drawing, _ = traced([points], width)
    assert degrees(drawing) == [1, 1, 2]
    assert misses(drawing, points) < 0.5 * width


@few
@given(CLOSED, THICK, TURNS)
def test_a_closed_tip_is_one_corner_at_its_apex(traced, angle, width, turn):
    points = turned(line(*tip(angle), tip(angle)[0]), turn)
    drawing, _ = traced([points], width)
    assert degrees(drawing) == [2, 2, 2]
    assert misses(drawing, points) < 0.5 * width


@few
@given(PENS, TURNS)
def test_a_loop_keeps_its_only_corner(traced, width, turn):
    t = np.linspace(-0.75 * math.pi, 0.75 * math.pi, 200)
    ring = CENTRE + 80 * np.column_stack([np.sin(t), np.cos(t)])
    apex = np.array([[CENTRE, CENTRE - 80 * math.sqrt(2)]])
    drawing, _ = traced([turned(np.vstack([apex, ring, apex]), turn)], width)
    assert degrees(drawing) == [2]
    assert misses(drawing, turned(apex, turn)) < 0.5 * width


@few
@given(st.floats(1.7, 3.5), PENS, TURNS)
def test_joints_with_white_between_them_stay_two(traced, apart, width, turn):
    half = apart * width / 2
    sides = [line((CENTRE + x, 60), (CENTRE + x, 360)) for x in (-half, half)]
    joints = line((CENTRE - half, CENTRE), (CENTRE + half, CENTRE))
    drawing, _ = traced([turned(curve, turn) for curve in (*sides, joints)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 3, 3]
    assert misses(drawing, turned(joints, turn)) < 0.4 * width


@few
@given(st.floats(30, 90), PENS, TURNS)
def test_no_segment_starts_or_ends_by_doubling_back(traced, angle, width, turn):
    twigs = [
        line((CENTRE, CENTRE), (CENTRE + 120 * math.sin(a), CENTRE - 120 * math.cos(a)))
        for a in (0.0, math.radians(angle), -math.radians(1.3 * angle), math.pi)
    ]
    drawing, _ = traced([turned(twig, turn) for twig in twigs], width)
    for segment in drawing.segments:
        points = segment.curve.sampled(segment.curve.length / 400)
        for tenth in (points[:41], points[-41:]):
            steps = np.diff(tenth, axis=0)
            steps = steps[np.linalg.norm(steps, axis=1) > 1e-9]
            headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
            assert np.degrees(np.ptp(headings)) < 90
