"""Each inequality is broken by the matching that it comes from, and kept by every one that it must allow."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.decomposition.brute import all_matchings, wires_of
from tests.decomposition.cases import closed_up, connected, obeys, some_rules, with_some_bridges
from tests.decomposition.second_runs_judge import grants, matchings, posed
from wrapit.decomposition.energy import contacts_of
from wrapit.decomposition.exact.cutting_planes import Cut, exclusion_cut, ring_cuts, rule_cuts, weak_cuts
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Weights, half_edges
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import broken
from wrapit.decomposition.trails import trails_of

WEIGHTS = Weights(0.1, 0.9, 0.1)
SMALL = {"seed": st.integers(0, 10**9), "segments": st.integers(2, 5), "junctions": st.integers(1, 5)}


def excess(cut: Cut, graph: Graph, mate: Sequence[int]) -> float:
    """How far a matching breaks an inequality, with the variables at what they stand for."""
    return excess_at(cut, mate) - (cut.weak in weak_wires(graph, mate))


def excess_at(cut: Cut, mate: Sequence[int]) -> float:
    """The same, where weak wires don't count."""
    left = sum(cut.transitions.get((a, b), 0.0) for a, b in enumerate(mate) if a < b)
    left += sum(c for e, c in cut.used.items() if any(mate[h] >= 0 for h in half_edges(e)))
    return left - cut.limit


def weak_wires(graph: Graph, mate: Sequence[int]) -> set[tuple[tuple[int, ...], int]]:
    trails = trails_of(graph, mate)
    return {
        (tuple(sorted(t.segment for t in trail.traversals)), next(iter(contacts)))
        for trail, contacts in zip(trails, contacts_of(graph, trails), strict=True)
        if len(contacts) == 1
    }


def some_matchings(graph: Graph, seed: int) -> tuple[list[list[int]], list[list[int]]]:
    """Matchings with rings and without, forty of each at most."""
    ringed: list[list[int]] = []
    free: list[list[int]] = []
    for mate in all_matchings(graph):
        (free if wires_of(graph, mate) is not None else ringed).append(list(mate))
    rng = np.random.default_rng(seed)
    pick = lambda group: [group[i] for i in rng.permutation(len(group))[:40]]  # noqa: E731
    return pick(ringed), pick(free)


def left_of(cut: Cut, mate: Sequence[int]) -> float:
    return sum(cut.transitions.get((a, b), 0.0) for a, b in enumerate(mate) if a < b) - cut.limit


@settings(deadline=None, max_examples=80)
@given(**SMALL)
def test_rings_are_cut_off_and_nothing_else(seed: int, segments: int, junctions: int) -> None:
    graph = connected(seed, segments, junctions)
    ringed, free = some_matchings(graph, seed)
    for mate in ringed[:10]:
        for cut in ring_cuts(graph, mate):
            assert left_of(cut, mate) > 1e-9
            assert all(excess(cut, graph, other) <= 1e-9 for other in free)
    assert all(not list(ring_cuts(graph, mate)) for mate in free[:5])


@settings(deadline=None, max_examples=80)
@given(**SMALL, bridged=st.booleans())
def test_a_weak_wire_has_to_be_paid_and_no_other(
    seed: int, segments: int, junctions: int, bridged: bool
) -> None:
    graph = connected(seed, segments, junctions)
    if bridged:
        graph = with_some_bridges(graph, np.random.default_rng(seed))
    _, free = some_matchings(graph, seed)
    for mate in free[:10]:
        weak = weak_wires(graph, mate)
        cuts = list(weak_cuts(Problem(graph, WEIGHTS), mate, set()))
        assert {cut.weak for cut in cuts} == weak
        for cut in cuts:
            assert excess(cut, graph, mate) == pytest.approx(0.0)  # paid for; unpaid it is broken by one
            assert all(excess(cut, graph, other) <= 1e-9 for other in free)


@settings(deadline=None, max_examples=80)
@given(**SMALL, bridged=st.booleans())
def test_what_keeps_the_rules_is_never_cut_off(
    seed: int, segments: int, junctions: int, bridged: bool
) -> None:
    rng = np.random.default_rng(seed)
    graph = connected(seed, segments, junctions)
    if bridged:
        graph = with_some_bridges(graph, rng)
    rules = some_rules(graph, rng)
    _, free = some_matchings(graph, seed)
    for mate in free[:10]:
        for cut in rule_cuts(Problem(graph, WEIGHTS, rules), mate):
            assert excess(cut, graph, mate) > 1e-9
            assert all(excess(cut, graph, other) <= 1e-9 for other in free if obeys(graph, rules, other))


@pytest.mark.parametrize("bridged", [False, True])
def test_what_is_as_wished_with_second_runs_is_never_cut_off(bridged: bool) -> None:
    cases = (posed(seed, 4, bridged=bridged, wished=True) for seed in itertools.count())
    few = ((problem, wishes) for problem, wishes in cases if wishes and matchings(problem.graph) < 800)
    cut = 0
    for number, (problem, wishes) in enumerate(itertools.islice(few, 60)):
        graph = problem.graph
        ringed, free = some_matchings(graph, number)
        wished = [mate for mate in free if grants(graph, wishes, None, mate)]
        assert all(broken(graph, replace(problem.rules, most_wires=None), mate) == 0 for mate in wished)
        for mate in [*free[:10], *ringed[:10]]:
            for each in [*ring_cuts(graph, mate), *(rule_cuts(problem, mate) if mate in free else [])]:
                cut += 1
                assert excess_at(each, mate) > 1e-9
                assert all(excess_at(each, other) <= 1e-9 for other in wished)
    assert cut > 100


@settings(deadline=None, max_examples=60)
@given(**SMALL)
def test_a_matching_is_excluded_wherever_its_closed_wires_are_open(
    seed: int, segments: int, junctions: int
) -> None:
    graph = connected(seed, segments, junctions)
    _, free = some_matchings(graph, seed)
    for mate in free[:6]:
        cut = exclusion_cut(graph, mate)
        for other in free:
            same = closed_up(graph, other) == closed_up(graph, mate)
            assert (excess(cut, graph, other) > 1e-9) == same
