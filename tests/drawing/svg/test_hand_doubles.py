"""Lines drawn as two wobbly strokes become one; what is meant twice stays two."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.drawing.svg.ink import sampled
from tests.drawing.svg.sketches import Sketch
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace

SOME = settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
HANDS = st.builds(
    Sketch, seed=st.integers(0, 2**32 - 1), roughness=st.floats(0.6, 1.5), exact_ends=st.booleans()
)
MM = 25.4 / 96


def traced(folder, paths, width=2.0, comment=""):
    body = "".join(f'<path d="{d}" fill="none" stroke="#1e1e1e" stroke-width="{width}"/>' for d in paths)
    path = folder / "sketch.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="300" height="300">{comment}{body}</svg>')
    return trace(path, TracingConfig(components="join"), None)


def whole_mm(drawing):
    """The length of all lines, with those apart and without links."""
    told = {what: sum(r.length_mm for r in drawing.removed if r.what == what) for what in ("piece", "link")}
    return drawing.length_mm + told["piece"] - told["link"]


def counted(findings):
    return [f.message.split()[0] for f in findings if f.code == "drawn-twice-by-hand"]


@SOME
# With strokes of one px, one hand in some hundreds strays so far that a line stays two.
@given(hand=HANDS, width=st.sampled_from([2.0, 4.0]))
def test_a_sketched_rectangle_with_a_diagonal_is_five_lines(tmp_path, hand, width):
    corners = [(40.0, 50.0), (240.0, 50.0), (240.0, 190.0), (40.0, 190.0), (40.0, 50.0)]
    paths = [hand.polyline(corners), hand.line(corners[0], corners[2])]
    drawing, findings = traced(tmp_path, paths, width, "<!-- svg-source:excalidraw -->")
    assert counted(findings) == ["5"]
    assert sorted(map(len, drawing.half_edges())) == [2, 2, 3, 3]
    assert drawing.length_mm == pytest.approx(MM * (680 + math.hypot(200, 140)), rel=0.02)


@SOME
@given(hand=HANDS, rx=st.floats(40, 120), ry=st.floats(40, 120))
def test_a_sketched_ellipse_is_one_smooth_loop(tmp_path, hand, rx, ry):
    drawing, findings = traced(tmp_path, [hand.ellipse(150, 150, rx, ry)])
    assert counted(findings) == ["1"]
    assert [len(ends) for ends in drawing.half_edges()] == [2]
    points = np.concatenate([sampled(segment.curve.points, 0.5) for segment in drawing.segments])
    low, high = drawing.bounds_mm
    middle = (np.array(low) + np.array(high)) / 2
    round_ = np.hypot(*((points - middle) / (MM * np.array([rx, ry]))).T)
    # Its radii are up to a twentieth off for this hand, and each point by two or three px.
    assert abs(round_ - 1).max() < 0.05 * 1.5 + 4.5 / min(rx, ry)


@SOME
@given(hand=HANDS, turn=st.floats(0, math.tau))
def test_a_sketched_arrow_is_three_lines(tmp_path, hand, turn):
    def at(x, y):
        c, s = math.cos(turn), math.sin(turn)
        return (150 + c * x - s * y, 150 + s * x + c * y)

    tip = at(100, 0)
    lines = [(at(-100, 0), tip), (at(70, 20), tip), (at(70, -20), tip)]
    comment = "<!-- svg-source:excalidraw -->"
    drawing, findings = traced(tmp_path, [hand.line(*line) for line in lines], 2.0, comment)
    assert counted(findings) == ["3"]
    assert sorted(map(len, drawing.half_edges())) == [1, 1, 1, 3]


@pytest.mark.parametrize("apart", [2.4, 3.0, 5.0])
@pytest.mark.parametrize("one_path", [True, False])
def test_parallel_strokes_farther_apart_than_a_width_stay_two(tmp_path, apart, one_path):
    paths = [f"M20 100H280M20 {100 + apart}H280", "M20 30C80 200 200 -80 280 40"]
    paths += [f"M20 {200 + 10 * k}C80 {190 + 10 * k} 200 230 280 {200 + 10 * k}" for k in range(3)]
    if not one_path:
        paths = [f"M{d}" for path in paths for d in path.split("M")[1:]]
    drawing, findings = traced(tmp_path, paths)
    assert not counted(findings)
    assert whole_mm(drawing) > MM * (5 * 260)


@pytest.mark.parametrize("bulge", [3.0, 8.0, 40.0])
@pytest.mark.parametrize("turned", [True, False])
def test_the_sides_of_leaves_stay_two(tmp_path, bulge, turned):
    def leaf(y):
        back = f"M280 {y}Q150 {y - 2 * bulge} 20 {y}" if turned else f"M20 {y}Q150 {y - 2 * bulge} 280 {y}"
        return f"M20 {y}Q150 {y + 2 * bulge} 280 {y}{back}"

    drawing, findings = traced(tmp_path, [leaf(60), leaf(150), leaf(240)])
    assert not counted(findings)
    # Where the sides run together, at both ends, one of them is taken.
    assert whole_mm(drawing) > MM * 5.5 * 260


def test_two_strokes_within_a_width_are_their_mean_wherever_they_are(tmp_path):
    paths = ["M20 100C100 60 200 60 280 100", "M20 20V280", "M280 101.5C200 61 100 61.5 20.5 101"]
    drawing, findings = traced(tmp_path, paths)
    assert counted(findings) == ["1"]
    assert sorted(map(len, drawing.half_edges())) == [1, 1, 1, 3]
