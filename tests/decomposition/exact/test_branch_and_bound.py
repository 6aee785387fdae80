"""What local reasoning proves by itself."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.graphs import all_even, random_multigraph
from tests.decomposition.brute import best_by_trying, energy_by_definition
from tests.decomposition.exact.test_stage import whole_pieces
from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem

WEIGHTS = Weights(0.1, 0.9, 0.1)


@settings(deadline=None, max_examples=150)
@given(
    seed=st.integers(0, 10**9), segments=st.integers(1, 6), junctions=st.integers(1, 6), even=st.booleans()
)
def test_what_local_reasoning_proves_is_true(seed: int, segments: int, junctions: int, even: bool) -> None:
    if segments == 6 and junctions == 1:
        junctions = 2
    graph = (all_even if even else random_multigraph)(np.random.default_rng(seed), segments, junctions)
    for piece in whole_pieces(graph):
        answer = certified(Problem(piece, WEIGHTS))
        best = best_by_trying(piece, WEIGHTS)
        assert answer.lower_bound is not None
        assert answer.lower_bound <= best + 1e-9
        assert energy_by_definition(piece, answer.mate, WEIGHTS) >= best - 1e-9
