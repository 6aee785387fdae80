"""How strokes leave a junction: their tangents there."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import ACROSS, SHIFTS, TURNS, WIDTHS, few, turned


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
