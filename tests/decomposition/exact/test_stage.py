"""The proven optimum, against all matchings of small graphs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import FAMILIES, all_even, random_multigraph
from tests.decomposition.brute import all_matchings, best_by_trying, energy_by_definition
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem

WEIGHTS = Weights(0.1, 0.9, 0.1)
BUDGET = 2_000_000


def whole_pieces(graph: Graph) -> list[Graph]:
    return [graph.subgraph(piece) for piece in pieces(graph)]


@settings(deadline=None, max_examples=250)
@given(
    seed=st.integers(0, 10**9),
    segments=st.integers(1, 6),
    junctions=st.integers(2, 7),
    even=st.booleans(),
    weights=st.sampled_from(
        [WEIGHTS, Weights(0.0, 0.0), Weights(0.1, 0.0), Weights(0.3, 2.0), Weights(0.5, 0.9)]
    ),
)
def test_nothing_is_better_than_the_answer(
    seed: int, segments: int, junctions: int, even: bool, weights: Weights
) -> None:
    graph = (all_even if even else random_multigraph)(np.random.default_rng(seed), segments, junctions)
    for piece in whole_pieces(graph):
        answer = solve_exactly(Problem(piece, weights), BUDGET)
        best = best_by_trying(piece, weights)
        assert energy_by_definition(piece, answer.mate, weights) == pytest.approx(best, abs=1e-8)
        assert answer.lower_bound == pytest.approx(best, abs=1e-8)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("segments", [12, 54, 200])
def test_drawings_of_every_kind_are_proven(family: str, segments: int) -> None:
    graph = FAMILIES[family](np.random.default_rng(segments), segments)
    for piece in whole_pieces(graph):
        answer = solve_exactly(Problem(piece, WEIGHTS), BUDGET)
        energy = energy_of(piece, answer.mate, WEIGHTS)
        assert answer.lower_bound == pytest.approx(energy.total, abs=1e-8)


def test_beyond_the_budget_the_bound_is_still_true() -> None:
    unproven = 0
    for seed in range(30):
        graph = random_multigraph(np.random.default_rng(seed), 6, 2 + seed % 2)
        graph = graph.subgraph(max(pieces(graph), key=len))
        answer = solve_exactly(Problem(graph, WEIGHTS), 0)
        best = best_by_trying(graph, WEIGHTS)
        energy = energy_by_definition(graph, answer.mate, WEIGHTS)
        assert energy is not None
        assert answer.lower_bound is not None
        assert answer.lower_bound <= best + 1e-9 <= energy + 2e-9
        unproven += energy - answer.lower_bound > 1e-6
    assert unproven  # else this tests nothing


def test_the_judge_sees_every_matching() -> None:
    two = Graph((0, 1, 0, 1), np.eye(2).repeat(2, axis=0), (1.0, 1.0))
    assert sum(1 for _ in all_matchings(two)) == 4
    assert sum(energy_by_definition(two, mate, WEIGHTS) is None for mate in all_matchings(two)) == 1


def test_the_same_graph_has_the_same_answer() -> None:
    graph = FAMILIES["cactus"](np.random.default_rng(3), 120)
    answers = {solve_exactly(Problem(graph.subgraph(range(120)), WEIGHTS), BUDGET) for _ in range(2)}
    assert len(answers) == 1
