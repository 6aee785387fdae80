"""Wires round posts, against lengths worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from tests.jig.taut.ground import arc, joined, length, post, pulled
from wrapit.geometry import FloatArray
from wrapit.jig.taut.shortest import HAIR_MM

# A post of 1024 sides is as round as this: its circumference lacks 1.6e-6 of itself.
ROUND = 1e-4


def tangent(distance: float, radius: float) -> float:
    return math.sqrt(distance**2 - radius**2)


def test_nothing_in_the_way_leaves_a_straight_line() -> None:
    path = joined([(0, 0), (3, 8), (5, -6), (10, 0)])
    found = pulled(post(20, 20, 1), path)
    assert np.array_equal(found, [(0, 0), (10, 0)])


def test_one_post_is_tangent_arc_tangent() -> None:
    found = pulled(post(0, 0, 2), joined([(-5, 0), (0, 6), (5, 0)]))
    wrapped = math.pi - 2 * math.acos(2 / 5)
    assert length(found) == pytest.approx(2 * tangent(5, 2) + 2 * wrapped, abs=ROUND)


def test_below_the_post_is_another_way_than_above() -> None:
    path = joined([(-5, 0), (0, 6), (5, 0)])
    above, below = pulled(post(0, 0, 2), path), pulled(post(0, 0, 2), path * (1, -1))
    assert above[1:-1, 1].min() > 0 > below[1:-1, 1].max()
    assert length(above) == pytest.approx(length(below), abs=1e-9)


def test_an_s_crosses_between_two_posts() -> None:
    """Over the left, under the right: from (-8, 0) to (8, 0) with posts of 2 at -4 and 4."""
    posts = shapely.union(post(-4, 0, 2), post(4, 0, 2))
    found = pulled(posts, joined([(-8, 0), (-4, 5), (0, 0), (4, -5), (8, 0)]))
    # Symmetric about the origin: each half is two tangents from points 4 mm from the post's middle.
    wrapped = math.pi - 2 * math.acos(2 / 4)
    assert length(found) == pytest.approx(2 * (2 * tangent(4, 2) + 2 * wrapped), abs=ROUND)


def test_a_hairpin_turns_by_half_a_circle() -> None:
    found = pulled(post(0, 0, 2), joined([(-9, 2), (4, 4), (4, -4), (-9, -2)]))
    assert length(found) == pytest.approx(2 * 9 + 2 * math.pi, abs=ROUND)


def wound(turns: float, inner: float = 3, pitch: float = 0.4) -> FloatArray:
    """From (-9, 0), round a middle at the origin `turns` times, clockwise as on a winch."""
    angles = math.pi - np.linspace(0, 2 * math.pi * turns, math.ceil(turns * 72) + 1)
    radii = inner + pitch * np.linspace(0, turns, len(angles))
    return joined([(-9, 0)], np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]))


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_what_is_wound_stays_wound(turns: int) -> None:
    """Round the post and on to (9, 0), on the other side."""
    path = joined(wound(turns + 0.5), [(9, 0)])
    wrapped = 2 * math.pi * turns + math.pi - 2 * math.acos(2 / 9)
    assert length(pulled(post(0, 0, 2), path)) == pytest.approx(
        2 * tangent(9, 2) + 2 * wrapped, abs=ROUND * turns
    )


def test_a_spiral_ends_where_it_is_held() -> None:
    """Its end at 3.4 mm from the middle stays; two rounds and the two tangents are what is left."""
    path = wound(2)
    end = float(np.hypot(*path[-1]))
    wrapped = 4 * math.pi - math.acos(2 / 9) - math.acos(2 / end)
    assert length(pulled(post(0, 0, 2), path)) == pytest.approx(
        tangent(9, 2) + tangent(end, 2) + 2 * wrapped, abs=ROUND
    )


def test_a_loop_round_nothing_is_pulled_out() -> None:
    path = joined([(-10, 0)], arc(0, 3, 3, -90, 270), [(10, 0)])
    found = pulled(post(0, 20, 1), path)
    assert np.array_equal(found, [(-10, 0), (10, 0)])


def test_a_wire_that_crosses_itself_keeps_the_post_in_its_loop() -> None:
    """The same loop with a post in it: over, round and out below it."""
    path = joined([(-10, 0)], arc(0, 3, 3, -90, 270), [(10, 0)])
    found = pulled(post(0, 3, 1), path)
    reach = math.hypot(10, 3)
    # The angle at the post between its two ends, measured below it; one whole round more.
    between = 2 * math.atan2(10, 3)
    wrapped = 2 * math.pi + between - 2 * math.acos(1 / reach)
    assert length(found) == pytest.approx(2 * tangent(reach, 1) + wrapped, abs=ROUND)


@pytest.mark.parametrize("again", [False, True])
def test_a_closed_wire_round_two_posts_is_a_belt(again: bool) -> None:
    posts = shapely.union(post(-5, 0, 2), post(5, 0, 2))
    path = joined(arc(-5, 0, 4, 90, 270), arc(5, 0, 4, -90, 90))
    found = pulled(posts, joined(path, path[:1]) if again else path, closed=True)
    assert length(found) == pytest.approx(2 * 10 + 4 * math.pi, abs=2 * ROUND)
    assert np.array_equal(found[0], found[-1])


def test_a_figure_eight_is_a_crossed_belt() -> None:
    posts = shapely.union(post(-5, 0, 2), post(5, 0, 2))
    path = joined(arc(-5, 0, 4, 60, 300), arc(5, 0, 4, -120, 120)[::1])
    found = pulled(posts, joined(arc(-5, 0, 4, 60, 300), arc(5, 0, 4, 120, -120)[::-1]), closed=True)
    crossed = pulled(posts, joined(arc(-5, 0, 4, 45, 315), arc(5, 0, 4, 135, -135)), closed=True)
    assert length(found) == pytest.approx(length(pulled(posts, path, closed=True)), abs=1e-6)
    # Tangents cross in the middle; each post is wrapped by half a turn and twice the tangent's slope.
    slope = math.asin(2 / 5)
    assert length(crossed) == pytest.approx(4 * tangent(5, 2) + 2 * 2 * (math.pi + 2 * slope), abs=2 * ROUND)
    assert length(crossed) > length(found) + 1


def test_a_closed_wire_twice_round_a_post_is_twice_its_girth() -> None:
    found = pulled(post(0, 0, 2), joined(arc(0, 0, 3, 0, 356), arc(0, 0, 3.5, 0, 356)), closed=True)
    assert length(found) == pytest.approx(2 * 4 * math.pi, abs=2 * ROUND)


def test_a_closed_wire_round_nothing_is_a_point() -> None:
    path = arc(0, 0, 4, 0, 356)
    assert np.array_equal(pulled(post(9, 9, 1), path, closed=True), path[:1])


def test_what_closes_a_wire_may_run_through_an_obstacle() -> None:
    """The first point isn't repeated, and the closing stretch cuts a wall: that gives way."""
    wall, held = shapely.box(-1, -1, 1, 1), post(0, 6, 2)
    path = joined([(4, 0), (4, 12), (-4, 12), (-4, 0)])
    found = pulled(shapely.union(wall, held), path, closed=True)
    # The wall is in two halves: the upper one stays in the loop, from a hair above the middle.
    hull = shapely.union(held, shapely.box(-1, HAIR_MM, 1, 1)).convex_hull
    assert length(found) == pytest.approx(hull.length, abs=1e-9)


def test_a_gap_is_passed_the_way_it_was_drawn() -> None:
    """Between two boxes that nearly touch, though round them is as near."""
    boxes = shapely.union(shapely.box(-2, -4, 2, -0.005), shapely.box(-2, 0.005, 2, 4))
    found = pulled(boxes, joined([(-6, 3), (-3, 0), (3, 0), (6, 3)]))
    assert length(found) == pytest.approx(4 + 2 * math.hypot(4, 3 - 0.005), abs=1e-12)
    assert np.allclose(found[1:-1], [(-2, 0.005), (2, 0.005)], atol=1e-12)


def test_ends_that_lie_on_the_side_of_an_obstacle_stay() -> None:
    path = joined([(-2, 0), (-3, 3), (3, 3), (2, 0)])
    found = pulled(shapely.box(-2, -2, 2, 2), path)
    assert np.array_equal(found[[0, -1]], path[[0, -1]])
    assert length(found) == pytest.approx(2 + 4 + 2, abs=3 * HAIR_MM)
