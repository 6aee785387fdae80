"""Whole bitmaps traced: loops, smooth segments, and the same bytes each time."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import ACROSS, CENTRE, WIDTHS, few, in_pixels, turned
from tests.drawing.generated import degrees
from wrapit.drawing.json_file import drawing_json


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


def test_segments_are_smooth_inside(traced):
    t = np.linspace(0, 1, 200)
    wave = np.column_stack([60 + 300 * t, CENTRE + 80 * np.sin(9 * t)])
    drawing, _ = traced([wave], 9.0)
    points = drawing.segments[0].curve.points
    assert len(points) > 1
    for before, after in itertools.pairwise(points):
        a, b = before[3] - before[2], after[1] - after[0]
        assert abs(a[0] * b[1] - a[1] * b[0]) < 1e-6 * np.linalg.norm(a) * np.linalg.norm(b)


def test_the_same_picture_gives_the_same_bytes(traced):
    curves = [ACROSS, turned(ACROSS, 0.8), turned(ACROSS, 2.0)]
    assert drawing_json(traced(curves, 9.0)[0]) == drawing_json(traced(curves, 9.0)[0])
