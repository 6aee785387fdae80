"""The state of a local search: a matching that changes by one local move and keeps its energy."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wrapit.decomposition.local_moves.branches import smallest_branches
from wrapit.decomposition.model import NO_MATE, half_edges, ordered
from wrapit.decomposition.problem import CLOSE, Problem
from wrapit.decomposition.rules import NO_RULES, broken
from wrapit.decomposition.symmetry import is_unlike, mirrored_junctions

# Energy that a broken rule costs: more than a move can save. On 118 small graphs with rules that can be
# kept, a short annealing kept them in 84 / 101 / 113 / 117 with 1 / 2 / 3 / 5, and in all with 10 to 100.
_PENALTY = 20.0


def descended(problem: Problem, mate: Sequence[int]) -> list[int]:
    """The matching after local moves for as long as one lowers the energy."""
    wires = Wires(problem, mate)
    improved = True
    while improved:
        improved = False
        for a, partners in enumerate(wires.partners):
            for b in partners:
                if a < b and wires.toggle(a, b, -CLOSE):
                    improved = True
    return wires.mate


class Wires:
    """Wires that grow and shrink, starting with one per stroke and nothing optional unless `mate` says so.

    `mate` is always a valid matching without rings; `energy` follows it. Rules that it breaks add to
    the energy, each more than any move can save; forbidden transitions are never made.
    """

    def __init__(self, problem: Problem, mate: Sequence[int] | None = None) -> None:
        graph, weights = problem.graph, problem.weights
        self.mate = list(mate) if mate is not None else [NO_MATE] * (2 * graph.segments)
        start = problem.energy(self.mate)
        self._problem = problem
        self._ruled = problem.rules != NO_RULES or bool(problem.mirror)
        self._mirrored = [graph.incident[v] for v, _ in mirrored_junctions(graph, problem.mirror)]
        self._extra = self._extra_cost()
        self._weak = start.robustness
        self.energy = start.total + self._extra - weights.symmetry * start.asymmetry
        self.bridges = sorted(graph.bridges)
        self.second_runs = sorted(graph.second_runs)
        self._graph = graph
        self._weak_cost = weights.robustness
        self._cost = {e: 1.0 + problem.price(e) for e in graph.optional}
        # What a transition saves: one wire, less its bend.
        self._saved = [
            {
                b: 1.0 - weights.smoothness * bend
                for b, bend in bends.items()
                if ordered(a, b) not in problem.rules.forbidden
            }
            for a, bends in enumerate(graph.bends_rad)
        ]
        self.partners = [list(saved) for saved in self._saved]
        self._smallest = smallest_branches(graph)
        self._closing: set[tuple[int, int]] = set()
        self._fragile = weights.robustness > 0 and (
            bool(graph.optional) or any(size < graph.segments for size in self._smallest)
        )

    def toggle(self, a: int, b: int, budget: float) -> bool:
        """Makes a–b a transition or undoes it, if that costs at most `budget`; says whether it did."""
        if self.mate[a] == b:
            return self._apply([(a, NO_MATE), (b, NO_MATE)], self._saved[a][b], budget)
        return self._apply(*self._transition(a, b), budget)

    def use(self, a: int, b: int, c: int, d: int, budget: float) -> bool:
        """Makes a–b and c–d transitions at once, if that costs at most `budget`: both ends of a bridge."""
        first, second = self._transition(a, b), self._transition(c, d)
        return self._apply(first[0] + second[0], first[1] + second[1], budget)

    def drop(self, optional: int, budget: float) -> bool:
        """Takes a bridge or a second run out of use, if it is in use and that costs at most `budget`."""
        mate, saved = self.mate, self._saved
        changes: list[tuple[int, int]] = []
        delta = 0.0
        for h in half_edges(optional):
            if (other := mate[h]) != NO_MATE:
                changes += [(h, NO_MATE), (other, NO_MATE)]
                delta += saved[h][other]
        return bool(changes) and self._apply(changes, delta, budget)

    def _transition(self, a: int, b: int) -> tuple[list[tuple[int, int]], float]:
        """Mates and cost of making a–b a transition.

        Where a and b pass into c and d, c–d is paired as well: two wires, or one with itself,
        exchange their tails.
        """
        mate, saved = self.mate, self._saved
        c, d = mate[a], mate[b]
        changes = [(a, b), (b, a)]
        delta = -saved[a][b]
        if c != NO_MATE:
            delta += saved[a][c]
        if d != NO_MATE:
            delta += saved[b][d]
        if NO_MATE not in (c, d) and d in saved[c]:
            changes += [(c, d), (d, c)]
            delta -= saved[c][d]
        else:
            changes += [(h, NO_MATE) for h in (c, d) if h != NO_MATE]
        return changes, delta

    def _apply(self, changes: list[tuple[int, int]], delta: float, budget: float) -> bool:
        mate, fragile = self.mate, self._fragile
        touched: Iterable[int] = [h for h, _ in changes]
        optional = self._graph.optional
        toggled: list[int] = []
        if optional and (near := {h >> 1 for h in touched} & optional):
            toggled = sorted(near)
            delta -= sum(self._cost[e] for e in toggled if self._in_use(e))
        elif delta - self._weak_cost * min(2, self._weak) - self._extra > budget:
            return False
        if toggled:
            # What comes into use touches wires that the move itself leaves alone.
            touched = self._around(touched, toggled)
        weak_before = self._weak_wires(touched) if fragile else 0
        if not toggled and delta - self._weak_cost * weak_before - self._extra > budget:
            return False
        before = [(h, mate[h]) for h, _ in changes]
        for h, other in changes:
            mate[h] = other
        if toggled:
            delta += sum(self._cost[e] for e in toggled if self._in_use(e))
        if not self._closes_ring(changes):
            mended = weak_before - (self._weak_wires(touched) if fragile else 0)
            delta -= self._weak_cost * mended
            extra = self._extra_cost() if self._ruled else 0.0
            delta += extra - self._extra
            if delta <= budget:
                self.energy += delta
                self._weak -= mended
                self._extra = extra
                self._closing.clear()
                return True
        for h, other in before:
            mate[h] = other
        return False

    def _extra_cost(self) -> float:
        problem = self._problem
        unlike = sum(is_unlike(ends, problem.mirror, self.mate) for ends in self._mirrored)
        return _PENALTY * broken(problem.graph, problem.rules, self.mate) + problem.weights.symmetry * unlike

    def _in_use(self, optional: int) -> bool:
        start, end = half_edges(optional)
        return self.mate[start] != NO_MATE or self.mate[end] != NO_MATE

    def _around(self, touched: Iterable[int], toggled: Iterable[int]) -> list[int]:
        junction_of, incident = self._graph.junction_of, self._graph.incident
        junctions = {junction_of[h] for e in toggled for h in half_edges(e)}
        return [*touched, *(h for junction in sorted(junctions) for h in incident[junction])]

    def _closes_ring(self, changes: list[tuple[int, int]]) -> bool:
        # The two ends of one long wire are proposed again and again: don't walk it each time.
        if changes[0] in self._closing:
            return True
        closes = any(self._on_ring(h) for h, other in changes if h < other)
        if closes and len(changes) == 2:
            self._closing.update(changes)
        return closes

    def _on_ring(self, h: int) -> bool:
        mate = self.mate
        other, x = mate[h], h ^ 1
        while x != other:
            x = mate[x]
            if x < 0:
                return False
            x ^= 1
        return True

    def _weak_wires(self, touched: Iterable[int]) -> int:
        """Number of weak wires among those that run through the half-edges."""
        mate, smallest = self.mate, self._smallest
        weak = 0
        seen: set[int] = set()
        for h in touched:
            segments, x = [h >> 1], h ^ 1
            while (m := mate[x]) >= 0:
                segments.append(m >> 1)
                x = m ^ 1
            y = h
            while (m := mate[y]) >= 0:
                segments.append(m >> 1)
                y = m ^ 1
            key = x if x < y else y
            if key in seen:
                continue
            seen.add(key)
            if len(segments) >= smallest[h >> 1]:
                weak += self._hangs(segments)
        return weak

    def _hangs(self, segments: list[int]) -> bool:
        """Whether the wire along these segments touches others at one junction exactly."""
        if len(segments) == 1 and segments[0] in self._graph.optional and not self._in_use(segments[0]):
            return False
        junction_of, incident = self._graph.junction_of, self._graph.incident
        counts: dict[int, int] = {}
        for e in segments:
            for h in half_edges(e):
                junction = junction_of[h]
                counts[junction] = counts.get(junction, 0) + 1
        optional = self._graph.optional
        contacts = 0
        for junction, count in counts.items():
            present = len(incident[junction])
            if optional:
                present -= sum(h >> 1 in optional and not self._in_use(h >> 1) for h in incident[junction])
            contacts += count < present
            if contacts > 1:
                return False
        return contacts == 1
