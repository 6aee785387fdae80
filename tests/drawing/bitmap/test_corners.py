"""Corners along a stroke: sharp ones become junctions, blunt ones and round bends don't."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import (
    CENTRE,
    SIZE_PX,
    TURNS,
    WIDTHS,
    few,
    in_pixels,
    junction_near,
    line,
    turned,
)
from tests.drawing.generated import degrees


@few
@given(st.floats(40, 120), WIDTHS, TURNS)
def test_a_sharp_corner_is_a_vertex(traced, inner_angle, width, turn):
    tip = (SIZE_PX - 80, CENTRE)
    back = math.radians(180 - inner_angle)
    bent = line((80, CENTRE), tip, (tip[0] + 160 * math.cos(back), tip[1] + 160 * math.sin(back)))
    if inner_angle > 115:
        return
    drawing, _ = traced([turned(bent, turn)], width)
    assert degrees(drawing) == [1, 1, 2]
    expected = turned(bent, turn)[1]
    assert np.linalg.norm(junction_near(drawing, 2) - expected) < 0.25 * width


@few
@given(st.floats(125, 170), WIDTHS, TURNS)
def test_a_blunt_corner_is_none(traced, inner_angle, width, turn):
    back = math.radians(180 - inner_angle)
    bent = line(
        (80, CENTRE), (CENTRE, CENTRE), (CENTRE + 150 * math.cos(back), CENTRE + 150 * math.sin(back))
    )
    drawing, _ = traced([turned(bent, turn)], width)
    assert degrees(drawing) == [1, 1]


@few
@given(st.floats(122, 145), WIDTHS, TURNS)
def test_a_blunt_corner_is_not_cut(traced, inner_angle, width, turn):
    """Curves run through its apex: the points that tell it are few."""
    back = math.radians(180 - inner_angle)
    bent = line(
        (80, CENTRE), (CENTRE, CENTRE), (CENTRE + 150 * math.cos(back), CENTRE + 150 * math.sin(back))
    )
    points = turned(bent, turn)
    drawing, _ = traced([points], width)
    assert degrees(drawing) == [1, 1]
    course = np.array([in_pixels(drawing, at) for at in drawing.segments[0].curve.sampled(0.1)])
    assert np.linalg.norm(course - points[1], axis=1).min() < 0.08 * width


def test_a_round_bend_is_no_corner(traced):
    t = np.linspace(0, math.pi / 2, 40)
    bend = np.vstack([[80, 80], np.column_stack([260 + 25 * np.sin(t), 105 - 25 * np.cos(t)]), [285, 330]])
    drawing, _ = traced([bend], 10.0)
    assert degrees(drawing) == [1, 1]
