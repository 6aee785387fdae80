"""What opening the rings costs at least, against all matchings."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.decomposition.brute import best_by_trying, wires_of
from tests.decomposition.cases import connected
from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.exact.ring_bound import certify, open_rings, ring_of
from wrapit.decomposition.exact.spanning_trees import GROUND, Link, by_share, cheapest_opening, spanning_tree
from wrapit.decomposition.model import NO_MATE, Weights
from wrapit.decomposition.problem import Problem

SMOOTH = Weights(0.1, 0.0, 0.1)
SMALL = {"seed": st.integers(0, 10**9), "segments": st.integers(1, 6), "junctions": st.integers(2, 6)}


@settings(deadline=None, max_examples=120)
@given(**SMALL)
def test_the_bound_is_below_every_matching_and_the_answer_is_one(
    seed: int, segments: int, junctions: int
) -> None:
    graph = connected(seed, segments, junctions)
    certificate = certify(graph, LocalCosts(Problem(graph, SMOOTH)))
    best = best_by_trying(graph, SMOOTH)
    assert graph.segments + certificate.bound <= best + 1e-9
    assert wires_of(graph, certificate.mate) is not None
    assert Problem(graph, SMOOTH).energy(certificate.mate).total >= best - 1e-9


@settings(deadline=None, max_examples=80)
@given(**SMALL)
def test_any_rings_can_be_opened(seed: int, segments: int, junctions: int) -> None:
    graph = connected(seed, segments, junctions)
    mate = [NO_MATE] * (2 * graph.segments)
    for a, bends in enumerate(graph.bends_rad):  # whatever comes first, rings and all
        free = [b for b in bends if mate[b] == NO_MATE]
        if mate[a] == NO_MATE and free:
            mate[a], mate[free[0]] = free[0], a
    open_rings(graph, LocalCosts(Problem(graph, SMOOTH)), mate)
    assert ring_of(mate)[1] == 0
    assert wires_of(graph, mate) is not None


def link(loss: float, junction: int, *groups: tuple[int, ...]) -> Link:
    return Link(loss, junction, None, groups)


def test_a_link_that_does_the_work_of_two_counts_half_for_each() -> None:
    links = by_share([link(1.0, 0, (1, 2, 3)), link(0.4, 1, (GROUND, 1)), link(0.6, 2, (2, 3))])
    weight, tree = spanning_tree(links, 3)
    assert weight == pytest.approx(0.4 + 0.5 + 0.5)
    assert [(branch.u, branch.w) for branch in tree] == [(GROUND, 1), (1, 2), (1, 3)]


@settings(deadline=None, max_examples=200)
@given(
    rings=st.integers(1, 5),
    chords=st.lists(st.tuples(st.integers(0, 5), st.integers(1, 5), st.floats(0, 9)), max_size=12),
    losses=st.lists(st.floats(0, 9), min_size=5, max_size=5),
)
def test_the_cheapest_opening_is_the_cheapest_of_all_that_are_tried(
    rings: int, chords: list[tuple[int, int, float]], losses: list[float]
) -> None:
    links = [link(losses[r - 1], r, (GROUND, r)) for r in range(1, rings + 1)]
    links += [
        link(loss, 10 + i, (min(a, b), max(a, b)))
        for i, (a, b, loss) in enumerate(chords)
        if a != b and max(a, b) <= rings
    ]
    links = by_share(links)
    bound, opening, _ = cheapest_opening(links, rings)
    tried = min(
        each.loss + spanning_tree(links, rings, each)[0] for each in links if each.groups[0][0] == GROUND
    )
    assert math.isclose(bound, tried, abs_tol=1e-9)
    assert opening.groups[0][0] == GROUND
