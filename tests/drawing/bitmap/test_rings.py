"""Small rings that hang on a stem."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import CENTRE, SHIFTS, TURNS, few, in_pixels, line, turned
from tests.drawing.generated import degrees


@few
@given(st.floats(0.75, 3.0), st.floats(5.0, 18.0), TURNS, SHIFTS)
def test_a_ring_meets_its_stem_at_its_own_edge(traced, radius, width, turn, shift):
    radius *= width
    angles = np.linspace(0, 2 * math.pi, 161)
    ring = np.array([CENTRE, 90]) + radius * np.column_stack([np.sin(angles), np.cos(angles)])
    foot = line((CENTRE, 90 + radius))
    stem = line((CENTRE, 90 + radius), (CENTRE, 360))
    bar = line((CENTRE - 80, 360), (CENTRE + 80, 360))
    drawing, _ = traced([turned(curve, turn, shift) for curve in (ring, stem, bar)], width)
    assert degrees(drawing) == [1, 1, 3, 3]
    places = np.array([in_pixels(drawing, junction.point) for junction in drawing.junctions])
    assert np.linalg.norm(places - turned(foot, turn, shift), axis=1).min() < 0.2 * width
    (loop,) = [segment for segment in drawing.segments if segment.start == segment.end]
    # The curve may leave the points by 0.04 widths all around.
    assert abs(loop.curve.length / drawing.pixel_frame.mm_per_px - 2 * math.pi * radius) < 0.3 * width


@few
@given(st.floats(8.0, 14.0), TURNS)
def test_a_loop_that_crosses_itself_stays_one(traced, width, turn):
    t = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 200)
    curl = CENTRE + 5 * width * np.column_stack([np.sin(2 * t), 2 * np.cos(t)])
    ends = [curl[:1] + line((0, 0)), curl[-1:]]
    tail = [
        end + line((0, 0), (side * 6 * width, -6 * width)) for end, side in zip(ends, (-1, 1), strict=True)
    ]
    drawing, _ = traced([turned(curve, turn) for curve in (curl, *tail)], width)
    assert degrees(drawing) == [1, 1, 4]
