"""What solvers see of a drawing."""

from __future__ import annotations

from tests.decomposition.drawings import cross, theta
from wrapit.decomposition.graph import fewest_possible_wires, graph_of


def test_fewest_possible_wires_counts_odd_junctions() -> None:
    assert fewest_possible_wires(graph_of(cross())) == 2
    assert fewest_possible_wires(graph_of(theta())) == 1
