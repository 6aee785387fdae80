"""Generated drawings whose graph is known exactly, traced from their ink."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image
from scipy.ndimage import gaussian_filter

from tests.drawing.generated import Points, render
from wrapit.config import TracingConfig
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import Finding

SIZE_PX = 420
CENTRE = SIZE_PX / 2
WIDTHS = st.floats(4.0, 15.0)
TURNS = st.floats(0, 2 * math.pi)
SHIFTS = st.tuples(st.floats(-6, 6), st.floats(-6, 6))
few = settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@pytest.fixture
def traced(tmp_path: Path) -> Callable[..., tuple[Drawing, tuple[Finding, ...]]]:
    def run(
        curves: list[Points], width_px: float, tracing: TracingConfig | None = None
    ) -> tuple[Drawing, tuple[Finding, ...]]:
        path = tmp_path / "drawing.png"
        Image.fromarray(render(curves, width_px, (SIZE_PX, SIZE_PX))).save(path)
        return trace(path, tracing or TracingConfig(), 50.0)

    return run


def line(*points: tuple[float, float]) -> Points:
    return np.array(points, dtype=np.float64)


def turned(points: Points, angle: float, shift: tuple[float, float] = (0, 0)) -> Points:
    c, s = math.cos(angle), math.sin(angle)
    return (points - CENTRE) @ np.array([[c, s], [-s, c]]) + CENTRE + shift


def degrees(drawing: Drawing) -> list[int]:
    return sorted(len(ends) for ends in drawing.half_edges())


def in_pixels(drawing: Drawing, point: Points) -> Points:
    frame = drawing.pixel_frame
    assert frame is not None
    return (point - np.array(frame.origin_mm)) / frame.mm_per_px * [1, -1]


def junction_near(drawing: Drawing, degree: int) -> Points:
    """The place, in pixels, of the only junction with this degree."""
    found = [j for j, ends in enumerate(drawing.half_edges()) if len(ends) == degree]
    assert len(found) == 1
    return in_pixels(drawing, drawing.junctions[found[0]].point)


ACROSS = line((50, CENTRE), (SIZE_PX - 50, CENTRE))


@few
@given(st.floats(15, 90), WIDTHS, TURNS, SHIFTS)
def test_two_strokes_cross_in_one_junction(traced, angle, width, turn, shift):
    curves = [turned(ACROSS, turn, shift), turned(turned(ACROSS, math.radians(angle)), turn, shift)]
    drawing, _ = traced(curves, width)
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    at = junction_near(drawing, 4)
    assert np.linalg.norm(at - CENTRE - np.array(shift)) < 0.1 * width


def arc(radius: float, half_angle: float, offset: float) -> Points:
    """An arc that bulges upwards around the middle of its chord, `offset` below the centre at its top."""
    a = np.linspace(-half_angle, half_angle, 120)
    return CENTRE + np.column_stack([radius * np.sin(a), offset + radius * (1 - np.cos(a))])


@few
@given(st.floats(10, 15), st.floats(6, 10), TURNS)
def test_strokes_that_cross_at_a_very_acute_angle_are_one_junction(traced, angle, width, turn):
    curves = [turned(ACROSS, turn), turned(turned(ACROSS, math.radians(angle)), turn)]
    drawing, _ = traced(curves, width)
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


@few
@given(st.floats(6, 10), TURNS)
def test_strokes_that_only_touch_stay_apart_and_are_named(traced, width, turn):
    upper, lower = arc(150, 0.9, 0.42 * width), arc(110, 0.9, 0.42 * width)
    lower = lower * [1, -1] + [0, 2 * CENTRE]
    drawing, findings = traced([turned(upper, turn), turned(lower, turn)], width)
    assert degrees(drawing) == [1, 1]
    assert {"touching", "left-out"} <= {finding.code for finding in findings}


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
        assert math.degrees(off) < 1.0


@few
@given(st.floats(30, 90), WIDTHS, TURNS, SHIFTS)
def test_a_stroke_that_ends_on_another_makes_a_t(traced, angle, width, turn, shift):
    stem = turned(line((CENTRE, CENTRE), (SIZE_PX - 50, CENTRE)), math.radians(angle))
    drawing, _ = traced([turned(ACROSS, turn, shift), turned(stem, turn, shift)], width)
    assert degrees(drawing) == [1, 1, 1, 3]
    assert np.linalg.norm(junction_near(drawing, 3) - CENTRE - np.array(shift)) < 0.15 * width


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


@few
@given(st.floats(60, 150), st.floats(60, 150), WIDTHS)
def test_a_closed_loop_gets_one_vertex_and_closes_smoothly(traced, a, b, width):
    t = np.linspace(0, 2 * math.pi, 200)
    ring = CENTRE + np.column_stack([a * np.cos(t), b * np.sin(t)])
    drawing, _ = traced([ring], width)
    assert degrees(drawing) == [2]
    curve = drawing.segments[0].curve
    assert curve.start_tangent @ curve.end_tangent > math.cos(math.radians(1))
    size = in_pixels(drawing, np.array(drawing.bounds_mm[1])) - in_pixels(drawing, drawing.bounds_mm[0])
    assert np.abs(size) == pytest.approx([2 * a, 2 * b], abs=0.08 * width)


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


def test_a_round_bend_is_no_corner(traced):
    t = np.linspace(0, math.pi / 2, 40)
    bend = np.vstack([[80, 80], np.column_stack([260 + 25 * np.sin(t), 105 - 25 * np.cos(t)]), [285, 330]])
    drawing, _ = traced([bend], 10.0)
    assert degrees(drawing) == [1, 1]


def test_segments_are_smooth_inside(traced):
    t = np.linspace(0, 1, 200)
    wave = np.column_stack([60 + 300 * t, CENTRE + 80 * np.sin(9 * t)])
    drawing, _ = traced([wave], 9.0)
    points = drawing.segments[0].curve.points
    assert len(points) > 1
    for before, after in itertools.pairwise(points):
        a, b = before[3] - before[2], after[1] - after[0]
        assert abs(a[0] * b[1] - a[1] * b[0]) < 1e-6 * np.linalg.norm(a) * np.linalg.norm(b)


def test_ends_that_nearly_touch_are_joined_and_listed(traced):
    halves = [line((60, 200), (200, 200)), line((216, 200), (360, 200))]
    drawing, findings = traced(halves, 10.0)
    assert degrees(drawing) == [1, 1]
    assert [removal.what for removal in drawing.removed] == ["gap"]
    assert any(finding.code == "gap-closed" and " px, (" in finding.where for finding in findings)


def test_an_end_that_nearly_touches_a_stroke_is_joined_to_it(traced):
    drawing, findings = traced([ACROSS, line((CENTRE, CENTRE + 13), (CENTRE, 360))], 10.0)
    assert degrees(drawing) == [1, 1, 1, 3]
    assert "gap-closed" in {finding.code for finding in findings}


def test_a_wide_gap_stays_open_and_the_smaller_piece_is_named(traced):
    drawing, findings = traced([line((60, 200), (200, 200)), line((260, 200), (360, 200))], 10.0)
    assert degrees(drawing) == [1, 1]
    (finding,) = (finding for finding in findings if finding.code == "left-out")
    assert "at (310, 200) px" in finding.where
    assert [removal.what for removal in drawing.removed] == ["piece"]


def test_near_pieces_are_joined_on_request(traced):
    pieces = [line((60, 200), (200, 200)), line((240, 120), (240, 280))]
    drawing, findings = traced(pieces, 10.0, TracingConfig(components="join"))
    # The link is a segment of its own: the end that it starts from has two.
    assert degrees(drawing) == [1, 1, 1, 2, 3]
    assert "joined" in {finding.code for finding in findings}
    assert any(removal.what == "link" for removal in drawing.removed)


def test_branches_too_short_to_bend_are_dropped(traced):
    curves = [ACROSS, line((CENTRE, CENTRE), (CENTRE, CENTRE + 30))]
    assert degrees(traced(curves, 8.0)[0]) == [1, 1, 1, 3]
    dropped, _ = traced(curves, 8.0, TracingConfig(shortest_segment="6 mm"))
    assert degrees(dropped) == [1, 1]
    assert "short segment" in {removal.what for removal in dropped.removed}


def test_size_is_the_longest_side_and_the_lower_left_is_zero(traced):
    drawing, _ = traced([line((60, 100), (360, 100), (360, 220))], 10.0)
    low, high = drawing.bounds_mm
    assert low == pytest.approx([0, 0], abs=0.01)
    assert high == pytest.approx([50, 20], abs=0.15)
    assert drawing.stroke_width_mm == pytest.approx(10 * 50 / 300, rel=0.08)


def test_junctions_are_numbered_from_top_to_bottom(traced):
    drawing, _ = traced([ACROSS, turned(ACROSS, 1.1)], 10.0)
    heights = [junction.point[1] for junction in drawing.junctions]
    assert all(upper > lower - 2e-3 for upper, lower in itertools.pairwise(heights))
    assert all(segment.start <= segment.end for segment in drawing.segments)


def test_the_same_picture_gives_the_same_bytes(traced):
    curves = [ACROSS, turned(ACROSS, 0.8), turned(ACROSS, 2.0)]
    assert drawing_json(traced(curves, 9.0)[0]) == drawing_json(traced(curves, 9.0)[0])
