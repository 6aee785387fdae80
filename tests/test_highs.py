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
from wrapit.highs import Programme, silent_stdout

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


def test_a_programme_that_grew_is_the_programme_built_at_once() -> None:
    """Rows may name columns that come later: what an earlier solution took from them is not kept."""
    grown, whole = Programme(), Programme()
    grown.add_column(("a",), 1.0)
    row = {("a",): 1.0, ("b",): 1.0}
    grown.add_row(row, low=1.0)
    assert grown.solve(100).values == {("a",): 1.0}
    grown.add_row({("a",): 1.0}, high=0.5)
    assert not grown.solve(100).feasible
    for each in (grown, whole):
        each.add_column(("a",), 1.0)
        each.add_column(("b",), 0.5)
    whole.add_row(row, low=1.0)
    whole.add_row({("a",): 1.0}, high=0.5)
    assert grown.solve(100).values == whole.solve(100).values == {("a",): 0.0, ("b",): 1.0}
