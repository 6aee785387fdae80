"""The proven optimum: local matchings, a spanning tree, and integer programming for what is left."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.exact.chosen_segments import with_chosen
from wrapit.decomposition.exact.postman import least_second_runs
from wrapit.decomposition.graph import pieces
from wrapit.decomposition.problem import CLOSE, Answer, Problem
from wrapit.decomposition.rules import contradict


def _improved(problem: Problem, known: Answer, most_wires: int) -> Answer:
    """What is known, or what the postman's second runs give if that is allowed and better."""
    used: set[int] = set()
    least = 0.0
    for piece in pieces(problem.graph):
        chosen, price = least_second_runs(problem.part(piece), most_wires)
        used |= {piece[e] for e in chosen}
        least += 1.0 + price
    mate = tuple(with_chosen(problem, used))
    bound = max(known.lower_bound or 0.0, least)
    if problem.is_allowed(known.mate) and problem.energy(known.mate).total <= problem.energy(mate).total:
        mate = known.mate
    return Answer(mate, known.iterations, bound, problem.energy(mate).total - bound < CLOSE)


def solve_exactly(problem: Problem, budget: int, others: Sequence[Sequence[int]] = ()) -> Answer | None:
    """The best matching of one connected piece that differs from `others`, with the bound that proves it.

    None where the rules can't be met, or where there is no other. `budget` limits the work of integer
    programming, which starts where local reasoning ends.
    """
    if contradict(problem.graph, problem.rules):
        return None
    known = certified(problem)
    if known.proven and problem.is_allowed(known.mate) and not others:
        return known
    if problem.graph.optional and problem.rules.most_wires is not None:
        known = _improved(problem, known, problem.rules.most_wires)
    # Loads scipy's optimisers, which takes longer than most drawings.
    from wrapit.decomposition.exact.integer_programme import solve_by_cuts

    return solve_by_cuts(problem, known, budget, others)
