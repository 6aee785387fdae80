"""The proven optimum: local matchings, a spanning tree, and integer programming for what is left."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from wrapit.decomposition.certificate import certify
from wrapit.decomposition.energy import contacts_of
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.local import LocalCosts
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.pendants import Pendants
from wrapit.decomposition.problem import Answer, Problem
from wrapit.decomposition.trails import trails_of

_CLOSE = 1e-9


def solve_exactly(problem: Problem, budget: int, others: Sequence[Sequence[int]] = ()) -> Answer | None:
    """The best matching of one connected piece that differs from `others`, with the bound that proves it.

    None where the rules can't be met, or where there is no other. `budget` limits the work of integer
    programming, which starts where local reasoning ends.
    """
    known = certified(problem)
    gap = problem.energy(known.mate).total - (known.lower_bound or 0.0)
    if gap < _CLOSE and problem.is_allowed(known.mate) and not others:
        return known
    # Loads scipy's optimisers, which takes longer than most drawings.
    from wrapit.decomposition.milp import solve_by_cuts

    return solve_by_cuts(problem, known, budget, others)


def certified(problem: Problem) -> Answer:
    """What local reasoning finds and proves, with no bridge in use and no rule but forbidden transitions.

    Rules can only raise the energy, so the bound holds with them; bridges may lower it, so where
    there are any, the bound is none.
    """
    graph = problem.graph
    if graph.bridges:
        return Answer((NO_MATE,) * (2 * graph.segments), 0, None)
    costs = LocalCosts(problem)
    pendants = Pendants(graph, costs, problem.weights.robustness)
    best: tuple[int, ...] = ()
    least, bound, rounds = float("inf"), 0.0, 0
    while True:
        rounds += 1
        certificate = certify(graph, costs)
        bound = max(bound, graph.segments + certificate.bound)
        energy = problem.energy(certificate.mate).total
        if energy < least - _CLOSE:
            best, least = tuple(certificate.mate), energy
        learned = least - bound > _CLOSE and pendants.learn(certificate.mate, _weak(graph, certificate.mate))
        if not learned:
            return Answer(best, rounds, min(bound, least))


def _weak(graph: Graph, mate: Sequence[int]) -> Iterator[tuple[int, int]]:
    """A wire end and the one contact of each weak wire."""
    trails = trails_of(graph, mate)
    for trail, contacts in zip(trails, contacts_of(graph, trails), strict=True):
        if len(contacts) == 1:
            first = trail.traversals[0]
            yield 2 * first.segment + first.reversed, next(iter(contacts))
