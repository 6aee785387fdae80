"""Moving, turning, offsetting and simplifying outlines keeps what it promises."""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon, distance
from shapely import points as as_points
from svgelements import Path as SvgPath

from tests.exports.pieces_for_tests import arc_chain, hairpin
from tests.jig.sheet.laser import laser_of
from wrapit.config import PlateConfig
from wrapit.exports.contour_edges import as_bulges, as_chain
from wrapit.exports.plate_svg import plate_svg
from wrapit.geometry import Arc, BezierChain, Line, Loop, Region
from wrapit.geometry.outlines.biarcs import as_arcs, as_lines
from wrapit.geometry.outlines.moves import (
    circle,
    moved,
    oriented,
    reversed_loop,
    rounded_rectangle,
    turns_left,
)
from wrapit.geometry.outlines.offsets import offset_region
from wrapit.jig.contours import FlatDrawing
from wrapit.jig.sheet.checks import length_mm
from wrapit.jig.sheet.inlays import moved_outline

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


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 7), st.floats(-20, 20), st.floats(-20, 20))
def test_moving_keeps_length_and_turns_by_right_angles(quarters: int, x: float, y: float) -> None:
    edges = [Line((1, 2), (3, 5)), Arc((1, 1), 2.0, 0.3, 4.0), arc_chain((2, 0), 3.0, 0.5, 2.0)]
    turn = quarters * math.pi / 2
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    for edge in edges:
        got = moved(edge, quarters, (x, y)).sampled(0.1)
        assert np.allclose(got, edge.sampled(0.1) @ matrix.T + [x, y], atol=1e-9)


def test_orientation_is_set_and_turned_round() -> None:
    loop = Loop((arc_chain((0, 0), 8.0, 0.0, math.pi), Line((-8, 0), (8, 0))))
    assert turns_left(loop)
    assert not turns_left(reversed_loop(loop))
    region = oriented(Region(reversed_loop(loop), (circle((0, 3), 1.0),)))
    assert turns_left(region.outer)
    assert not turns_left(region.holes[0])
    assert area(region.outer) == pytest.approx(area(loop), rel=1e-6)


def test_mixed_edges_become_one_chain_without_gaps() -> None:
    edges = (
        Line((0, 0), (4, 0)),
        Arc((4, 1), 1.0, -math.pi / 2, math.pi),
        Line((4 + 1e-9, 2), (0, 2)),
        Arc((0, 1), 1.0, math.pi / 2, math.pi),
    )
    chain = as_chain(edges, closed=True)
    assert np.array_equal(chain.start, chain.end)
    assert chain.length == pytest.approx(8 + 2 * math.pi, abs=1e-6)
    with pytest.raises(ValueError, match="apart"):
        as_chain((Line((0, 0), (1, 0)), Line((1.1, 0), (0, 0))), closed=True)


def test_bulges_are_the_arcs() -> None:
    vertices = as_bulges((Arc((0, 0), 2.0, 0.0, math.pi), Line((-2, 0), (2, 0))), closed=True)
    assert vertices[0] == pytest.approx((2, 0, 1.0))
    assert vertices[1] == pytest.approx((-2, 0, 0.0), abs=1e-12)
    with pytest.raises(ValueError, match="Bézier"):
        as_bulges((arc_chain((0, 0), 1, 0, 1),), closed=False)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32), st.sampled_from([0.2, 0.02, 0.002]))
def test_arcs_and_lines_keep_to_the_tolerance(seed: int, tolerance: float) -> None:
    chain = BezierChain(np.random.default_rng(seed).uniform(0, 10, (1, 4, 2)))
    true = chain.sampled(0.002)
    for edges in (as_arcs((chain,), tolerance), as_lines((chain,), tolerance)):
        assert np.allclose(edges[0].start, chain.start, atol=1e-9)
        assert np.allclose(edges[-1].end, chain.end, atol=1e-9)
        for before, after in itertools.pairwise(edges):
            assert math.dist(before.end, after.start) < 1e-6
        points = np.vstack([edge.sampled(tolerance / 50) for edge in edges])
        assert distance(as_points(true), LineString(points)).max() <= 1.1 * tolerance + 1e-6


def test_svg_is_at_true_size_with_the_lengths_of_the_contours() -> None:
    laser, _ = laser_of(hairpin(), PlateConfig())
    sheet = laser.sheets[0]
    root = ET.fromstring(
        plate_svg(FlatDrawing("plate", "a & b", sheet.contours, sheet.width_mm, sheet.height_mm))
    )
    assert root.get("width") == f"{sheet.width_mm:g}mm"
    assert root.get("viewBox") == f"0 0 {sheet.width_mm:g} {sheet.height_mm:g}"
    groups = {group.get("id"): group for group in root if group.tag.endswith("}g")}
    assert list(groups) == ["ENGRAVE", "CUT_INNER", "CUT_OUTER"]
    assert groups["CUT_OUTER"].get("stroke") == "#ff0000"
    for layer, group in groups.items():
        assert group.get("fill") == "none"
        drawn = sorted(SvgPath(path.get("d")).length(error=1e-6) for path in group)
        planned = sorted(length_mm(contour) for contour in sheet.contours if contour.layer == layer)
        assert drawn == pytest.approx(planned, abs=5e-3)


def test_where_no_exact_outline_is_found_lines_take_its_place() -> None:
    loop = rounded_rectangle(0, 0, 10, 4, 1)

    def fails(_: Region, __: float) -> tuple[Region, ...]:
        raise ValueError("no meeting")

    def wrong(region: Region, distance_mm: float) -> tuple[Region, ...]:
        return offset_region(region, 2 * distance_mm)

    true = moved_outline(loop, 0.1, offset_region)
    assert true is not None
    assert true.exact
    for offset in (fails, wrong):
        plain = moved_outline(loop, 0.1, offset)
        assert plain is not None
        assert not plain.exact
        assert area(plain.loop) == pytest.approx(area(true.loop), abs=0.02)
    assert moved_outline(loop, -2.1, fails) is None
