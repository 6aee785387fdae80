"""What has to be run along twice for one wire, against another way to find it."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from tests.bench.graphs import FAMILIES, random_multigraph
from wrapit.decomposition.exact.postman import least_second_runs
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import Rules
from wrapit.decomposition.second_runs import with_second_runs

LENGTHS_ALONE = Weights(smoothness=0.0, robustness=0.0, doubling=1.0)


def drawn(seed: int) -> Graph:
    """One piece of a generated graph: any multigraph, or one of a family."""
    rng = np.random.default_rng(seed)
    makes = [lambda rng, n: random_multigraph(rng, n, max(2, n // 2)), *FAMILIES.values()]
    graph = makes[seed % len(makes)](rng, int(rng.integers(4, 15)))
    return graph.subgraph(max(pieces(graph), key=len))


def open_route_mm(graph: Graph) -> float:
    """The least length that an open route along everything runs along again (open Chinese postman).

    For each two places where it may start and end, odd junctions and those two change parity: what has to
    be odd then is joined in pairs along shortest ways, by a matching of minimum weight.
    """
    import networkx as nx

    network = nx.MultiGraph()
    for e, length_mm in enumerate(graph.lengths_mm):
        network.add_edge(graph.junction_of[2 * e], graph.junction_of[2 * e + 1], weight=length_mm)
    odd = {j for j, degree in network.degree if degree % 2}
    far = dict(nx.all_pairs_dijkstra_path_length(network))
    least = float("inf")
    for ends in [(), *combinations(sorted(network), 2)]:
        closure = nx.Graph()
        joined = odd.symmetric_difference(ends)
        closure.add_weighted_edges_from((a, b, far[a][b]) for a, b in combinations(sorted(joined), 2))
        pairs = nx.min_weight_matching(closure)
        least = min(least, sum(far[a][b] for a, b in pairs))
    return least


@pytest.mark.parametrize("seed", range(30))
def test_one_wire_runs_along_no_more_twice_than_the_postman(seed: int) -> None:
    plain = drawn(seed)
    mean_mm = sum(plain.lengths_mm) / plain.segments
    least = open_route_mm(plain) / mean_mm
    problem = Problem(with_second_runs(plain), LENGTHS_ALONE, Rules(most_wires=1))
    answer = solve_exactly(problem, 10_000_000)
    assert answer is not None
    energy = problem.energy(answer.mate)
    assert (energy.complexity, energy.doubling) == (1, pytest.approx(least, abs=1e-9))
    assert answer.lower_bound == pytest.approx(1 + least, abs=1e-9)
    used, price = least_second_runs(problem, 1)
    assert price == pytest.approx(least, abs=1e-9)
    ends = [plain.junction_of[h] for e in range(plain.segments) for h in (2 * e, 2 * e + 1)]
    ends += [problem.graph.junction_of[h] for e in used for h in (2 * e, 2 * e + 1)]
    assert sum(ends.count(j) % 2 for j in set(ends)) <= 2
