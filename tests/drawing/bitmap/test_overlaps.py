"""Strokes whose ink is one over a stretch: acute crossings, lenses, shared and touching stretches."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from scipy.ndimage import gaussian_filter

from tests.drawing.bitmap.figures import ACROSS, CENTRE, SIZE_PX, TURNS, arc, few, junction_near, turned
from tests.drawing.generated import degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace

# How far (degrees) four strokes turn off the one between two joints, at either end of it.
TWO_JOINTS = [
    (30, 30, 30, 30),
    (38, 38, 38, 38),
    (45, 45, 45, 45),
    (35, 50, 50, 35),
    (50, 35, 50, 35),
    (60, 60, 60, 60),
]


@few
@given(st.floats(10, 15), st.floats(6, 10), TURNS)
def test_strokes_that_cross_at_a_very_acute_angle_are_one_junction(traced, angle, width, turn):
    curves = [turned(ACROSS, turn), turned(turned(ACROSS, math.radians(angle)), turn)]
    drawing, _ = traced(curves, width)
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    assert np.linalg.norm(junction_near(drawing, 4) - CENTRE) < 0.3 * width


@few
@given(
    st.floats(8, 16),
    st.floats(-0.2, 0.05),
    st.floats(0, 0.5),
    st.sampled_from([(1, 1.3), (1, 1.8), (1, 2.3), (-1, 1.1), (-1, 1.4), (-1, 1.8)]),
    TURNS,
)
def test_strokes_that_end_near_each_other_on_a_bent_bar_are_two_joints(traced, width, bend, lean, ends, turn):
    """As a snail's horns on its head: on one side of it, leaning apart, or on either side."""
    side, apart = ends
    x = np.linspace(-9, 9, 200)
    bar = np.column_stack([x, bend * x * x])
    slope = bend * apart
    posts = []
    for along, up, angle in ((-1, 1, -lean), (1, side, lean * side)):
        foot = np.array([along * apart / 2, bend * apart**2 / 4])
        normal = up * np.array([-slope * along, 1.0]) / math.hypot(slope, 1)
        c, s = math.cos(angle), math.sin(angle)
        posts.append(np.array([foot, foot + 7 * (np.array([[c, s], [-s, c]]) @ normal)]))
    drawing, _ = traced([turned(CENTRE + width * curve, turn) for curve in (bar, *posts)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 3, 3]


@few
@given(st.floats(8, 16), st.floats(45, 65), TURNS)
def test_two_strokes_that_meet_on_a_bar_meet_in_one_junction(traced, width, slant_deg, turn):
    """As an aerial's: their ink is one before they reach the bar, and no stroke goes straight on."""
    up = np.array([[math.cos(a), math.sin(a)] for a in np.radians([slant_deg, 180 - slant_deg])])
    legs = [np.array([[0.0, 0.0], 8 * one]) for one in up]
    bar = np.array([[-9.0, 0.0], [9.0, 0.0]])
    drawing, _ = traced([turned(CENTRE + width * curve, turn) for curve in (bar, *legs)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    assert np.linalg.norm(junction_near(drawing, 4) - CENTRE) < 0.3 * width


@few
@given(st.floats(6, 9), TURNS)
def test_strokes_whose_ink_hides_a_lens_cross_twice(traced, width, turn):
    upper = arc(260, 0.5, -0.35 * width)
    lower = 2 * CENTRE - upper
    lower = lower * [-1, 1] + [2 * CENTRE, 0]
    drawing, _ = traced([turned(upper, turn), turned(lower, turn)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 4, 4]


@few
@given(st.floats(10, 18), st.floats(8, 11), TURNS, st.sampled_from(["clean", "blurred and noisy"]))
def test_strokes_that_wind_around_each_other_cross_as_often_as_drawn(tmp_path, angle, width, turn, how):
    # Three crossings, between them hardly any paper; behind the last one both go straight on.
    slope, half = math.tan(math.radians(angle)), 80.0
    s = np.linspace(-180, 180, 400)
    wave = slope * half / math.pi * np.sin(math.pi * s / half)
    beyond = -slope * np.sign(s) * (np.abs(s) - half)
    winding = CENTRE + np.column_stack([s, np.where(np.abs(s) < half, wave, beyond)])
    grey = render([turned(ACROSS, turn), turned(winding, turn)], width, (SIZE_PX, SIZE_PX))
    if how != "clean":
        noise = np.random.default_rng(5).normal(scale=12, size=grey.shape)
        grey = np.clip(gaussian_filter(grey.astype(np.float64), 1.2) + noise, 0, 255).astype(np.uint8)
    Image.fromarray(grey).save(tmp_path / "drawing.png")
    drawing, _ = trace(tmp_path / "drawing.png", TracingConfig(), 50.0)
    assert degrees(drawing) == [1, 1, 1, 1, 4, 4, 4]


@few
@given(st.floats(6, 10), st.floats(4, 14), TURNS)
def test_a_stretch_that_two_strokes_share_is_one_segment(traced, width, shared, turn):
    half = shared * width / 2
    t = np.linspace(0, 1, 40)
    away = np.column_stack([half + (140 - half) * t, 70 * t * t])
    curves = [CENTRE + np.vstack([(away * [-1, up])[::-1], away * [1, up]]) for up in (-1, 1)]
    drawing, _ = traced([turned(curve, turn) for curve in curves], width)
    assert degrees(drawing) == [1, 1, 1, 1, 3, 3]


@pytest.mark.parametrize("apart", [1.2, 1.4, 1.6, 1.8, 2.0])
@pytest.mark.parametrize("turns", TWO_JOINTS)
def test_two_joints_a_few_widths_apart_are_no_crossing(traced, apart, turns):
    width = 18.0
    half, far = apart * width / 2, 7 * width
    arms = [
        CENTRE + np.array([[side * half, 0], [side * (half + far * math.cos(a)), up * far * math.sin(a)]])
        for a, (side, up) in zip(np.radians(turns), itertools.product((-1, 1), (-1, 1)), strict=True)
    ]
    stretch = CENTRE + np.array([[-half, 0], [half, 0]])
    drawing, _ = traced([turned(curve, 0.4) for curve in (stretch, *arms)], width)
    assert degrees(drawing) == [1, 1, 1, 1, 3, 3]


@few
@given(st.floats(6, 10), TURNS)
def test_strokes_that_only_touch_stay_apart_and_are_named(traced, width, turn):
    upper, lower = arc(150, 0.9, 0.42 * width), arc(110, 0.9, 0.42 * width)
    lower = lower * [1, -1] + [0, 2 * CENTRE]
    drawing, findings = traced([turned(upper, turn), turned(lower, turn)], width)
    assert degrees(drawing) == [1, 1]
    assert {"touching", "left-out"} <= {finding.code for finding in findings}
