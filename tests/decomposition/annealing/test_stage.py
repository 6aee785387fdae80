"""The paper's Algorithm 1."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import FAMILIES, all_even, random_multigraph
from tests.decomposition.brute import best_by_trying, energy_by_definition
from tests.decomposition.cases import connected, obeys, some_rules, with_some_bridges
from wrapit.config.decomposition import AnnealingConfig
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem

WEIGHTS = Weights(0.1, 0.9, 0.1)
SHORT = AnnealingConfig(temperature=3.0, cooling=2e-3, end_temperature=1e-3)


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 10**6), segments=st.integers(1, 6), even=st.booleans())
def test_small_graphs_are_solved_for_good(seed: int, segments: int, even: bool) -> None:
    rng = np.random.default_rng(seed)
    graph = (all_even if even else random_multigraph)(rng, segments, 3)
    answer = anneal(Problem(graph, WEIGHTS), SHORT, rng)
    found = energy_of(graph, answer.mate, WEIGHTS).total
    best = best_by_trying(graph, WEIGHTS)
    assert found >= best - 1e-9
    assert found <= best + 0.35  # a short schedule may miss some bend, never a wire


def test_the_paper_schedule_takes_138149_steps_and_the_seed_decides() -> None:
    graph = FAMILIES["strokes"](np.random.default_rng(1), 12)
    problem = Problem(graph, WEIGHTS)
    first, again, other = (
        anneal(problem, AnnealingConfig(), np.random.default_rng(seed)) for seed in (1, 1, 2)
    )
    assert first.iterations == 138149
    assert first == again
    assert energy_of(graph, other.mate, WEIGHTS).total == pytest.approx(
        energy_of(graph, first.mate, WEIGHTS).total, abs=0.2
    )


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10**9), segments=st.integers(2, 5), junctions=st.integers(2, 5))
def test_annealing_obeys_rules_too(seed: int, segments: int, junctions: int) -> None:
    rng = np.random.default_rng(seed)
    graph = connected(seed, segments, junctions)
    rules = some_rules(graph, rng)
    best = best_by_trying(graph, WEIGHTS, lambda mate: obeys(graph, rules, mate))
    schedule = AnnealingConfig(temperature=30.0, cooling=2e-3, end_temperature=1e-2)
    answer = anneal(Problem(graph, WEIGHTS, rules), schedule, rng)
    if not math.isinf(best):
        assert obeys(graph, rules, answer.mate)


def test_annealing_finds_bridges() -> None:
    found = 0
    for seed in range(12):
        graph = with_some_bridges(connected(seed, 6, 5), np.random.default_rng(seed))
        best = best_by_trying(graph, WEIGHTS)
        schedule = AnnealingConfig(temperature=5.0, cooling=1e-3, end_temperature=1e-3)
        answer = anneal(Problem(graph, WEIGHTS), schedule, np.random.default_rng(1))
        energy = energy_by_definition(graph, answer.mate, WEIGHTS)
        assert energy is not None
        assert energy >= best - 1e-9
        found += energy < best + 1e-6
    assert found >= 10
