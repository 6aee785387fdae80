"""Outlines grown and shrunk, against shapely and what is known on paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, Polygon, union_all

from wrapit.geometry import Arc, Line, Loop, Region
from wrapit.geometry.outlines.exact import Outliner
from wrapit.geometry.outlines.loops import (
    circle,
    moved,
    reversed_loop,
    rounded_rectangle,
)
from wrapit.geometry.outlines.offsets import offset_region
from wrapit.geometry.outlines.polygons import loop_area_mm2, polygon_of, region_area_mm2

sizes = st.floats(1, 50)


def area(loop: Loop) -> float:
    return Polygon(loop.sampled(1e-5)).area


@settings(max_examples=30, deadline=None)
@given(sizes, sizes, st.just(0.0) | st.floats(0.05, 8), st.floats(0.01, 0.3))
def test_rounded_rectangles_grow_exactly(width: float, height: float, radius: float, by: float) -> None:
    radius = min(radius, width / 2, height / 2)
    loop = rounded_rectangle(0, 0, width, height, radius)
    assert area(loop) == pytest.approx(width * height - (4 - math.pi) * radius**2, abs=1e-2)
    (grown,) = offset_region(Region(loop), by)
    perimeter = 2 * (width + height) - (8 - 2 * math.pi) * radius
    assert area(grown.outer) == pytest.approx(area(loop) + perimeter * by + math.pi * by**2, abs=1e-2)


def test_shrinking_to_nothing_leaves_nothing() -> None:
    assert offset_region(Region(rounded_rectangle(0, 0, 4, 1, 0)), -0.6) == ()
    assert offset_region(Region(circle((0, 0), 1.0)), -1.5) == ()
    (ring,) = offset_region(Region(circle((0, 0), 1.0)), -0.25)
    assert ring.outer.edges[0].radius_mm == pytest.approx(0.75)


def test_a_neck_parts_into_two() -> None:
    corners = [
        (0, 0),
        (4, 0),
        (4, 1.4),
        (6, 1.4),
        (6, 0),
        (10, 0),
        (10, 3),
        (6, 3),
        (6, 1.6),
        (4, 1.6),
        (4, 3),
        (0, 3),
    ]
    loop = Loop(tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))
    left, right = offset_region(Region(loop), -0.15)
    assert area(left.outer) == pytest.approx(3.7 * 2.7, abs=0.02)
    assert area(right.outer) == pytest.approx(3.7 * 2.7, abs=0.02)


def blob(seed: int) -> Region:
    """A smooth outline of a few circles run together."""
    rng = np.random.default_rng(seed)
    circles = [Arc((float(x), float(y)), float(r), 0.0, math.tau) for x, y, r in rng.uniform(2, 6, (3, 3))]
    grown = union_all([Point(c.centre).buffer(c.radius_mm + 1.0, quad_segs=128) for c in circles])
    largest = max(getattr(grown, "geoms", [grown]), key=lambda g: g.area)
    return Outliner.of(circles, (1.0,), 2e-3).region(largest)


@settings(max_examples=15)
@given(st.integers(0, 10_000), st.sampled_from([-0.6, -0.2, 0.15, 0.8]))
def test_offsets_are_shapelys_but_exact(seed: int, by: float) -> None:
    region = blob(seed)
    found = offset_region(region, by)
    flat = polygon_of(region, 1e-5).buffer(by, quad_segs=256)
    assert sum(map(region_area_mm2, found)) == pytest.approx(flat.area, abs=5e-3)
    for part in found:
        for x, y in part.outer.sampled(1e-3):
            assert polygon_of(region, 1e-5).exterior.distance(Point(x, y)) == pytest.approx(abs(by), abs=5e-4)


@settings(max_examples=15)
@given(st.integers(0, 10_000), st.floats(0, 6), st.floats(-30, 30))
def test_exact_areas_are_shapelys_and_stay_under_rigid_motion(seed: int, turn: float, shift: float) -> None:
    region = blob(seed)
    flat = polygon_of(region, 1e-6)
    assert region_area_mm2(region) == pytest.approx(flat.area, rel=1e-4)
    quarter = Region(Loop(tuple(moved(edge, round(turn), (shift, -shift)) for edge in region.outer.edges)))
    assert loop_area_mm2(quarter.outer) == pytest.approx(loop_area_mm2(region.outer), rel=1e-9)
    assert loop_area_mm2(reversed_loop(region.outer)) == pytest.approx(-loop_area_mm2(region.outer), rel=1e-9)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.floats(2.0, 15.0), st.booleans()), min_size=1, max_size=3),
    st.floats(25, 110),
    st.sampled_from([-0.025, 0.025, 0.1]),
)
def test_edges_as_short_as_a_hair_keep_their_parallels(
    steps: list[tuple[float, bool]], bend_deg: float, by: float
) -> None:
    """A square one of whose sides has steps of twice the offset and more, as walls have at their feet."""
    corners = [(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (3.0, 6.0)]
    for share, up in steps:
        (x, y), length = corners[-1], share * abs(by)
        turned = math.radians(180 + (bend_deg if up else -bend_deg))
        corners += [(x + length * math.cos(turned), y + length * math.sin(turned))]
        corners += [(corners[-1][0] - length, corners[-1][1])]
    corners.append((0.0, corners[-1][1]))
    square = Polygon(corners)
    expected = square.buffer(by, quad_segs=64)
    if not square.is_valid or expected.geom_type != "Polygon" or expected.interiors:
        return
    ring = [(float(x), float(y)) for x, y in square.exterior.coords[:-1]]
    edges = tuple(Line(a, b) for a, b in zip(ring, [*ring[1:], ring[0]], strict=True))
    (moved_one,) = offset_region(Region(Loop(edges)), by)
    found = polygon_of(moved_one, 1e-5)
    assert found.is_valid
    assert found.exterior.hausdorff_distance(expected.exterior) < 1e-3
