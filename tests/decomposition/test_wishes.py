"""Bridges, rules, symmetry and alternatives, against all matchings of small graphs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import all_even, random_multigraph
from tests.decomposition.brute import all_matchings, best_by_trying, energy_by_definition, wires_of
from wrapit.config.decomposition import AnnealingConfig
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import Rules
from wrapit.decomposition.symmetry import mirrored_junctions

WEIGHTS = Weights(0.1, 0.9, 0.1)
BUDGET = 2_000_000


def connected(seed: int, segments: int, junctions: int) -> Graph:
    graph = (all_even if seed % 3 == 0 else random_multigraph)(
        np.random.default_rng(seed), segments, junctions
    )
    return graph.subgraph(max(pieces(graph), key=len))


def some_rules(graph: Graph, rng: np.random.Generator) -> Rules:
    """A handful of wishes, which may well contradict one another."""
    pairs = [(a, b) for a, mates in enumerate(graph.bends_rad) for b in mates if a < b]
    segments = range(graph.segments)

    def pick(things: Sequence[object], chance: float) -> tuple[object, ...]:
        return tuple(thing for thing in things if rng.random() < chance / max(1, len(things)))

    couples = [(e, f) for e in segments for f in segments if e < f]
    longest = max(graph.lengths_mm) * rng.uniform(1.0, 2.5) if rng.random() < 0.4 else None
    return Rules(
        forbidden=frozenset(pick(pairs, 1.0)),
        required=tuple((pair,) for pair in pick(pairs, 0.5)),
        ends=pick([ends for ends in graph.incident if ends], 0.7),
        same=pick(couples, 0.6),
        apart=pick(couples, 0.6),
        longest_mm=longest,
    )


def obeys(graph: Graph, rules: Rules, mate: Sequence[int]) -> bool:
    """The rules by their definition."""
    wires = wires_of(graph, mate)
    assert wires is not None
    used = set().union(*wires)
    wire_of = {e: index for index, wire in enumerate(wires) for e in wire}
    return (
        all(mate[a] != b for a, b in rules.forbidden)
        and all(any(mate[a] == b for a, b in group) for group in rules.required)
        and all(any(mate[h] < 0 and h // 2 in used for h in ends) for ends in rules.ends)
        and all(e in used and wire_of[e] == wire_of.get(f) for e, f in rules.same)
        and all(wire_of.get(e, -1) != wire_of.get(f, -2) for e, f in rules.apart)
        and (
            rules.longest_mm is None
            or all(sum(graph.lengths_mm[e] for e in wire) <= rules.longest_mm + 1e-6 for wire in wires)
        )
    )


def with_some_bridges(graph: Graph, rng: np.random.Generator) -> Graph:
    """Up to two segments that join two junctions become bridges, as long as a stroke is left at each."""
    bridges: set[int] = set()
    for e in rng.permutation(graph.segments)[:2].tolist():
        ends = {graph.junction_of[2 * e], graph.junction_of[2 * e + 1]}
        strokes_stay = all(
            any(h // 2 != e and h // 2 not in bridges for h in graph.incident[j]) for j in ends
        )
        if len(ends) == 2 and strokes_stay:
            bridges.add(e)
    return replace(graph, bridges=frozenset(bridges))


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


def closed_up(graph: Graph, mate: Sequence[int]) -> frozenset[tuple[int, int]]:
    """The transitions with closed wires closed, which says what a decomposition looks like."""
    pairs = {(a, b) for a, b in enumerate(mate) if a < b}
    wires = wires_of(graph, mate)
    assert wires is not None
    for wire in wires:
        a, b = sorted(h for e in wire for h in (2 * e, 2 * e + 1) if mate[h] < 0)
        if graph.junction_of[a] == graph.junction_of[b] and a // 2 != b // 2:
            pairs.add((a, b))
    return frozenset(pairs)


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
