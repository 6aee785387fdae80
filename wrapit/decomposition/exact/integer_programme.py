"""The integer programme of a whole piece, with inequalities added as solutions break them.

Only junctions that appear in an inequality enter the programme; all others keep their locally best
matching, which is what the programme would choose for them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from wrapit.decomposition.exact.chosen_segments import used_in, with_chosen
from wrapit.decomposition.exact.cutting_planes import ring_cuts, rule_cuts, weak_cuts
from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.exact.other_answers import Others, exclusion_cuts
from wrapit.decomposition.exact.ring_bound import open_rings, ring_of
from wrapit.decomposition.graph import pieces
from wrapit.decomposition.local_moves.matching_state import descended
from wrapit.decomposition.model import NO_MATE, half_edges, ordered
from wrapit.decomposition.problem import CLOSE, Answer, Problem
from wrapit.decomposition.symmetry import mirrored_junctions
from wrapit.highs import Name, Optimum, Programme

# Up to this degree every three half-edges at a junction have their odd-set inequality from the start. On
# 145 graphs it makes no difference to what is proven; 0 to 10 take the same time to 10 %, 13 and more a
# tenth longer.
_ALL_TRIPLES_DEGREE = 10

# The first node takes longer the larger the programme is: as long as one more node for each so many columns.
_COLUMNS_OF_A_NODE = 50


def solve_by_cuts(
    problem: Problem, known: Answer, budget: int, others: Sequence[Sequence[int]] = ()
) -> Answer | None:
    """The best matching that differs from `others`, starting from what is known; None if there is none.

    `budget` limits the work, counted in columns × nodes of branch and bound over all rounds, so that
    the answer depends on nothing but the problem. Beyond it, the best matching so far is returned
    with the bound that was proved.
    """
    found = Others(problem.graph, others)
    model = _Model(problem, found)
    best = known.mate if _fits(problem, known.mate, found) else None
    least = problem.energy(best).total if best else float("inf")
    bound, rounds, spent = known.lower_bound or 0.0, known.iterations, 0
    while least - bound > CLOSE and spent < budget:
        rounds += 1
        programme, base = model.programme()
        columns = max(1, len(programme.columns))
        first = columns // _COLUMNS_OF_A_NODE
        optimum = programme.solve(max(1, (budget - spent) // columns - first))
        spent += columns * (max(1, optimum.nodes) + first)
        if not optimum.feasible:
            return None
        bound = max(bound, base + optimum.bound)
        if optimum.values is None:
            break
        mate = model.matching(optimum)
        for candidate in _repaired(problem, mate):
            if not _fits(problem, candidate, found):
                continue
            energy = problem.energy(candidate).total
            if energy < least - CLOSE:
                best, least = tuple(candidate), energy
        if not model.learn(mate):
            break
    if best is None:
        # Out of budget: what breaks a rule is for the caller to refuse, what repeats another is no answer.
        return None if others else Answer(known.mate, rounds, bound)
    return Answer(best, rounds, min(bound, least), least - bound <= CLOSE)


def _repaired(problem: Problem, mate: Sequence[int]) -> Iterator[list[int]]:
    repaired = list(mate)
    open_rings(problem.graph, LocalCosts(problem), repaired)
    yield repaired
    if problem.graph.second_runs:
        # Local moves take long where every line may be run along twice, and find less than this.
        yield with_chosen(problem, used_in(problem, mate))
    else:
        yield descended(problem, repaired)


def _fits(problem: Problem, mate: Sequence[int], found: Others) -> bool:
    return problem.is_allowed(mate) and not found.have(mate)


class _Model:
    """The inequalities so far, and the junctions that they are about."""

    def __init__(self, problem: Problem, found: Others) -> None:
        self._problem = problem
        self._graph = problem.graph
        self._costs = LocalCosts(problem)
        self._found = found
        self._cuts = list(found.cuts)
        self._paid: set[tuple[tuple[int, ...], int, int | None]] = set()
        self._active = self._ruled_junctions()

    def programme(self) -> tuple[Programme, float]:
        """The programme of the active junctions, and what all the rest costs."""
        graph, costs, weights = self._graph, self._costs, self._problem.weights
        programme = Programme()
        for junction in sorted(self._active):
            ends = graph.incident[junction]
            for a in ends:
                for b, cost in costs.pair[a].items():
                    if a < b:
                        programme.add_column((a, b), cost)
            for row, high in self._matching_rows(ends):
                programme.add_row(row, high=high)
        for e in sorted(graph.optional):
            self._add_optional(programme, e)
        self._add_rules(programme)
        for cut in self._cuts:
            broken: dict[Name, float] = dict(cut.transitions)
            broken |= {("used", e): coefficient for e, coefficient in cut.used.items()}
            if cut.weak:
                programme.add_column(("weak", *cut.weak), weights.robustness, whole=False)
                broken["weak", *cut.weak] = -1.0
            programme.add_row(broken, high=cut.limit)
        strokes = graph.segments - len(graph.optional)
        rest = sum(costs.best(j)[0] for j in range(len(graph.incident)) if j not in self._active)
        return programme, strokes + rest

    def matching(self, optimum: Optimum) -> list[int]:
        """The matching that a solution describes, rings and all."""
        mate = [NO_MATE] * (2 * self._graph.segments)
        for junction in range(len(self._graph.incident)):
            if junction not in self._active:
                for a, b in self._costs.best(junction)[1]:
                    mate[a], mate[b] = b, a
        assert optimum.values is not None
        for name, value in optimum.values.items():
            if isinstance(name[0], int) and value > 0.5:
                a, b = name
                mate[a], mate[b] = b, a
        return mate

    def learn(self, mate: Sequence[int]) -> bool:
        """Adds the inequalities that a matching breaks; says whether there were any."""
        cuts = [*ring_cuts(self._graph, mate), *rule_cuts(self._problem, mate)]
        if not ring_of(mate)[1]:
            cuts += weak_cuts(self._problem, mate, self._paid)
            if self._found.have(mate):
                cuts += exclusion_cuts(self._graph, mate)
        for cut in cuts:
            self._active |= {self._graph.junction_of[a] for a, _ in cut.transitions}
        self._cuts += cuts
        return bool(cuts)

    def _matching_rows(self, ends: Sequence[int]) -> Iterator[tuple[dict[Name, float], float]]:
        """Each half-edge has one mate at most; of an odd set of half-edges, one stays without."""
        pair = self._costs.pair
        for h in ends:
            row: dict[Name, float] = {ordered(h, b): 1.0 for b in pair[h]}
            optional = h >> 1 in self._graph.optional
            if optional:
                row["used", h >> 1] = -1.0
            yield row, 0.0 if optional else 1.0
        odd = [three for three in combinations(ends, 3) if len(ends) <= _ALL_TRIPLES_DEGREE]
        for some in [*odd, *([ends] if len(ends) % 2 and len(ends) > 3 else [])]:
            yield dict.fromkeys(combinations(sorted(some), 2), 1.0), float(len(some) // 2)
        yield from self._odd_rows(ends)

    def _odd_rows(self, ends: Sequence[int]) -> Iterator[tuple[dict[Name, float], float]]:
        """Where an odd number of half-edges is in use, one stays without a mate."""
        optional = [h for h in ends if h >> 1 in self._graph.optional]
        if not optional:
            return
        certain = len(ends) - len(optional)
        for counted in [()] if certain % 2 else [(h,) for h in optional]:
            row: dict[Name, float] = dict.fromkeys(combinations(sorted(ends), 2), 1.0)
            for h in optional:
                if h not in counted:
                    row["used", h >> 1] = row.get(("used", h >> 1), 0.0) - 1.0
            yield row, float((certain + len(counted)) // 2)

    def _add_optional(self, programme: Programme, e: int) -> None:
        """What is optional counts as one more wire and its own price as soon as it joins something."""
        pair = self._costs.pair
        programme.add_column(("used", e), 1.0 + self._problem.price(e))
        row: dict[Name, float] = {ordered(h, b): -1.0 for h in half_edges(e) for b in pair[h]}
        programme.add_row({**row, ("used", e): 1.0}, high=0.0)

    def _add_rules(self, programme: Programme) -> None:
        graph, rules, pair = self._graph, self._problem.rules, self._costs.pair
        if rules.most_wires is not None:
            for piece in pieces(graph):
                inside = [h for e in piece for h in half_edges(e)]
                row: dict[Name, float] = {(a, b): -1.0 for a in inside for b in pair[a] if a < b}
                row |= {("used", e): 1.0 for e in piece if e in graph.optional}
                strokes = sum(e not in graph.optional for e in piece)
                programme.add_row(row, high=float(rules.most_wires - strokes))
        for group in rules.required:
            programme.add_row(dict.fromkeys(group, 1.0), low=1.0)
        for ends in rules.ends:
            row = {(a, b): 2.0 for a in ends for b in pair[a] if a < b}
            row |= {("used", h >> 1): -1.0 for h in ends if h >> 1 in graph.optional}
            programme.add_row(row, high=sum(h >> 1 not in graph.optional for h in ends) - 1.0)
        for v, _ in mirrored_junctions(graph, self._problem.mirror):
            programme.add_column(("unlike", v), self._problem.weights.symmetry, whole=False)
            self._add_likeness(programme, v)
        for e, f in rules.apart:
            # A height for each segment, the same along a wire: 0 on one of the two, 1 on the other.
            for segment in range(graph.segments):
                programme.add_column(("height", e, f, segment), 0.0, whole=False)
            programme.add_row({("height", e, f, e): 1.0}, high=0.0)
            programme.add_row({("height", e, f, f): 1.0}, low=1.0)
            for a, mates in enumerate(pair):
                for b in mates:
                    level = {("height", e, f, a >> 1): 1.0, ("height", e, f, b >> 1): -1.0}
                    programme.add_row({**level, ordered(a, b): 1.0}, high=1.0)

    def _add_likeness(self, programme: Programme, junction: int) -> None:
        mirror = self._problem.mirror
        for a in self._graph.incident[junction]:
            for b in self._costs.pair[a]:
                image = ordered(mirror[a], mirror[b])
                if a < b and image != (a, b):
                    for sign in (1.0, -1.0):
                        programme.add_row({(a, b): sign, image: -sign, ("unlike", junction): -1.0}, high=0.0)

    def _ruled_junctions(self) -> set[int]:
        graph, rules = self._graph, self._problem.rules
        if rules.apart or self._cuts or rules.most_wires is not None:
            return set(range(len(graph.incident)))
        optional = {graph.junction_of[h] for e in graph.optional for h in half_edges(e)}
        ended = {graph.junction_of[ends[0]] for ends in rules.ends}
        required = {graph.junction_of[a] for group in rules.required for a, _ in group}
        mirrored = {j for pair in mirrored_junctions(graph, self._problem.mirror) for j in pair}
        return mirrored | optional | required | ended
