"""The proven optimum: local matchings, a spanning tree, and integer programming for what is left."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.problem import Answer, Problem


def solve_exactly(problem: Problem, budget: int, others: Sequence[Sequence[int]] = ()) -> Answer | None:
    """The best matching of one connected piece that differs from `others`, with the bound that proves it.

    None where the rules can't be met, or where there is no other. `budget` limits the work of integer
    programming, which starts where local reasoning ends.
    """
    known = certified(problem)
    if known.proven and problem.is_allowed(known.mate) and not others:
        return known
    # Loads scipy's optimisers, which takes longer than most drawings.
    from wrapit.decomposition.exact.integer_programme import solve_by_cuts

    return solve_by_cuts(problem, known, budget, others)
