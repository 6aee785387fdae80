"""Proof by cases: local reasoning, and a few alternatives where it can't decide about a hanging wire."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from wrapit.decomposition.energy import contacts_of
from wrapit.decomposition.exact.cactus.stage import solved_by_blocks
from wrapit.decomposition.exact.hanging import Pendants
from wrapit.decomposition.exact.junction_matching import ENUMERATED_DEGREE, LocalCosts, matchings_of
from wrapit.decomposition.exact.ring_bound import certify
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.problem import CLOSE, Answer, Problem
from wrapit.decomposition.trails import trails_of

# Segments × rounds of local reasoning before integer programming takes over. Of 120 sparse multigraphs (40
# to 150 segments, nearly as many junctions) that has to decide 31 / 5 / 2 / 1 with 0 / 2000 / 4200 to 7800
# / 20 000.
_WORK = 6_000


def certified(problem: Problem) -> Answer:
    """What local reasoning finds and proves, with nothing optional in use, no rule but forbidden transitions.

    Drawings whose rings share no segment are solved block by block. In others, where local reasoning
    can't account for a wire that hangs, all cases are tried: that wire stays, or one of the junctions
    that it runs through is passed in another way. Rules can only raise the energy, so the
    bound holds with them. Where something is optional, what hangs is left out of the bound.
    """
    graph = problem.graph
    if graph.optional:
        return _with_optional(problem)
    if (answer := solved_by_blocks(problem)) is not None:
        return answer
    root = _reasoned(problem, _Case())
    assert root is not None
    best, rounds = root, root.rounds
    numbers = count()
    cases = [(root.bound, next(numbers), root)]
    while cases and cases[0][0] < best.energy - CLOSE and rounds * graph.segments < _WORK:
        parent = heapq.heappop(cases)[2]
        parts = list(_parted(graph, parent))
        if not parts:
            heapq.heappush(cases, (parent.bound, next(numbers), parent))
            break
        for part in parts:
            found = _reasoned(problem, part)
            if found is not None:
                rounds += found.rounds
                heapq.heappush(cases, (max(found.bound, parent.bound), next(numbers), found))
                best = min(best, found, key=lambda found: found.energy)
    bound = min(best.energy, cases[0][0] if cases else math.inf)
    return Answer(best.mate, rounds, bound, best.energy - bound < CLOSE)


def _with_optional(problem: Problem) -> Answer:
    """Local matchings and a spanning tree, with the price of what is optional shared by its two ends.

    Used at one end only it then counts half, and wires that hang not at all: so much lower is the bound.
    """
    graph = problem.graph
    certificate = certify(graph, LocalCosts(problem, with_prices=True))
    bound = graph.segments - len(graph.optional) + certificate.bound
    energy = problem.energy(certificate.mate).total
    return Answer(tuple(certificate.mate), 1, min(bound, energy), energy - bound < CLOSE)


@dataclass(frozen=True)
class _Case:
    """Restrictions: `allowed` matchings of some junctions, and weak wires that they leave no way around."""

    allowed: Mapping[int, frozenset[int]] = field(default_factory=dict)
    weak: frozenset[frozenset[int]] = frozenset()


@dataclass(frozen=True, eq=False)
class _Found:
    """What local reasoning says about a case; `last` is the matching that leaves `strange` wires."""

    case: _Case
    bound: float
    energy: float
    mate: tuple[int, ...]
    rounds: int
    costs: LocalCosts
    last: Sequence[int]
    undecided: tuple[int, ...] | None
    strange: tuple[tuple[list[int], int], ...]


def _reasoned(problem: Problem, case: _Case) -> _Found | None:
    """Local matchings, spanning tree and hanging branches; None where nothing is allowed."""
    graph, weak_cost = problem.graph, problem.weights.robustness
    costs = LocalCosts(problem, case.allowed)
    if any(costs.best(junction)[0] == math.inf for junction in case.allowed):
        return None
    pendants = Pendants(graph, costs, weak_cost)
    best: tuple[int, ...] = ()
    last: Sequence[int] = ()
    least, bound, rounds, learned = math.inf, 0.0, 0, True
    while learned:
        rounds += 1
        certificate = certify(graph, costs)
        last = certificate.mate
        bound = max(bound, graph.segments + certificate.bound + weak_cost * len(case.weak))
        energy = problem.energy(last).total
        if energy < least - CLOSE:
            best, least = tuple(last), energy
        learned = least - bound > CLOSE and pendants.learn(last, _weak(graph, last))
    strange = tuple(
        (steps, v) for steps, v in pendants.strange if frozenset(step >> 1 for step in steps) not in case.weak
    )
    return _Found(case, bound, least, best, rounds, costs, last, pendants.undecided(), strange)


def _parted(graph: Graph, found: _Found) -> Iterator[_Case]:
    """All that a case allows, in parts that each say more about one hanging wire; nothing if that fails."""

    def listable(junctions: Iterable[int]) -> bool:
        return all(len(graph.incident[j]) <= ENUMERATED_DEGREE for j in junctions)

    if found.undecided is not None and listable(found.undecided):
        wanted = {j: {_index(graph, found.last, j)} for j in found.undecided}
        yield from _split(found, wanted, found.case.weak)
        return
    for steps, v in sorted(found.strange, key=lambda wire: (len(wire[0]), wire[0])):
        inside = {step >> 1 for step in steps}
        junctions = {graph.junction_of[h] for step in steps for h in (step, step ^ 1)}
        if listable(junctions):
            wanted = {j: {_index(graph, found.last, j)} for j in sorted(junctions - {v})}
            wanted[v] = _agreeing(graph, found.last, v, inside)
            parts = list(_split(found, wanted, found.case.weak | {frozenset(inside)}))
            if parts:
                yield from parts
                return


def _split(found: _Found, wanted: Mapping[int, set[int]], weak: frozenset[frozenset[int]]) -> Iterator[_Case]:
    """First junction by junction what isn't wanted there, then all that is wanted, with its weak wires."""
    kept = dict(found.case.allowed)
    parts = []
    for junction, indices in wanted.items():
        everything = kept.get(junction, frozenset(range(len(found.costs.listed(junction)))))
        if not indices & everything:
            return
        if others := everything - indices:
            parts.append(_Case({**kept, junction: others}, found.case.weak))
        kept[junction] = everything & indices
    if parts or weak != found.case.weak:
        yield from parts
        yield _Case(kept, weak)


def _index(graph: Graph, mate: Sequence[int], junction: int) -> int:
    """Which of `matchings_of(degree)` a matching has at a junction."""
    ends = graph.incident[junction]
    pairs = tuple((i, ends.index(mate[h])) for i, h in enumerate(ends) if h < mate[h])
    return matchings_of(len(ends)).index(pairs)


def _agreeing(graph: Graph, mate: Sequence[int], junction: int, inside: set[int]) -> set[int]:
    """The matchings at a junction that do the same to the ends of some segments."""
    ends = graph.incident[junction]
    spots = {i for i, h in enumerate(ends) if h >> 1 in inside}
    now = {(i, ends.index(mate[ends[i]])) if mate[ends[i]] != NO_MATE else (i, i) for i in spots}
    agreeing = set()
    for index, pairs in enumerate(matchings_of(len(ends))):
        partner = dict(pairs) | {j: i for i, j in pairs}
        if {(i, partner.get(i, i)) for i in spots} == now:
            agreeing.add(index)
    return agreeing


def _weak(graph: Graph, mate: Sequence[int]) -> Iterator[tuple[int, int]]:
    """A wire end and the one contact of each weak wire."""
    trails = trails_of(graph, mate)
    for trail, contacts in zip(trails, contacts_of(graph, trails), strict=True):
        if len(contacts) == 1:
            yield trail.traversals[0].departure, next(iter(contacts))
