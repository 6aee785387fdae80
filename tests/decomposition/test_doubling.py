"""Hanging wires taken in by their neighbours."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from tests.bench.graphs import FAMILIES
from tests.decomposition.asking import config, solved
from tests.decomposition.drawings import cross, drawing_of, gap_drawing, theta, twig_drawing
from wrapit.decomposition.doubling import doubled_back
from wrapit.decomposition.energy import weak_trails
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.stage import decompose
from wrapit.decomposition.trails import trails_of


def test_a_hanging_wire_is_taken_in_and_doubled() -> None:
    tee = drawing_of([(0, 0), (10, 0), (20, 0), (10, 8), (10, 14)], [(0, 1), (1, 2), (1, 3), (3, 4)])
    plain, findings = decompose(tee, config())
    assert plain.energy.robustness == 2
    assert "weak-wire" in [finding.code for finding in findings]
    refined, findings = decompose(tee, config(refine_dangling="auto"))
    assert refined.energy.robustness == 0
    assert len(refined.trails) == refined.energy.complexity == 1
    assert refined.doubled
    runs = [t.segment for t in refined.trails[0].traversals]
    assert {e for e in runs if runs.count(e) == 2} == set(refined.doubled)
    assert set(runs) == {0, 1, 2, 3}
    graph = graph_of(tee)
    at = [graph.junction_of[2 * t.segment + t.reversed] for t in refined.trails[0].traversals]
    to = [graph.junction_of[2 * t.segment + 1 - t.reversed] for t in refined.trails[0].traversals]
    assert at[1:] == to[:-1]  # it is one walk
    assert refined.optimal
    assert refined.lower_bound == pytest.approx(refined.energy.total)
    assert "doubled-wire" in [finding.code for finding in findings]


def test_refinement_leaves_good_wires_alone() -> None:
    before, after = solved(theta()), solved(theta(), refine_dangling="auto")
    assert after.trails == before.trails
    assert after.doubled == ()


def test_no_weak_wire_is_left_by_refinement() -> None:
    for weights in ({}, {"robustness": 0.0}, {"robustness": 0.0, "smoothness": 0.0}):
        for drawing in (twig_drawing(), gap_drawing(), cross()):
            solution = solved(drawing, weights=weights, refine_dangling="auto")
            assert weak_trails(graph_of(drawing), solution.trails) == []


@pytest.mark.parametrize("family", ["voronoi", "cactus"])
def test_refinement_of_any_graph_is_a_few_walks_over_everything(family: str) -> None:
    changed = 0
    for seed in range(16):
        graph = FAMILIES[family](np.random.default_rng(seed), 14)
        answer = solve_exactly(Problem(graph, Weights(0.1, 0.0)), 0)
        assert answer is not None
        before = trails_of(graph, answer.mate)
        trails = doubled_back(graph, before)
        runs = [t.segment for trail in trails for t in trail.traversals]
        assert weak_trails(graph, trails) == []
        assert set(runs) == set(range(graph.segments))
        for trail in trails:
            ends = [(2 * t.segment + t.reversed, 2 * t.segment + 1 - t.reversed) for t in trail.traversals]
            stops = [(graph.junction_of[a], graph.junction_of[b]) for a, b in ends]
            assert all(arrived == left for (_, arrived), (left, _) in pairwise(stops))
            assert trail.closed == (stops[0][0] == stops[-1][1])
        changed += trails != before
    assert changed > 3
