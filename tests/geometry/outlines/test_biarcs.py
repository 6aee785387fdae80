"""Curves as arcs or short lines stay within the tolerance."""

from __future__ import annotations

import itertools
import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, distance
from shapely import points as as_points

from wrapit.geometry import Arc, BezierChain
from wrapit.geometry.outlines.biarcs import as_arcs, as_lines


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


@settings(max_examples=25)
@given(st.integers(0, 2**32))
def test_arcs_share_their_tangents(seed: int) -> None:
    chain = BezierChain(np.random.default_rng(seed).uniform(0, 10, (1, 4, 2)))
    parts = [edge for edge in as_arcs((chain,), 0.01) if isinstance(edge, Arc)]
    pairs = [(a, b) for a, b in itertools.pairwise(parts) if math.dist(a.end, b.start) < 1e-6]
    turns = []
    for a, b in pairs:
        leaving = a.start_rad + a.sweep_rad + math.copysign(math.pi / 2, a.sweep_rad)
        entering = b.start_rad + math.copysign(math.pi / 2, b.sweep_rad)
        turns.append(abs(math.remainder(entering - leaving, math.tau)))
    # At a cusp or where a loop is nothing but a point, an arc may be a line instead.
    assert np.median(turns or [0.0]) < 1e-6
