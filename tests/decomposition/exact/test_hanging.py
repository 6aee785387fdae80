"""Weak wires that one junction decides, as costs at that junction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.decomposition.brute import all_matchings, best_by_trying, energy_by_definition
from tests.decomposition.cases import connected
from tests.decomposition.drawings import cross, theta
from wrapit.decomposition.energy import contacts_of
from wrapit.decomposition.exact.hanging import Pendants
from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.exact.ring_bound import certify
from wrapit.decomposition.graph import Graph, graph_of
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.trails import trails_of

WEIGHTS = Weights(0.1, 0.9, 0.1)


def charged(graph: Graph) -> LocalCosts:
    costs = LocalCosts(Problem(graph, WEIGHTS))
    Pendants(graph, costs, WEIGHTS.robustness)
    return costs


def test_a_leaf_left_alone_costs_a_weak_wire() -> None:
    graph = graph_of(cross())
    costs = charged(graph)
    tips = [h for h in range(8) if len(graph.incident[graph.junction_of[h]]) == 1]
    assert [costs.free[h] for h in range(8) if h not in tips] == [pytest.approx(0.9)] * 4
    # Two leaves that make one wire hang together: each transition is charged as well.
    assert costs.pair[0][2] == pytest.approx(-1.0 + 0.9)
    least, _ = costs.best(graph.junction_of[0])
    assert graph.segments + least == pytest.approx(2 + 1.8)


def test_where_nothing_hangs_nothing_is_charged() -> None:
    costs = charged(graph_of(theta()))
    assert set(costs.free) == {0.0}
    assert costs.loose == {}


def test_a_loop_is_charged_at_both_its_ends() -> None:
    angles = np.array([0.3, 1.2, 2.0, 4.0, 5.0, 0.1])
    graph = Graph((0, 0, 0, 1, 0, 1), np.stack([np.cos(angles), np.sin(angles)], axis=1), (1.0,) * 3)
    costs = charged(graph)
    assert costs.loose == {0: (1, pytest.approx(0.9))}


@settings(deadline=None, max_examples=120)
@given(seed=st.integers(0, 10**9), segments=st.integers(2, 6), junctions=st.integers(2, 7))
def test_the_costs_at_junctions_never_add_up_to_more_than_the_energy(
    seed: int, segments: int, junctions: int
) -> None:
    graph = connected(seed, segments, junctions)
    costs = charged(graph)
    for mate in islice(all_matchings(graph), 200):
        energy = energy_by_definition(graph, mate, WEIGHTS)
        if energy is not None:
            at_junctions = math.fsum(costs.cost(j, mate) for j in range(len(graph.incident)))
            assert graph.segments + at_junctions <= energy + 1e-9
    assert graph.segments + certify(graph, costs).bound <= best_by_trying(graph, WEIGHTS) + 1e-9


@pytest.mark.parametrize("weights", [WEIGHTS, Weights(0.3, 2.0), Weights(0.1, 0.3)], ids=str)
def test_what_is_learned_of_a_branch_keeps_the_bound_below_the_best(weights: Weights) -> None:
    learned = 0
    for seed in range(300):
        graph = connected(seed, 5, 5)
        costs = LocalCosts(Problem(graph, weights))
        pendants = Pendants(graph, costs, weights.robustness)
        while pendants.learn(mate := certify(graph, costs).mate, weak_ends(graph, mate)):
            learned += 1
            bound = graph.segments + certify(graph, costs).bound
            assert bound <= best_by_trying(graph, weights) + 1e-9
    assert learned > 10  # else this tests nothing


def weak_ends(graph: Graph, mate: Sequence[int]) -> list[tuple[int, int]]:
    """A wire end and the one contact of each weak wire."""
    trails = trails_of(graph, mate)
    return [
        (trail.traversals[0].departure, min(junctions))
        for trail, junctions in zip(trails, contacts_of(graph, trails), strict=True)
        if len(junctions) == 1
    ]
