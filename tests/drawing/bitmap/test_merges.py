"""Strokes that run into others at a small angle, or touch them: where the joint is, and how they leave it."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.drawing.bitmap.figures import CENTRE, SHIFTS, TURNS, few, in_pixels, turned
from tests.drawing.generated import Points, degrees
from wrapit.drawing.model import Drawing

WIDTHS = st.floats(5.0, 14.0)
BENDS = st.one_of(st.just(0.0), st.floats(-0.4, 0.4))  # of strokes, in parts of a circle's 1 / width


def arc(bend: float, length: float, direction: float) -> Points:
    """From the origin: a line, or an arc that turns by `bend` for each pixel."""
    heading = direction + bend * np.linspace(0, length, 200)
    steps = np.column_stack([np.cos(heading), np.sin(heading)]) * length / 199
    return np.vstack([np.zeros((1, 2)), np.cumsum((steps[:-1] + steps[1:]) / 2, axis=0)])


def strokes(bends: tuple[float, float], degrees_apart: float, width: float) -> list[Points]:
    """One stroke through the centre and one that leaves it there; only such as don't meet again."""
    first, second = (bend / width for bend in bends)
    reach = [min(8 * width, 2.0 / abs(bend) if bend else math.inf) for bend in (first, second)]
    through = np.vstack([arc(-first, reach[0], math.pi)[::-1], arc(first, reach[0], 0.0)[1:]])
    leaving = arc(second, reach[1], math.radians(degrees_apart))
    apart = shapely.distance(shapely.LineString(through), shapely.points(leaving))
    parted = apart > 1.6 * width
    assume(apart.max() > 2.5 * width and (np.diff(apart[: int(np.argmax(parted))]) > -0.01).all())
    assume(parted[int(np.argmax(parted)) :].all())
    return [CENTRE + through, CENTRE + leaving]


def joint_and_headings(drawing: Drawing) -> tuple[Points, Points]:
    """The place of the only junction of three, in pixels, and the directions (3, 2) that leave it."""
    assert degrees(drawing) == [1, 1, 1, 3]
    (junction,) = (j for j, ends in enumerate(drawing.half_edges()) if len(ends) == 3)
    curves = [(drawing.segments[end // 2].curve, end % 2) for end in drawing.half_edges()[junction]]
    away = [-curve.end_tangent if last else curve.start_tangent for curve, last in curves]
    return in_pixels(drawing, drawing.junctions[junction].point), np.array(away) * [1, -1]


@few
@given(st.floats(20, 60), BENDS, BENDS, WIDTHS, TURNS, SHIFTS)
def test_a_stroke_ends_on_the_centre_of_another(traced, angle, first, second, width, turn, shift):
    curves = strokes((first, second), angle, width)
    drawing, _ = traced([turned(curve, turn, shift) for curve in curves], width)
    place, _ = joint_and_headings(drawing)
    assert np.linalg.norm(place - CENTRE - shift) < 0.3 * width


@few
@given(st.floats(24, 32), BENDS, BENDS, WIDTHS, TURNS)
def test_its_direction_is_that_of_the_stroke(traced, angle, first, second, width, turn):
    curves = strokes((first, second), angle, width)
    drawing, _ = traced([turned(curve, turn) for curve in curves], width)
    _, away = joint_and_headings(drawing)
    drawn = turned(arc(0.0, 1.0, math.radians(angle))[-1:] + CENTRE, turn)[0] - CENTRE
    # Without the arc through the shared ink, 12 at the 90th percentile.
    assert math.degrees(np.arccos(np.clip(away @ drawn, -1, 1)).min()) < 5


@few
@given(st.floats(2.0, 4.5), st.booleans(), WIDTHS, TURNS, SHIFTS)
def test_an_arc_leaves_a_line_where_it_touches_it(traced, radius, downwards, width, turn, shift):
    curves = strokes((0.0, (1 if downwards else -1) / radius), 0.0, width)
    drawing, _ = traced([turned(curve, turn, shift) for curve in curves], width)
    place, _ = joint_and_headings(drawing)
    # 0.9 and more where the arm alone is carried on.
    assert np.linalg.norm(place - CENTRE - shift) < 0.5 * width
