"""Bridges, rules, symmetry and alternatives, against all matchings of small graphs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.decomposition.brute import all_matchings, best_by_trying, energy_by_definition
from tests.decomposition.cases import closed_up, connected, obeys, some_rules, with_some_bridges
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.symmetry import mirrored_junctions

WEIGHTS = Weights(0.1, 0.9, 0.1)
BUDGET = 2_000_000


@settings(deadline=None, max_examples=70)
@given(
    seed=st.integers(0, 10**9),
    segments=st.integers(2, 6),
    junctions=st.integers(2, 6),
    robustness=st.sampled_from([0.9, 1.5]),
)
def test_bridges_are_used_where_they_pay(seed: int, segments: int, junctions: int, robustness: float) -> None:
    weights = Weights(0.1, robustness, 0.1)
    graph = with_some_bridges(connected(seed, segments, junctions), np.random.default_rng(seed))
    answer = solve_exactly(Problem(graph, weights), BUDGET)
    assert answer is not None
    best = best_by_trying(graph, weights)
    assert energy_by_definition(graph, answer.mate, weights) == pytest.approx(best, abs=1e-8)
    assert answer.lower_bound == pytest.approx(best, abs=1e-8)


@settings(deadline=None, max_examples=100)
@given(
    seed=st.integers(0, 10**9),
    segments=st.integers(2, 6),
    junctions=st.integers(2, 6),
    bridged=st.booleans(),
)
def test_rules_are_obeyed_at_the_least_cost(seed: int, segments: int, junctions: int, bridged: bool) -> None:
    rng = np.random.default_rng(seed)
    graph = connected(seed, segments, junctions)
    if bridged:
        graph = with_some_bridges(graph, rng)
    rules = some_rules(graph, rng)
    answer = solve_exactly(Problem(graph, WEIGHTS, rules), BUDGET)
    best = best_by_trying(graph, WEIGHTS, lambda mate: obeys(graph, rules, mate))
    if math.isinf(best):
        assert answer is None
    else:
        assert answer is not None
        assert obeys(graph, rules, answer.mate)
        assert energy_by_definition(graph, answer.mate, WEIGHTS) == pytest.approx(best, abs=1e-8)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 10**9), segments=st.integers(1, 5), junctions=st.integers(2, 5))
def test_alternatives_come_in_order_and_miss_none(seed: int, segments: int, junctions: int) -> None:
    graph = connected(seed, segments, junctions)
    problem = Problem(graph, WEIGHTS)
    kinds: dict[frozenset[tuple[int, int]], float] = {}
    for mate in all_matchings(graph):
        energy = energy_by_definition(graph, mate, WEIGHTS)
        if energy is not None:
            kind = closed_up(graph, mate)
            kinds[kind] = min(energy, kinds.get(kind, math.inf))
    expected = sorted(kinds.values())[:4]
    found: list[tuple[int, ...]] = []
    while len(found) < 4 and (answer := solve_exactly(problem, BUDGET, found)) is not None:
        found.append(answer.mate)
    energies = [energy_by_definition(graph, mate, WEIGHTS) for mate in found]
    assert energies == pytest.approx(expected, abs=1e-8)
    assert len({closed_up(graph, mate) for mate in found}) == len(found)


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 10**9), segments=st.integers(1, 3), junctions=st.integers(2, 4))
def test_mirrored_halves_are_treated_alike(seed: int, segments: int, junctions: int) -> None:
    """Two copies of a graph that share one junction; the image of each half-edge is its copy."""
    half = connected(seed, segments, junctions)
    shift, count = len(half.incident), 2 * half.segments
    graph = Graph(
        half.junction_of + tuple(j + shift if j else 0 for j in half.junction_of),
        np.concatenate([half.tangents, half.tangents * [-1, 1]]),
        half.lengths_mm * 2,
    )
    if len(pieces(graph)) > 1:
        return
    graph = graph.subgraph(range(graph.segments))
    mirror = tuple(h + count if h < count else h - count for h in range(2 * count))
    weights = replace(WEIGHTS, symmetry=0.3)
    problem = Problem(graph, weights, mirror=mirror)
    pairs = mirrored_junctions(graph, mirror)

    def cost(mate: Sequence[int]) -> float:
        energy = energy_by_definition(graph, mate, weights)
        unlike = 0
        for v, _ in pairs:
            here = {frozenset((mirror[h], mirror[mate[h]])) for h in graph.incident[v] if mate[h] >= 0}
            there = {
                frozenset((mirror[h], mate[mirror[h]])) for h in graph.incident[v] if mate[mirror[h]] >= 0
            }
            unlike += here != there
        return math.inf if energy is None else energy + 0.3 * unlike

    best = min(cost(mate) for mate in all_matchings(graph))
    answer = solve_exactly(problem, BUDGET)
    assert answer is not None
    assert cost(answer.mate) == pytest.approx(best, abs=1e-8)
    assert problem.energy(answer.mate).total == pytest.approx(best, abs=1e-8)
