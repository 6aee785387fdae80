"""No span too short to be cut smoothly, and all near what was."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.entities import DXFGraphic
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.conftest import OPENED
from wrapit.exports.contour_edges import as_chain
from wrapit.exports.short_spans import without_short_lines, without_short_spans
from wrapit.geometry import Arc, BezierChain, Line
from wrapit.geometry.outlines.closing import SHORT_MM
from wrapit.pipeline.build import Build

SIZES = st.one_of(st.floats(0.002, 0.049), st.floats(0.06, 3.0))
BENDS = st.one_of(st.floats(-2, 2), st.floats(-95, 95))


def chain_of(sides: list[tuple[float, float]]) -> BezierChain:
    """Straight spans of these lengths, each bent from the one before by an angle in degrees."""
    point, heading, edges = np.zeros(2), 0.0, []
    for size, bend in sides:
        heading += math.radians(bend)
        end = point + size * np.array([math.cos(heading), math.sin(heading)])
        edges.append(Line((float(point[0]), float(point[1])), (float(end[0]), float(end[1]))))
        point = end
    return as_chain(edges, closed=False)


def lengths_of(entity: DXFGraphic) -> list[float]:
    """The lengths of an entity's spans."""
    kind = entity.dxftype()
    if kind == "SPLINE":
        poles = np.array(entity.control_points)[:, :2]
        return [BezierChain(poles[None, k : k + 4]).length for k in range(0, len(poles) - 1, 3)]
    if kind == "LWPOLYLINE":
        points = list(entity.get_points("xyb"))
        pairs = itertools.pairwise([*points, points[0]] if entity.closed else points)
        chords = [(math.dist(a[:2], b[:2]), 2 * math.atan(abs(a[2]))) for a, b in pairs]
        return [chord * half / math.sin(half) if half else chord for chord, half in chords]
    assert kind == "CIRCLE"
    return [2 * math.pi * entity.dxf.radius]


def sizes_of(chain: BezierChain) -> list[float]:
    return [BezierChain(cubic[None]).length for cubic in chain.points]


@settings(max_examples=100)
@given(st.lists(st.tuples(SIZES, BENDS), min_size=3, max_size=12))
@example([(0.03125, 0.0), (0.03125, 0.0), (0.04249539433795946, 0.0), (0.029296875, -72.0), (0.046875, 25.0)])
def test_open_chains_keep_their_ends_and_have_long_spans(sides: list[tuple[float, float]]) -> None:
    chain = chain_of(sides)
    kept = without_short_spans(chain, closed=False)
    assert np.array_equal(kept.start, chain.start)
    assert np.array_equal(kept.end, chain.end)
    assert all(np.array_equal(a[3], b[0]) for a, b in itertools.pairwise(kept.points))
    assert len(kept) == 2 or min(sizes_of(kept)) >= 0.99 * SHORT_MM
    short = sum(size < 1.05 * SHORT_MM for size, _ in sides)
    was, now = (shapely.LineString(each.sampled(0.005)) for each in (chain, kept))
    assert was.hausdorff_distance(now) <= (short + 1) * SHORT_MM


@pytest.mark.parametrize("name", OPENED)
def test_built_plates_have_no_short_span(piece: Callable[[str], Build], name: str) -> None:
    folder = piece(name).folder
    assert folder is not None
    plates = sorted(folder.glob("plate-*.dxf"))
    assert plates
    for path in plates:
        for entity in ezdxf.readfile(path).modelspace():
            assert min(lengths_of(entity)) >= 0.99 * SHORT_MM, f"{path.name}: {entity}"


@given(st.floats(0.5, 5), st.floats(0.005, 0.049), st.floats(-6, 6))
def test_a_little_chamfer_becomes_the_corner(side: float, chamfer: float, lean: float) -> None:
    turn = math.radians(45 + lean)
    cut = chamfer * np.array([math.cos(turn), math.sin(turn)])
    corners = [(0.0, 0.0), (side, 0.0), (side + cut[0], cut[1]), (side + cut[0], cut[1] + side)]
    edges = [Line(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    kept = without_short_spans(as_chain(edges, closed=True), closed=True)
    assert len(kept) == 3
    assert np.array_equal(kept.start, kept.end)
    nearest = np.linalg.norm(kept.points[:, 0] - [side + cut[0], 0.0], axis=1).min()
    assert nearest < 1e-9


def test_pieces_of_an_arc_become_one() -> None:
    arcs = [Arc((0, 0), 0.45, 0.08 * k, 0.08) for k in range(18)]
    kept = without_short_spans(as_chain(arcs, closed=False), closed=False)
    assert min(sizes_of(kept)) >= SHORT_MM
    assert np.abs(np.linalg.norm(kept.sampled(0.001), axis=1) - 0.45).max() < 2e-3


@given(st.lists(st.tuples(SIZES, BENDS), min_size=3, max_size=12), st.booleans())
def test_polylines_have_long_lines(sides: list[tuple[float, float]], closed: bool) -> None:
    points = [tuple(point) for point in [*chain_of(sides).points[:, 0], chain_of(sides).end]]
    ends = [*points[1:], points[0]] if closed else points[1:]
    edges = [Line(a, b) for a, b in zip(points, ends, strict=False)]
    kept = without_short_lines(edges, closed=closed)
    assert kept[0].start == edges[0].start
    assert kept[-1].end == edges[-1].end
    assert all(a.end == b.start for a, b in itertools.pairwise(kept))
    lengths = [math.dist(line.start, line.end) for line in kept]
    assert kept == edges or len(kept) == 1 or min(lengths) >= SHORT_MM or len(kept) == 3
