"""Drawings as trees of blocks."""

from __future__ import annotations

import numpy as np

from tests.bench.graphs import cactus, closed_curves
from wrapit.decomposition.exact.cactus.blocks import as_cactus
from wrapit.decomposition.exact.cactus.stage import solved_by_blocks
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem

WEIGHTS = Weights(0.1, 0.9, 0.1)


def largest_piece(graph: Graph) -> Graph:
    return graph.subgraph(max(pieces(graph), key=len))


def test_blocks_hold_each_half_edge_once() -> None:
    graph = largest_piece(cactus(np.random.default_rng(2), 300))
    blocks = as_cactus(graph)
    assert blocks is not None
    for junction, ends in enumerate(graph.incident):
        here = [*blocks.doors[junction], *(h for block in blocks.hanging[junction] for h in block.doors)]
        assert sorted(here) == list(ends)
    assert sorted(blocks.order) == list(range(len(graph.incident)))


def test_rings_that_share_a_segment_are_left_to_others() -> None:
    assert as_cactus(largest_piece(closed_curves(np.random.default_rng(1), 40))) is None
    theta = Graph((0, 1, 0, 1, 0, 1), np.eye(2).repeat(3, axis=0), (1.0, 1.0, 1.0))
    assert solved_by_blocks(Problem(theta, WEIGHTS)) is None
