"""The energy of a matching, against its definition."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.bench.graphs import random_multigraph
from tests.decomposition.brute import all_matchings, energy_by_definition
from tests.decomposition.drawings import cross, drawing_of
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.graph import fewest_possible_wires, graph_of
from wrapit.decomposition.model import Weights

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
