"""How small a weak wire can be."""

from __future__ import annotations

import numpy as np

from tests.bench.graphs import random_multigraph
from tests.decomposition.brute import all_matchings, energy_by_definition
from wrapit.decomposition.energy import weak_trails
from wrapit.decomposition.local_moves.branches import smallest_branches
from wrapit.decomposition.model import Weights
from wrapit.decomposition.trails import trails_of

WEIGHTS = Weights(0.1, 0.9, 0.1)


def test_no_weak_wire_is_shorter_than_its_smallest_branch() -> None:
    rng = np.random.default_rng(3)
    weak = 0
    for _ in range(60):
        graph = random_multigraph(rng, 5, 4)
        smallest = smallest_branches(graph)
        for mate in all_matchings(graph):
            if energy_by_definition(graph, mate, WEIGHTS) is None:
                continue
            trails = trails_of(graph, mate)
            for index in weak_trails(graph, trails):
                weak += 1
                run = trails[index].traversals
                assert all(len(run) >= smallest[t.segment] for t in run)
    assert weak > 1000
