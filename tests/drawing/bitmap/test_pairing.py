"""Which arms of a junction continue each other: crossings, forks, stars and curls get their degree."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import (
    ACROSS,
    CENTRE,
    SHIFTS,
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
from wrapit.drawing.bitmap.arms import Arm
from wrapit.drawing.bitmap.endings import place
from wrapit.drawing.bitmap.image import count_levels
from wrapit.drawing.bitmap.ink import Ink


@few
@given(st.floats(15, 90), WIDTHS, TURNS, SHIFTS)
def test_two_strokes_cross_in_one_junction(traced, angle, width, turn, shift):
    curves = [turned(ACROSS, turn, shift), turned(turned(ACROSS, math.radians(angle)), turn, shift)]
    drawing, _ = traced(curves, width)
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    at = junction_near(drawing, 4)
    assert np.linalg.norm(at - CENTRE - np.array(shift)) < 0.1 * width


@few
@given(st.floats(30, 90), WIDTHS, TURNS, SHIFTS)
def test_a_stroke_that_ends_on_another_makes_a_t(traced, angle, width, turn, shift):
    stem = turned(line((CENTRE, CENTRE), (SIZE_PX - 50, CENTRE)), math.radians(angle))
    drawing, _ = traced([turned(ACROSS, turn, shift), turned(stem, turn, shift)], width)
    assert degrees(drawing) == [1, 1, 1, 3]
    assert np.linalg.norm(junction_near(drawing, 3) - CENTRE - np.array(shift)) < 0.15 * width


@few
@given(st.floats(1.7, 2.4), st.floats(1.7, 2.4), st.floats(7, 14), TURNS)
def test_two_posts_between_two_bars_are_four_joints(traced, high, apart, width, turn):
    """Strokes could cross smoothly along each post; but each is as broad as one stroke."""
    half, tall, reach = apart * width / 2, high * width, 5 * width
    bars = [line((CENTRE - reach, y), (CENTRE + reach, y)) for y in (CENTRE, CENTRE + tall)]
    posts = [line((CENTRE + x, CENTRE), (CENTRE + x, CENTRE + tall)) for x in (-half, half)]
    drawing, _ = traced([turned(stroke, turn) for stroke in (*bars, *posts)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 3, 3, 3, 3]
    joints = turned(np.concatenate(posts), turn)
    found = np.array([in_pixels(drawing, junction.point) for junction in drawing.junctions])
    assert np.linalg.norm(found[:, None] - joints, axis=2).min(axis=0).max() < 0.3 * width


@given(st.floats(0.3, 3), st.floats(-1e-3, 1e-3), st.floats(5, 20))
def test_parallel_strokes_meet_near_their_skeleton_s_place(apart, askew, width):
    """Where four arms run side by side, as no drawing of one pen has them, no point is where they meet."""
    along = np.arange(width, 5 * width, width / 8)
    rise = askew * along
    arms = [
        Arm(2 * k + (sign < 0), 0, 0, np.column_stack([sign * along, y + sign * rise * (1 - 2 * k)]), width)
        for k, y in enumerate((0.0, apart * width))
        for sign in (1, -1)
    ]
    around = np.array([0.0, apart * width / 2])
    blank = np.zeros((4, 4), dtype=np.uint8)
    ink = Ink(blank == 0, blank, 255.0, 0.0, False, count_levels(blank))
    point, _ = place(arms, around, [(0, 1), (2, 3)], ink)
    assert np.linalg.norm(point - around) < 4 * width


@few
@given(st.floats(90, 200), WIDTHS, TURNS)
def test_a_stroke_that_leaves_tangentially_is_one_junction(traced, radius, width, turn):
    sweep = np.linspace(0, min(1.4, 150 / radius), 60)
    arc = CENTRE + radius * np.column_stack([np.sin(sweep), 1 - np.cos(sweep)])
    drawing, _ = traced([turned(ACROSS, turn), turned(arc, turn)], width)
    assert degrees(drawing) == [1, 1, 1, 3]


@few
@given(st.integers(3, 7), WIDTHS, TURNS, SHIFTS)
def test_a_star_is_one_junction(traced, rays, width, turn, shift):
    ray = line((CENTRE, CENTRE), (SIZE_PX - 50, CENTRE))
    drawing, _ = traced(
        [turned(turned(ray, k * 2 * math.pi / rays), turn, shift) for k in range(rays)], width
    )
    assert degrees(drawing) == [1] * rays + [rays]


@few
@given(WIDTHS, TURNS, SHIFTS)
def test_a_curl_crosses_itself_once(traced, width, turn, shift):
    t = np.linspace(-1.35, 1.35, 200)
    curl = CENTRE + np.column_stack([120 * (t**3 - t), 120 * t**2 - 80])
    drawing, _ = traced([turned(curl, turn, shift)], width)
    assert degrees(drawing) == [1, 1, 4]
    assert any(segment.start == segment.end for segment in drawing.segments)
