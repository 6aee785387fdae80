"""The running energy of a matching that changes by local moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import FAMILIES, random_multigraph
from tests.decomposition.brute import energy_by_definition
from tests.decomposition.second_runs_judge import posed
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.local_moves.matching_state import Wires
from wrapit.decomposition.model import NO_MATE, Weights, half_edges
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import NO_RULES

WEIGHTS = Weights(0.1, 0.9, 0.1)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_running_energy_does_not_drift(family: str) -> None:
    rng = np.random.default_rng(5)
    graph = FAMILIES[family](rng, 60)
    wires = Wires(Problem(graph, WEIGHTS))
    taken = 0
    for a, pick in zip(rng.integers(2 * graph.segments, size=4000).tolist(), rng.random(4000), strict=True):
        if partners := wires.partners[a]:
            taken += wires.toggle(a, partners[int(pick * len(partners))], 0.8)
    assert taken > 500
    assert wires.energy == pytest.approx(energy_of(graph, wires.mate, WEIGHTS).total, abs=1e-9)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 10**6), segments=st.integers(2, 6))
def test_bridges_keep_the_running_energy_right(seed: int, segments: int) -> None:
    rng = np.random.default_rng(seed)
    plain = random_multigraph(rng, segments, 4)
    graph = type(plain)(plain.junction_of, plain.tangents, plain.lengths_mm, frozenset({0, segments - 1}))
    wires = Wires(Problem(graph, WEIGHTS))
    for a, pick in zip(rng.integers(2 * segments, size=300).tolist(), rng.random(300), strict=True):
        if partners := wires.partners[a]:
            wires.toggle(a, partners[int(pick * len(partners))], 2.0)
        if pick < 0.1:
            wires.drop(0, 2.0)
        expected = energy_by_definition(graph, wires.mate, WEIGHTS)
        assert wires.energy == pytest.approx(expected, abs=1e-9)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 10**6), bridged=st.booleans())
def test_second_runs_keep_the_running_energy_right(seed: int, bridged: bool) -> None:
    problem = posed(seed, 6, bridged=bridged)[0]
    problem = replace(problem, rules=NO_RULES)  # what a broken rule adds isn't energy
    graph, rng = problem.graph, np.random.default_rng(seed)
    wires = Wires(problem)
    for a, pick in zip(rng.integers(2 * graph.segments, size=200).tolist(), rng.random(200), strict=True):
        partners = wires.partners[a]
        if partners and pick < 0.7:
            wires.toggle(a, partners[int(pick / 0.7 * len(partners))], 2.0)
        elif wires.second_runs:
            e = wires.second_runs[a % len(wires.second_runs)]
            first, last = (wires.partners[h] for h in half_edges(e))
            if wires.mate[2 * e] != NO_MATE or wires.mate[2 * e + 1] != NO_MATE:
                wires.drop(e, 2.0)
            elif first and last:
                wires.use(2 * e, first[a % len(first)], 2 * e + 1, last[a % len(last)], 2.0)
        expected = energy_by_definition(graph, wires.mate, problem.weights)
        assert wires.energy == pytest.approx(expected, abs=1e-9)
