"""The bench's judge of fit drawings, on drawings whose answers are known."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.fit_judge import fitness, joint_angles, price
from wrapit.drawing.model import Drawing, Junction, Segment
from wrapit.geometry import BezierChain, joined, straight
from wrapit.geometry.bezier import split

SQUARE = [(0, 0), (20, 0), (20, 20), (0, 20)]
# Handles of a quarter circle as a cubic; its radius is within 3e-4 of right.
QUARTER = 4 / 3 * (math.sqrt(2) - 1)


def drawn(*curves: BezierChain) -> Drawing:
    """Curves as a drawing: those that end in one place share a junction."""
    places: dict[tuple[float, ...], int] = {}
    segments = []
    for number, curve in enumerate(curves):
        start, end = (places.setdefault(tuple(p), len(places)) for p in (curve.start, curve.end))
        segments.append(Segment(number, start, end, curve))
    return Drawing(tuple(Junction(n, np.array(p)) for p, n in places.items()), tuple(segments))


def line(*points: tuple[float, float]) -> BezierChain:
    return joined(straight(a, b) for a, b in itertools.pairwise(points))


def quarter(start: tuple[float, float], corner: tuple[float, float], end: tuple[float, float]) -> BezierChain:
    a, c, b = map(np.array, (start, corner, end))
    return BezierChain(np.stack([a, a + QUARTER * (c - a), b + QUARTER * (c - b), b])[None])


def circle(radius: float) -> BezierChain:
    r, around = radius, [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    at = [(r * x, r * y) for x, y in around]
    return joined(quarter(*at[n : n + 3]) for n in (0, 2, 4, 6))


def square(*more: BezierChain) -> Drawing:
    """Four sides, cut in the middle of those above and below, and what else is drawn."""
    return drawn(line((10, 0), (20, 0), (20, 20), (10, 20)), line((10, 20), (0, 20), (0, 0), (10, 0)), *more)


MIDDLE = line((10, 0), (10, 20))


@given(sides=st.integers(3, 40), radius=st.floats(5, 30), turned=st.floats(0, 6))
@settings(max_examples=25, deadline=None)
def test_a_regular_polygon_has_its_corners_and_its_inner_circle(sides, radius, turned):
    at = turned + 2 * np.pi * np.arange(sides) / sides
    corners = [(radius * math.cos(a), radius * math.sin(a)) for a in at]
    seen = fitness(drawn(line(*corners, corners[0])), 1.0, 1.0)
    assert (seen.spans, seen.corners, seen.pieces, seen.crossings) == (0, sides, 1, 0)
    assert seen.faces_d == pytest.approx([2 * radius * math.cos(math.pi / sides)], abs=0.03)
    assert seen.lengths_mm == pytest.approx([2 * sides * radius * math.sin(math.pi / sides)])
    assert not seen.stubs_mm


@pytest.mark.parametrize(("allowed", "spans"), [(1.9, 0), (2.0, 0), (2.1, 1)])
def test_a_rounded_corner_is_a_bend_of_its_radius(allowed, spans):
    rounded = joined((line((0, 2), (0, 20), (20, 20), (20, 0), (2, 0)), quarter((2, 0), (0, 0), (0, 2))))
    seen = fitness(drawn(rounded), 1.0, allowed)
    assert (seen.corners, seen.spans) == (3, spans)
    assert seen.tight == 3 + spans


def test_rounding_a_corner_costs_the_outline_near_it():
    sharp = drawn(line((0, 0), (0, 20), (20, 20), (20, 0), (0, 0)))
    rounded = drawn(
        joined((line((0, 2), (0, 20), (20, 20), (20, 0), (2, 0)), quarter((2, 0), (0, 0), (0, 2))))
    )
    paid = price(sharp, rounded, 1.0)
    # A place x from the corner lies √((2 - x)² + 4) - 2 from the arc: over half a wire where x < 0.5.
    assert paid.outline_kept == pytest.approx(1 - 1.0 / 80, abs=1e-3)
    assert paid.left_out == 0.0
    assert paid.furthest_mm == pytest.approx(2 * math.sqrt(2) - 2, abs=0.02)


@pytest.mark.parametrize("radius", [0.5, 1.0, 3.0])
def test_a_circle_bends_by_its_radius_all_the_way(radius):
    assert fitness(drawn(circle(radius)), 1.0, 0.99 * radius).tight == 0
    tighter = fitness(drawn(circle(radius)), 1.0, 1.03 * radius)
    assert (tighter.spans, tighter.corners) == (1, 0)


def test_a_handle_of_no_length_is_no_tight_bend_where_nothing_visible_turns():
    slight = BezierChain(np.array([[(0, 0), (0, 0), (15, 1), (20, 3)]], float))
    sharp = BezierChain(np.array([[(0, 0), (20, 0), (20, 0), (20, 0.5)]], float))
    assert fitness(drawn(slight), 1.0, 1.0).tight == 0
    assert fitness(drawn(sharp), 1.0, 1.0).spans == 1


def test_the_room_in_a_lens_is_its_height():
    up, down = ([(0, 0), (3, s * 2 / 3), (7, s * 2 / 3), (10, 0)] for s in (1, -1))
    lens = drawn(*(BezierChain(np.array(side, float)[None]) for side in (up, down)))
    seen = fitness(lens, 0.5, 0.2)
    assert seen.faces_d == pytest.approx([2.0], abs=0.05)
    assert (seen.narrow(1.9), seen.narrow(2.1), seen.corners) == (0, 1, 2)


def test_a_dropped_line_is_left_out_but_for_its_ends():
    paid = price(square(MIDDLE), square(), 1.0)
    assert paid.left_out == pytest.approx(18 / 100, abs=2e-3)
    assert paid.outline_kept == 1.0
    # Two ends of 1 mm are near enough to count as kept, half a mm off on average; back nothing is off.
    assert paid.moved_mm == pytest.approx(0.5 * 2 / 82 / 2, abs=1e-3)


def test_a_dropped_side_is_missed_in_the_outline():
    open_ = drawn(line((0, 0), (0, 20), (20, 20), (20, 0)))
    closed = drawn(line((0, 0), (0, 20), (20, 20), (20, 0)), line((20, 0), (0, 0)))
    paid = price(closed, open_, 1.0)
    assert paid.outline_kept == pytest.approx(61 / 80, abs=2e-3)
    assert paid.left_out == pytest.approx(18 / 80, abs=2e-3)


def test_a_line_outside_of_all_faces_is_outline_and_one_within_is_not():
    whisker, inner = line((20, 10), (30, 10)), line((0, 10), (8, 10))
    whole = drawn(line((20, 10), (20, 20), (0, 20), (0, 10)), line((0, 10), (0, 0), (20, 0), (20, 10)))
    both = drawn(*(s.curve for s in whole.segments), whisker, inner)
    assert price(both, whole, 1.0).outline_kept == pytest.approx((80 + 0.5) / 90, abs=2e-3)


def test_a_line_moved_a_little_is_kept_and_one_moved_far_is_left_out():
    def moved(by: float) -> Drawing:
        return drawn(
            line((10 + by, 0), (20, 0), (20, 20), (10 + by, 20)),
            line((10 + by, 20), (0, 20), (0, 0), (10 + by, 0)),
            line((10 + by, 0), (10 + by, 20)),
        )

    little, far = price(moved(0), moved(0.4), 1.0), price(moved(0), moved(3), 1.0)
    assert little.left_out == 0.0
    assert little.furthest_mm == pytest.approx(0.4, abs=0.01)
    assert little.moved_mm == pytest.approx(0.4 * 20 / 100, abs=0.004)
    assert far.left_out == pytest.approx(18 / 100, abs=2e-3)
    assert far.furthest_mm == pytest.approx(3, abs=0.01)


@pytest.mark.parametrize("picture", [square(), square(MIDDLE), drawn(circle(4))])
def test_a_drawing_that_stays_costs_nothing(picture):
    paid = price(picture, picture, 1.0)
    assert (paid.outline_kept, paid.left_out, paid.moved_mm, paid.furthest_mm) == (1.0, 0.0, 0.0, 0.0)


def test_lines_that_cross_without_a_junction_are_seen():
    across, up = line((0, 5), (10, 5)), line((5, 0), (5, 10))
    assert fitness(drawn(across, up), 1.0, 1.0).crossings == 1
    at = (5.0, 5.0)
    met = drawn(line((0, 5), at), line(at, (10, 5)), line((5, 0), at), line(at, (5, 10)))
    assert fitness(met, 1.0, 1.0).crossings == 0


def test_a_line_that_crosses_itself_is_seen():
    knot = BezierChain(np.array([[(0, 0), (12, 10), (-2, 10), (10, 0)]], float))
    plain = BezierChain(np.array([[(0, 0), (2, 10), (8, 10), (10, 0)]], float))
    assert fitness(drawn(knot), 1.0, 0.1).crossings == 1
    assert fitness(drawn(plain), 1.0, 0.1).crossings == 0


def test_lines_that_lie_on_each_other_are_seen():
    assert fitness(drawn(line((0, 0), (10, 0)), line((5, 0), (15, 0))), 1.0, 1.0).crossings == 1


def test_two_lines_of_one_course_cross_and_enclose_nothing():
    whole = quarter((5, 0), (5, 5), (0, 5))
    cut = joined(BezierChain(part) for part in split(whole.points, 0.37))
    seen = fitness(drawn(whole, cut), 1.0, 1.0)
    assert (seen.crossings, seen.faces_d) == (1, ())


def test_pieces_and_free_ends_are_counted():
    seen = fitness(square(line((10, 0), (10, 4)), line((30, 0), (32, 0))), 1.0, 1.0)
    assert seen.pieces == 2
    assert seen.stubs_mm == pytest.approx([2, 4])
    assert (seen.short_stubs(3), seen.short_stubs(5), seen.short(3), seen.short(50)) == (1, 2, 1, 4)


def test_where_two_lines_meet_alone_is_a_corner_and_where_three_do_is_none():
    two = drawn(line((0, 0), (10, 0)), line((10, 0), (10, 10)))
    three = drawn(*(s.curve for s in two.segments), line((10, 0), (20, 0)))
    assert list(joint_angles(two)) == pytest.approx([math.pi / 2])
    assert list(joint_angles(three)) == []
