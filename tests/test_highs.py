"""The integer programmes that HiGHS solves."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest

from tests.bench.graphs import random_multigraph
from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.highs import silent_stdout

WEIGHTS = Weights(0.1, 0.9, 0.1)
BUDGET = 2_000_000


def test_integer_programming_prints_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    graph = random_multigraph(np.random.default_rng(28), 14, 7)
    graph = graph.subgraph(max(pieces(graph), key=len))
    answer = solve_exactly(Problem(graph, WEIGHTS), BUDGET)
    library = ctypes.CDLL(None)
    with silent_stdout():
        library.puts(b"HiGHS says something")
    library.fflush(None)
    assert answer is not None
    assert not certified(Problem(graph, WEIGHTS)).proven  # else this tests nothing
    assert answer.proven
    out, err = capfd.readouterr()
    assert (out, err) == ("", "")
