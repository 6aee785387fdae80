"""The operator `double`: second runs taken into use and out of it."""

from __future__ import annotations

import itertools
from itertools import islice

import numpy as np
import pytest

from tests.decomposition.brute import energy_by_definition
from tests.decomposition.second_runs_judge import posed
from wrapit.config.decomposition import AnnealingConfig
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.exact.stage import solve_exactly

SHORT = AnnealingConfig(temperature=30.0, cooling=5e-3, end_temperature=1e-2)


@pytest.mark.parametrize("bridged", [False, True])
def test_annealing_keeps_to_so_many_wires_and_is_never_better_than_the_proof(bridged: bool) -> None:
    limited = (posed(seed, 4, bridged=bridged)[0] for seed in itertools.count() if seed % 4 < 3)
    kept = best = 0
    for seed, problem in enumerate(islice(limited, 24)):
        proven = solve_exactly(problem, 10_000_000)
        assert proven is not None
        least = problem.energy(proven.mate).total
        mate = anneal(problem, SHORT, np.random.default_rng(seed)).mate
        energy = energy_by_definition(problem.graph, mate, problem.weights)
        assert energy is not None
        if problem.is_allowed(mate):
            kept += 1
            best += energy < least + 1e-6
            assert energy >= least - 1e-9
    assert kept >= 22
    assert best >= 18
