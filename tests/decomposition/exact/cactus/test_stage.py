"""Rings and lines that hang on one another: solved block by block, against all matchings and against cuts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import cactus, flowers, random_multigraph
from tests.decomposition.brute import best_by_trying, energy_by_definition
from tests.decomposition.exact.cactus.test_blocks import largest_piece
from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.exact.cactus.stage import solved_by_blocks
from wrapit.decomposition.exact.integer_programme import solve_by_cuts
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Weights
from wrapit.decomposition.problem import Answer, Problem
from wrapit.decomposition.rules import Rules

WEIGHTS = Weights(0.1, 0.9, 0.1)


@settings(deadline=None, max_examples=300)
@given(
    seed=st.integers(0, 10**9),
    segments=st.integers(1, 7),
    twigs=st.sampled_from([0.0, 0.4, 0.9]),
    thorns=st.integers(1, 4),
    weights=st.sampled_from(
        [WEIGHTS, WEIGHTS, Weights(0.0, 0.0), Weights(0.1, 0.0), Weights(0.3, 2.0), Weights(0.5, 0.9)]
    ),
)
def test_nothing_is_better_than_block_by_block(
    seed: int, segments: int, twigs: float, thorns: int, weights: Weights
) -> None:
    graph = flowers(np.random.default_rng(seed), segments, thorns, twigs)
    if max(map(len, graph.incident)) > 10:
        graph = flowers(np.random.default_rng(seed), 5, thorns, twigs)
    answer = solved_by_blocks(Problem(graph, weights))
    best = best_by_trying(graph, weights)
    assert answer is not None
    assert answer.proven
    assert energy_by_definition(graph, answer.mate, weights) == pytest.approx(best, abs=1e-8)
    assert answer.lower_bound == pytest.approx(best, abs=1e-8)


@pytest.mark.parametrize("seed", range(8))
def test_cuts_find_the_same(seed: int) -> None:
    graph = flowers(np.random.default_rng(seed), 9 + seed, 2 + seed % 4, [0.0, 0.3, 0.8][seed % 3])
    problem = Problem(graph, WEIGHTS)
    answer = solved_by_blocks(problem)
    other = solve_by_cuts(problem, Answer((NO_MATE,) * (2 * graph.segments), 0, 0.0), 200_000)
    assert answer is not None
    assert other is not None
    assert other.proven
    assert problem.energy(answer.mate).total == pytest.approx(problem.energy(other.mate).total, abs=1e-8)


def test_forbidden_transitions_are_kept() -> None:
    graph = flowers(np.random.default_rng(5), 7, 3, 0.3)
    free = solved_by_blocks(Problem(graph, WEIGHTS))
    assert free is not None
    forbidden = frozenset((a, b) for a, b in enumerate(free.mate) if a < b)
    assert forbidden
    answer = solved_by_blocks(Problem(graph, WEIGHTS, Rules(forbidden)))
    assert answer is not None
    best = best_by_trying(graph, WEIGHTS, lambda mate: all(mate[a] != b for a, b in forbidden))
    assert answer.lower_bound == pytest.approx(best, abs=1e-8)
    assert all(answer.mate[a] != b for a, b in forbidden)


def test_a_junction_of_many_segments_is_left_to_others() -> None:
    graph = flowers(np.random.default_rng(1), 40, 1, 0.0)
    assert max(map(len, graph.incident)) > 18
    assert solved_by_blocks(Problem(graph, WEIGHTS)) is None


def test_large_drawings_of_this_kind_are_proven_without_cuts() -> None:
    graph = largest_piece(cactus(np.random.default_rng(5000), 1500))
    assert certified(Problem(graph, WEIGHTS)).proven


def test_a_long_ring_with_thorns_is_proven() -> None:
    count = 400
    ends = [j for i in range(count) for j in (i, (i + 1) % count)]
    ends += [j for i in range(count) for j in (i, count + i)]
    angles = np.random.default_rng(0).uniform(0, 2 * np.pi, len(ends))
    tangents = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    answer = solved_by_blocks(Problem(Graph(tuple(ends), tangents, (1.0,) * (2 * count)), WEIGHTS))
    assert answer is not None
    assert answer.proven


def test_it_agrees_on_any_graph_that_it_takes() -> None:
    taken = 0
    for seed in range(150):
        rng = np.random.default_rng(seed)
        graph = largest_piece(random_multigraph(rng, int(rng.integers(3, 7)), int(rng.integers(4, 9))))
        answer = solved_by_blocks(Problem(graph, WEIGHTS))
        if answer is not None:
            taken += 1
            assert answer.lower_bound == pytest.approx(best_by_trying(graph, WEIGHTS), abs=1e-8)
    assert taken > 50
