"""The trails of a matching."""

from __future__ import annotations

import pytest

from tests.decomposition.drawings import cross, drawing_of
from wrapit.decomposition.energy import energy_of, weak_trails
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.model import Traversal, Weights
from wrapit.decomposition.trails import trails_of, transitions_of

WEIGHTS = Weights(0.1, 0.9, 0.1)


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
