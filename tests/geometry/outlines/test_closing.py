"""Edges put end to end: what is too short goes, what is left closes exactly."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.geometry import Arc, BezierChain, Edge, Line, Loop
from wrapit.geometry.bezier import split
from wrapit.geometry.outlines.closing import LEAST_MM, SHORT_MM, closed_up, with_longer_spans
from wrapit.geometry.outlines.loops import as_chain
from wrapit.geometry.outlines.polygons import loop_area_mm2
from wrapit.geometry.polyline import steps

TINY = st.lists(st.floats(1e-12, 0.9e-3), min_size=0, max_size=5)


def polygon_with_slivers(slivers: list[list[float]], chains: list[bool]) -> list[Edge]:
    """A regular polygon, 10 mm in radius; at each corner edges of the given lengths along its way round."""
    corners = 10 * np.exp(2j * np.pi * np.arange(len(slivers)) / len(slivers))
    edges: list[Edge] = []
    for corner, following, sizes, chain in zip(corners, np.roll(corners, -1), slivers, chains, strict=True):
        way = (following - corner) / abs(following - corner)
        stops = [corner, *(corner + way * np.cumsum(sizes)), following]
        for a, b in itertools.pairwise(stops):
            line = Line((a.real, a.imag), (b.real, b.imag))
            edges.append(as_chain(line) if chain else line)
    return edges


@given(st.lists(st.tuples(TINY, st.booleans()), min_size=3, max_size=8))
def test_nothing_short_stays_and_all_meets(sides: list[tuple[list[float], bool]]) -> None:
    edges = closed_up(polygon_with_slivers([sizes for sizes, _ in sides], [chain for _, chain in sides]))
    for edge, after in zip(edges, edges[1:] + edges[:1], strict=True):
        assert tuple(edge.end) == tuple(after.start)
        sizes = (
            steps(edge.points).sum(axis=1)
            if isinstance(edge, BezierChain)
            else [math.dist(edge.start, edge.end)]
        )  # type: ignore[union-attr]
        assert min(sizes) >= LEAST_MM * 0.99
    count = len(sides)
    area = count / 2 * 100 * math.sin(math.tau / count)
    assert loop_area_mm2(Loop(tuple(edges))) == pytest.approx(area, abs=0.1 * count)


def test_arcs_stay_where_they_are() -> None:
    left, right = Arc((0.0, 0.0), 5.0, math.pi / 2, math.pi), Arc((0.0005, 0.0), 5.0, -math.pi / 2, math.pi)
    edges = closed_up([left, Line(left.end, right.start), right, Line(right.end, left.start)])
    assert [edge for edge in edges if isinstance(edge, Arc)] == [left, right]
    for edge, after in zip(edges, edges[1:] + edges[:1], strict=True):
        assert math.dist(edge.end, after.start) < 1e-12


@given(st.floats(0.001, 0.04), st.floats(-1, 1))
def test_a_cubic_cut_in_two_becomes_itself_again(share: float, bend: float) -> None:
    cubic = np.array([[(0.0, 0.0), (0.3, bend / 3), (0.6, -bend / 3), (1.0, bend)]])
    parts = BezierChain(np.concatenate(split(cubic, share)))
    whole = with_longer_spans(parts)
    assert steps(parts.points).sum(axis=1).min() < SHORT_MM * 2
    if steps(parts.points).sum(axis=1).min() < SHORT_MM:
        assert len(whole) == 1
        assert np.allclose(whole.points, cubic, atol=1e-9)
