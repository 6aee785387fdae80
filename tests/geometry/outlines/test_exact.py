"""Exact outlines against answers worked out on paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.jig.metal import circle, scribble
from wrapit.geometry import Arc, Line
from wrapit.geometry.curveset import CurveSet
from wrapit.geometry.outlines.exact import Outliner
from wrapit.geometry.outlines.loops import as_chain
from wrapit.geometry.outlines.parallels import Side
from wrapit.geometry.outlines.polygons import (
    fitted_edges,
    loop_area_mm2,
    region_area_mm2,
)
from wrapit.jig.support import edge_points

R = 0.7


def outlined(edges, box):
    outliner = Outliner.of(edges, (R,), 1.2e-3)
    lines = [shapely.LineString(as_chain(edge).sampled(0.01)) for edge in edges]
    grown = shapely.union_all(shapely.buffer(lines, R + 3e-4, quad_segs=32))
    parts = shapely.get_parts(box.difference(grown))
    parts = sorted((part for part in parts if part.area > 0.05), key=lambda part: part.bounds)
    return outliner, [outliner.region(part) for part in parts]


def test_area_beside_a_line() -> None:
    _, (below, above) = outlined([Line((-5, 0), (15, 0))], shapely.box(0, -3, 10, 4))
    assert sorted([region_area_mm2(below), region_area_mm2(above)]) == pytest.approx([23.0, 33.0], abs=1e-9)
    assert all(isinstance(edge, Line) for edge in above.outer.edges)


def test_area_inside_and_outside_a_circle() -> None:
    arc = Arc((1.0, 2.0), 5.0, 0.3, 2 * math.pi)
    _, regions = outlined([arc], shapely.Point(1, 2).buffer(8, quad_segs=64))
    ring, disc = sorted(regions, key=region_area_mm2, reverse=True)
    assert region_area_mm2(disc) == pytest.approx(math.pi * 4.3**2, abs=1e-6)
    (hole,) = ring.holes
    assert -loop_area_mm2(hole) == pytest.approx(math.pi * 5.7**2, abs=1e-6)


def test_corner_where_two_lines_cross() -> None:
    lines = [Line((-9, 0), (9, 0)), Line((0, -9), (0, 9))]
    _, regions = outlined(lines, shapely.box(-5, -5, 5, 5))
    assert len(regions) == 4
    for region in regions:
        assert region_area_mm2(region) == pytest.approx(4.3**2, abs=1e-9)
        corners = {(round(abs(x), 9), round(abs(y), 9)) for x, y in (e.start for e in region.outer.edges)}
        assert (R, R) in corners


def test_round_end_of_a_line() -> None:
    _, (region,) = outlined([Line((0, 0), (10, 0))], shapely.box(-5, -5, 5, 5))
    channel = 5 * 2 * R + math.pi * R**2 / 2
    assert region_area_mm2(region) == pytest.approx(100 - channel, abs=1e-6)
    assert sum(isinstance(edge, Arc) for edge in region.outer.edges) == 1


def test_parallel_of_a_circle_of_cubics_is_a_circle() -> None:
    chain = circle(6.0)
    curves = CurveSet.of([chain])
    side = Side(curves, chain, 0, 2.0)
    parallel = side.between(0.4, curves.end_of(0) - 0.7)
    radii = np.linalg.norm(edge_points(parallel, 0.01), axis=1)
    assert np.abs(radii - 4.0).max() < 5e-5


def test_nearest_finds_what_a_dense_search_finds() -> None:
    rng = np.random.default_rng(5)
    chains = [scribble(rng, 30, 9) for _ in range(3)]
    points = rng.uniform(-5, 35, size=(60, 2))
    near = CurveSet.of(chains).nearest(points, 100.0)
    for index, point in enumerate(points):
        dense = [np.linalg.norm(chain.sampled(0.002) - point, axis=1).min() for chain in chains]
        assert near.distance[index] == pytest.approx(min(dense), abs=1e-3)
        assert dense[near.curve[index]] == pytest.approx(min(dense), abs=1e-3)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10_000))
@example(150)  # all but a cusp: half a turn within a ten-thousandth of a cubic
@example(177)  # a joint of curves behind the place where both parallels fold back
def test_any_scribble_leaves_faces_at_the_right_distance(seed: int) -> None:
    rng = np.random.default_rng(seed)
    chains = [scribble(rng, 25, 8), scribble(rng, 25, 7, closed=True)]
    outliner, regions = outlined(chains, shapely.box(-2, -2, 27, 27))
    for region in regions:
        for loop in (region.outer, *region.holes):
            for edge, after in zip(loop.edges, loop.edges[1:] + loop.edges[:1], strict=True):
                assert np.allclose(edge_points(edge, 1)[-1], edge_points(after, 1)[0], atol=1e-9)
                if edge_points(edge, 9.0)[0].min() > -1.9 and edge_points(edge, 9.0)[0].max() < 26.9:
                    near = outliner.curves.nearest(edge_points(edge, 0.05), R + 1)
                    assert near.distance.min() > R - 1e-3


def test_fitted_edges_keep_corners_and_stay_near() -> None:
    t = np.linspace(0, math.pi / 2, 40)
    round_part = np.column_stack([3 * np.cos(t), 3 * np.sin(t)])
    points = np.concatenate([[(3.0, -4.0)], round_part, [(-5.0, 3.0), (-5.0, 6.0)]])
    edges = fitted_edges(points, 0.002)
    sampled = np.concatenate([edge_points(edge, 0.01) for edge in edges])
    assert shapely.LineString(points).hausdorff_distance(shapely.LineString(sampled)) < 0.01
    assert any(np.allclose(edge_points(edge, 9)[0], (-5.0, 3.0)) for edge in edges)
    assert len(edges) <= 5
