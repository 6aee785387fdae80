"""The energy and the trails of a matching."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.bench.graphs import random_multigraph
from tests.decomposition.brute import all_matchings, energy_by_definition
from tests.decomposition.drawings import cross, drawing_of, theta
from wrapit.decomposition.energy import energy_of, weak_trails
from wrapit.decomposition.graph import fewest_possible_wires, graph_of
from wrapit.decomposition.model import Traversal, Weights
from wrapit.decomposition.trails import trails_of, transitions_of

WEIGHTS = Weights(0.1, 0.9, 0.1)


def test_a_straight_crossing_costs_no_bend_and_a_right_angle_half_a_turn() -> None:
    graph = graph_of(cross())
    assert graph.bends_rad[0][2] == pytest.approx(0.0)
    assert graph.bends_rad[0][4] == pytest.approx(math.pi / 2)
    assert graph.bends_rad[0][6] == pytest.approx(math.pi / 2)  # left and right cost the same
    straight = energy_of(graph, (2, -1, 0, -1, 6, -1, 4, -1), WEIGHTS)
    assert (straight.complexity, straight.robustness) == (2, 2)
    assert straight.smoothness_rad == pytest.approx(0.0)
    assert straight.total == pytest.approx(2 + 1.8)


def test_a_single_wire_is_never_weak_even_in_a_drawing_of_two_pieces() -> None:
    one = graph_of(drawing_of([(0, 0), (1, 0), (5, 5), (6, 5)], [(0, 1), (2, 3)]))
    energy = energy_of(one, (-1,) * 4, WEIGHTS)
    assert (energy.complexity, energy.robustness) == (2, 0)
    assert fewest_possible_wires(one) == 2


def test_fewest_possible_wires_counts_odd_junctions() -> None:
    assert fewest_possible_wires(graph_of(cross())) == 2
    assert fewest_possible_wires(graph_of(theta())) == 1


def test_trails_run_longest_first_and_closed_ones_say_so() -> None:
    square = drawing_of([(0, 0), (9, 0), (9, 9), (0, 9), (20, 0)], [(1, 4), (0, 1), (1, 2), (2, 3), (3, 0)])
    graph = graph_of(square)
    mate = [-1] * 10
    for a, b in ((5, 6), (7, 8), (9, 2)):
        mate[a], mate[b] = b, a
    trails = trails_of(graph, mate)
    assert [trail.closed for trail in trails] == [True, False]
    assert trails[0].traversals == (
        Traversal(1, True), Traversal(4, True), Traversal(3, True), Traversal(2, True),
    )  # fmt: skip
    assert weak_trails(graph, trails) == [0, 1]
    assert [t.junction for t in transitions_of(graph, mate)] == [0, 2, 3]


@pytest.mark.parametrize(
    ("mate", "message"),
    [
        ([2, -1, -1, -1, -1, -1, -1, -1], "doesn't continue into it"),
        ([3, -1, -1, 0, -1, -1, -1, -1], "can't continue"),
        ([-1] * 6, "mates"),
    ],
)
def test_what_is_no_matching_is_refused(mate: list[int], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        trails_of(graph_of(cross()), mate)


def test_a_ring_is_refused() -> None:
    graph = graph_of(drawing_of([(0, 0), (1, 0)], [(0, 1), (1, 0)]))
    with pytest.raises(ValueError, match="ring"):
        energy_of(graph, (3, 2, 1, 0), WEIGHTS)


@given(seed=st.integers(0, 10**6), segments=st.integers(1, 5), junctions=st.integers(1, 5))
def test_the_energy_is_the_definition(seed: int, segments: int, junctions: int) -> None:
    rng = np.random.default_rng(seed)
    graph = random_multigraph(rng, segments, junctions)
    matchings = [list(mate) for mate in all_matchings(graph)]
    for index in rng.integers(len(matchings), size=5):
        mate = matchings[index]
        expected = energy_by_definition(graph, mate, WEIGHTS)
        if expected is None:
            with pytest.raises(ValueError, match="ring"):
                energy_of(graph, mate, WEIGHTS)
        else:
            assert energy_of(graph, mate, WEIGHTS).total == pytest.approx(expected, abs=1e-12)
