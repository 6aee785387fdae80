"""How strokes leave a junction: their tangents there."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

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
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace


@few
@given(st.floats(30, 90), WIDTHS, TURNS, SHIFTS)
def test_tangents_at_a_crossing_are_those_of_the_strokes(traced, angle, width, turn, shift):
    curves = [turned(ACROSS, turn, shift), turned(turned(ACROSS, math.radians(angle)), turn, shift)]
    drawing, _ = traced(curves, width)
    (ends,) = (ends for ends in drawing.half_edges() if len(ends) == 4)
    for end in ends:
        curve = drawing.segments[end // 2].curve
        away = curve.start_tangent if end % 2 == 0 else -curve.end_tangent
        lines = [np.array([math.cos(-a), math.sin(-a)]) for a in (turn, turn + math.radians(angle))]
        off = min(math.asin(min(1.0, abs(away[0] * d[1] - away[1] * d[0]))) for d in lines)
        assert math.degrees(off) < 1.5  # 1.18 at 30 degrees and strokes of 4 px, the thinnest


@few
@given(st.floats(2.6, 6), st.floats(6, 20), st.integers(0, 3))
def test_an_arrow_s_tip_at_the_picture_s_side_is_where_its_strokes_meet(traced, arm, width, quarter):
    # The side of the picture is the edge of one arm's ink.
    right, top = SIZE_PX - 0.5 - width / 2, 3 * width
    tip = (right, top)
    arrow = [
        line((right - arm * width, top), tip),
        line((right, top + arm * width), tip),
        line((right - 250, top + 250), tip),
    ]
    about = quarter * math.pi / 2
    drawing, _ = traced([turned(each + 0.5, about) - 0.5 for each in arrow], width)
    found = junction_near(drawing, 3)
    expected = turned(np.array([tip]) + 0.5, about)[0] - 0.5
    assert np.linalg.norm(found - expected) < 0.12 * width


@few
@given(st.floats(1.2, 1.6), st.floats(60, 70), st.floats(9, 15), TURNS)
def test_an_end_that_bends_one_way_and_back_is_where_its_ink_ends(traced, radius, bend, width, turn):
    a = np.linspace(0, math.radians(bend), 60)
    arc = radius * width * np.column_stack([np.sin(a), 1 - np.cos(a)])
    back = 2 * arc[-1] - arc[::-1]
    wave = np.vstack([arc, back[1:], back[-1] + np.array([[9 * width, 0.0]])])
    wave += CENTRE - (wave.min(axis=0) + wave.max(axis=0)) / 2
    drawing, _ = traced([turned(wave, turn)], width)
    places = [in_pixels(drawing, junction.point) for junction in drawing.junctions]
    end = turned(wave, turn)[0]
    assert min(np.linalg.norm(place - end) for place in places) < 0.1 * width


@few
# (Of shorter ones some are lost, as they look like a corner's tip: see `tests.bench cusps`.)
@given(st.floats(1.05, 2), st.floats(60, 90), st.floats(6, 16), TURNS)
def test_the_short_end_of_a_bar_beyond_a_post_is_seen(traced, out, angle, width, turn):
    side, rad = 9 * width, math.radians(angle)
    joint = np.array([CENTRE, CENTRE])
    bar = line((CENTRE - out * width, CENTRE), (CENTRE + side, CENTRE))
    post = line((CENTRE, CENTRE), (CENTRE + side * math.cos(rad), CENTRE + side * math.sin(rad)))
    drawing, _ = traced([turned(bar, turn), turned(post, turn)], width)
    assert degrees(drawing) == [1, 1, 1, 3]
    assert np.linalg.norm(junction_near(drawing, 3) - joint) < 0.3 * width


@few
@given(st.floats(2.2, 3), st.floats(42, 55), st.floats(7, 16), TURNS)
def test_an_arrow_keeps_its_short_barbs(traced, barb, angle, width, turn):
    rad, tip = math.radians(angle), (CENTRE + 6 * width, CENTRE)
    back = [
        (tip[0] - barb * width * math.cos(rad), tip[1] + k * barb * width * math.sin(rad)) for k in (-1, 1)
    ]
    arrow = [line((CENTRE - 8 * width, CENTRE), tip), line(back[0], tip, back[1])]
    drawing, _ = traced([turned(stroke, turn) for stroke in arrow], width)
    assert degrees(drawing) == [1, 1, 1, 3]


@few
@given(st.floats(1, 2), st.floats(6, 16), TURNS)
def test_the_flat_end_of_a_broad_stroke_is_one_end(tmp_path, broader, width, turn):
    """Its corners are no barbs."""
    y, x = np.mgrid[:SIZE_PX, :SIZE_PX] - CENTRE
    along, across = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
    ink = (np.abs(along) < 9 * width) & (np.abs(across) < broader * width / 2)
    Image.fromarray((255 * ~ink).astype(np.uint8)).save(tmp_path / "flat.png")
    assert degrees(trace(tmp_path / "flat.png", TracingConfig(), 50.0)[0]) == [1, 1]
