"""Weak wires that one junction decides: what hangs there and would be alone.

A weak wire fills branches that only one junction v joins to the rest. Where the best matchings
inside a branch make one single trail of it, v decides whether that trail stays alone. Either it
does, which costs the weight of a weak wire, or a matching inside the branch gives way, which costs
its loss: the lesser of the two becomes part of the costs at v. That settles the inside of the
branch; its losses may not be counted again.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.problem import CLOSE
from wrapit.decomposition.trails import walk


class Pendants:
    """The branches of one connected piece that are known to hang, as costs at their junctions."""

    def __init__(self, graph: Graph, costs: LocalCosts, weak_cost: float) -> None:
        self._graph, self._costs, self._weak_cost = graph, costs, weak_cost
        self._known: set[tuple[tuple[int, ...], ...]] = set()
        self._settled: set[int] = set()
        self._undecided: dict[tuple[tuple[int, ...], ...], tuple[int, ...]] = {}
        self.strange: list[tuple[list[int], int]] = []
        """Weak wires met last that no cost at one junction can stand for, each with its junction."""
        for ends in graph.incident:
            self._add_single_segments(ends)

    def learn(self, mate: Sequence[int], weak: Iterable[tuple[int, int]]) -> bool:
        """Adds weak wires, each given by a wire end and its one junction; says whether one was new."""
        self.strange = []
        added = [self._add(mate, walk(mate, start), junction) for start, junction in weak]
        return any(added)

    def undecided(self) -> tuple[int, ...] | None:
        """The inside of a branch that may give way at less than the weight of a weak wire.

        Fixing or changing its matchings makes things clear.
        """
        return min(self._undecided.values(), key=lambda inside: (len(inside), inside), default=None)

    def _add_single_segments(self, ends: Sequence[int]) -> None:
        """Leaves and loops are branches by themselves, unless they are the whole piece."""
        here = set(ends)
        leaves = [h for h in ends if len(self._graph.incident[self._graph.junction_of[h ^ 1]]) == 1]
        if len(ends) > 1:
            for h in leaves:
                self._charge([(h,)], self._weak_cost)
        if len(ends) > 2:
            for h in ends:
                if h ^ 1 in here and h < h ^ 1:
                    self._charge([(h, h ^ 1)], self._weak_cost)
            for i, a in enumerate(leaves):
                for b in leaves[i + 1 :]:
                    if b in self._costs.pair[a]:
                        self._charge([(a,), (b,)], self._weak_cost)

    def _add(self, mate: Sequence[int], steps: Sequence[int], junction: int) -> bool:
        junction_of = self._graph.junction_of
        branches = self._split(steps, junction)
        doors = [
            tuple(h for h in (branch[0], branch[-1] ^ 1) if junction_of[h] == junction) for branch in branches
        ]
        if tuple(doors) in self._known:
            return False
        inside = {junction_of[h] for step in steps for h in (step, step ^ 1)} - {junction}
        if (
            junction in self._settled
            or sum(map(len, doors)) > 2
            or not all(self._fills(branch, junction) for branch in branches)
            or not all(self._costs.is_best(j, mate) for j in inside)
        ):
            self.strange.append((list(steps), junction))
            return False
        cost = min([self._weak_cost, *(self._costs.second_loss(j) for j in sorted(inside))])
        if cost < self._weak_cost - CLOSE:
            self._undecided[tuple(doors)] = tuple(sorted(inside))
        if cost < CLOSE:
            self._known.add(tuple(doors))
            return False
        self._charge(doors, cost)
        self._settled |= inside
        return True

    def _charge(self, doors: list[tuple[int, ...]], cost: float) -> None:
        """Charges what leaves branches alone, each given by the half-edges that lead into it."""
        self._known.add(tuple(doors))
        match doors:
            case [(h,)]:
                self._costs.penalise_end(h, cost)
            case [(h, other)]:
                self._costs.penalise_ends(h, other, cost)
            case [(a,), (b,)]:
                self._costs.penalise_pair(a, b, cost)

    def _split(self, steps: Sequence[int], junction: int) -> list[list[int]]:
        """The parts of a walk between its visits to a junction."""
        parts: list[list[int]] = [[]]
        for step in steps:
            if self._graph.junction_of[step] == junction and parts[-1]:
                parts.append([])
            parts[-1].append(step)
        return parts

    def _fills(self, branch: Sequence[int], junction: int) -> bool:
        """Whether nothing else meets the branch but at the junction."""
        inside = {step >> 1 for step in branch}
        junction_of, incident = self._graph.junction_of, self._graph.incident
        visited = {junction_of[h] for step in branch for h in (step, step ^ 1)} - {junction}
        return all(h >> 1 in inside for j in visited for h in incident[j])
