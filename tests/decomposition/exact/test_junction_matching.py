"""The best matching at one junction."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Weights
from wrapit.decomposition.problem import Problem

BUDGET = 2_000_000


@pytest.mark.parametrize("degree", [3, 6, 9, 16])
def test_a_star_is_matched_best_at_any_degree(degree: int) -> None:
    angles = np.sort(np.random.default_rng(degree).uniform(0, 2 * np.pi, degree))
    tangents = np.repeat(np.stack([np.cos(angles), np.sin(angles)], axis=1), 2, axis=0)
    tangents[1::2] *= -1
    star = Graph(tuple(j for e in range(degree) for j in (0, e + 1)), tangents, (1.0,) * degree)
    answer = solve_exactly(Problem(star, Weights(0.1, 0.0)), BUDGET)
    found = energy_of(star, answer.mate, Weights(0.1, 0.0))
    assert found.complexity == (degree + 1) // 2
    assert answer.lower_bound == pytest.approx(found.total)
    if degree <= 9:
        least, _ = min(LocalCosts(Problem(star, Weights(0.1, 0.0))).matchings(0))
        assert found.total == pytest.approx(degree + least)


@settings(deadline=None, max_examples=120)
@given(seed=st.integers(0, 10**9), degree=st.integers(2, 8))
def test_lists_and_subsets_agree_with_costs_of_hanging_wires(seed: int, degree: int) -> None:
    rng = np.random.default_rng(seed)
    angles = rng.uniform(0, 2 * np.pi, 2 * degree)
    star = Graph(
        tuple(j for e in range(degree) for j in (0, e + 1)),
        np.stack([np.cos(angles), np.sin(angles)], axis=1),
        (1.0,) * degree,
    )
    costs = LocalCosts(Problem(star, Weights(0.1, 0.9)))
    for h in star.incident[0]:
        if rng.random() < 0.5:
            costs.penalise_end(h, 0.9)
    costs.penalise_ends(star.incident[0][0], star.incident[0][1], 0.9)
    costs.penalise_pair(star.incident[0][0], star.incident[0][-1], 0.9)
    listed = sorted(cost for cost, _ in costs.matchings(0))
    least, pairs = costs.best(0)
    assert least == pytest.approx(listed[0])
    mate = [NO_MATE] * (2 * degree)
    for a, b in pairs:
        mate[a], mate[b] = b, a
    assert costs.cost(0, mate) == pytest.approx(least)
    assert costs.is_best(0, mate)
    assert costs.second_loss(0) == pytest.approx(listed[1] - listed[0])
