"""The best answer that uses given optional segments."""

from __future__ import annotations

import itertools
from itertools import islice

import numpy as np
import pytest

from tests.decomposition.brute import best_by_trying, energy_by_definition
from tests.decomposition.second_runs_judge import matchings, posed
from wrapit.decomposition.exact.chosen_segments import used_in, with_chosen
from wrapit.decomposition.model import NO_MATE


def test_no_answer_with_the_same_second_runs_is_better() -> None:
    cases = (posed(seed, 5, bridged=seed % 2 == 1)[0] for seed in itertools.count())
    best = 0
    for problem in islice((case for case in cases if matchings(case.graph) < 400), 40):
        graph, weights = problem.graph, problem.weights
        rng = np.random.default_rng(graph.segments)
        chosen = {e for e in sorted(graph.optional) if rng.random() < 0.5}
        mate = with_chosen(problem, chosen)
        used = used_in(problem, mate)
        assert used <= chosen
        assert all(mate[h] == NO_MATE for e in graph.optional - used for h in (2 * e, 2 * e + 1))
        energy = energy_by_definition(graph, mate, weights)
        assert energy is not None
        least = best_by_trying(graph, weights, lambda other, p=problem, used=used: used_in(p, other) == used)
        assert energy >= least - 1e-9
        best += energy == pytest.approx(least, abs=1e-9)
    assert best >= 36  # local reasoning alone proves nearly all
