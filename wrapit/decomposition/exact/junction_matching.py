"""The best matching at one junction, taken by itself.

Junctions decide almost everything: a transition saves one wire and costs its bend, whatever happens
elsewhere. Summed over the junctions, the best matchings are a lower bound on the energy.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import cache

from wrapit.decomposition.model import NO_MATE, Pair, ordered
from wrapit.decomposition.problem import Problem

Matching = tuple[Pair, ...]

ENUMERATED_DEGREE = 8
"""Up to this degree all matchings at a junction are listed (764 of them), where more than the best is asked.

With 6 / 7 / 8 / 9 local reasoning leaves 46 / 42 / 37 / 30 of 145 graphs to integer programming, in the
same time to 6 % all told; at 9 there are 2620 matchings.
"""

# How the best matching is found: up to the first degree among all of them, up to the second by subsets,
# beyond by integer programming. On those 145 graphs the first makes no difference from 3 to 7; the second
# none from 10 to 15, but at 18 the subsets take twice the time of everything else.
_QUICK_DEGREE = 5
_SOLVED_DEGREE = 15


@cache
def matchings_of(degree: int) -> tuple[Matching, ...]:
    """Every matching of 0 … degree − 1, as sorted pairs; the empty one first.

    >>> matchings_of(3)
    ((), ((1, 2),), ((0, 1),), ((0, 2),))
    """

    def extended(left: Matching, rest: tuple[int, ...]) -> Iterator[Matching]:
        if not rest:
            yield left
            return
        i, others = rest[0], rest[1:]
        yield from extended(left, others)
        for j in others:
            yield from extended((*left, (i, j)), tuple(k for k in others if k != j))

    return tuple(extended((), tuple(range(degree))))


class LocalCosts:
    """What each matching at a junction costs; weak wires that are known to hang there included.

    `pair[a][b]` is the cost of the transition a–b, `free[h]` that of a wire end at h, and
    `loose[h]`, for h the lower of two half-edges, that of two wire ends at both. Junctions in
    `allowed` have no other matchings than those of `matchings_of(degree)` with these indices. With prices,
    the costs of all junctions add up to no more than those of any matching, optional segments included.
    """

    def __init__(
        self,
        problem: Problem,
        allowed: Mapping[int, frozenset[int]] | None = None,
        *,
        with_prices: bool = False,
    ) -> None:
        self._allowed = allowed or {}
        graph, weights = problem.graph, problem.weights
        self.incident = graph.incident
        # Where prices count here, half of what an optional segment costs is paid at either end.
        half = [0.0] * (2 * graph.segments)
        for e in graph.optional if with_prices else ():
            half[2 * e] = half[2 * e + 1] = (1.0 + problem.price(e)) / 2
        self.pair = [
            {b: weights.smoothness * bend - 1.0 + half[a] + half[b] for b, bend in bends.items()}
            for a, bends in enumerate(graph.bends_rad)
        ]
        for a, b in problem.rules.forbidden:
            self.pair[a].pop(b, None)
            self.pair[b].pop(a, None)
        self.free = [0.0] * (2 * graph.segments)
        self.loose: dict[int, tuple[int, float]] = {}
        self._junction_of = graph.junction_of
        self._listed: dict[int, list[float]] = {}
        self._best: dict[int, tuple[float, Matching]] = {}

    def best(self, junction: int) -> tuple[float, Matching]:
        """Least cost at a junction and a matching that has it."""
        if junction not in self._best:
            ends = self.incident[junction]
            if len(ends) <= _QUICK_DEGREE or junction in self._allowed:
                costs = self.listed(junction)
                index = min(range(len(costs)), key=costs.__getitem__)
                self._best[junction] = (costs[index], self.matching(junction, index))
            elif len(ends) <= _SOLVED_DEGREE:
                self._best[junction] = self._by_subsets(ends)
            else:
                self._best[junction] = self._by_integers(ends)
        return self._best[junction]

    def cost(self, junction: int, mate: Sequence[int]) -> float:
        """Cost of what `mate` does at a junction."""
        cost = 0.0
        for h in self.incident[junction]:
            other = mate[h]
            if other == NO_MATE:
                cost += self.free[h]
                tied, both = self.loose.get(h, (h, 0.0))
                if tied != h and mate[tied] == NO_MATE:
                    cost += both
            elif h < other:
                cost += self.pair[h][other]
        return cost

    def is_best(self, junction: int, mate: Sequence[int]) -> bool:
        """Whether `mate` does the locally best thing at a junction."""
        pairs = tuple((h, mate[h]) for h in self.incident[junction] if h < mate[h])
        return pairs == self.best(junction)[1]

    def matchings(self, junction: int) -> Iterator[tuple[float, Matching]]:
        """Every matching at a junction with its cost."""
        for index, cost in enumerate(self.listed(junction)):
            if cost < math.inf:
                yield cost, self.matching(junction, index)

    def matching(self, junction: int, index: int) -> Matching:
        """The half-edges of one of `matchings_of(degree)` at a junction."""
        ends = self.incident[junction]
        return tuple((ends[i], ends[j]) for i, j in matchings_of(len(ends))[index])

    def penalise_end(self, h: int, cost: float) -> None:
        """A wire end at h costs `cost` more, because a wire would hang there."""
        self.free[h] += cost
        self._forget(h)

    def penalise_ends(self, h: int, other: int, cost: float) -> None:
        """Wire ends at both half-edges cost `cost` more."""
        low, high = ordered(h, other)
        self.loose[low] = (high, self.loose.get(low, (high, 0.0))[1] + cost)
        self._forget(h)

    def penalise_pair(self, a: int, b: int, cost: float) -> None:
        """The transition a–b costs `cost` more."""
        self.pair[a][b] += cost
        self.pair[b][a] += cost
        self._forget(a)

    def second_loss(self, junction: int) -> float:
        """How much more than the best any other matching at a junction costs."""
        least, chosen = self.best(junction)
        ends = self.incident[junction]
        if len(ends) <= ENUMERATED_DEGREE:
            others = (cost for cost, pairs in self.matchings(junction) if pairs != chosen)
            return min(others, default=math.inf) - least
        if len(ends) > _SOLVED_DEGREE:
            return 0.0
        left = [h for h in ends if all(h not in pair for pair in chosen)]
        added = [
            self.pair[a][b] - self.free[a] - self.free[b] for a in left for b in left if b in self.pair[a]
        ]
        without = [self._by_subsets(ends, pair)[0] - least for pair in chosen]
        return max(0.0, min([*added, *without], default=math.inf))

    def _forget(self, h: int) -> None:
        self._best.pop(self._junction_of[h], None)
        self._listed.pop(self._junction_of[h], None)

    def listed(self, junction: int) -> list[float]:
        """Cost of each of `matchings_of(degree)` at a junction, infinite where forbidden."""
        if junction not in self._listed:
            ends, pair, free = self.incident[junction], self.pair, self.free
            base = sum(free[h] for h in ends)
            gain = [[pair[a].get(b, math.inf) - free[a] - free[b] for b in ends] for a in ends]
            costs = [base + sum(gain[i][j] for i, j in pairs) for pairs in matchings_of(len(ends))]
            for h in ends:
                if h in self.loose:
                    other, both = self.loose[h]
                    i, j = ends.index(h), ends.index(other)
                    for index, pairs in enumerate(matchings_of(len(ends))):
                        if not any(i in chosen or j in chosen for chosen in pairs):
                            costs[index] += both
            if junction in self._allowed:
                chosen = self._allowed[junction]
                costs = [cost if index in chosen else math.inf for index, cost in enumerate(costs)]
            self._listed[junction] = costs
        return self._listed[junction]

    def _by_subsets(self, ends: tuple[int, ...], without: Pair | None = None) -> tuple[float, Matching]:
        """Dynamic programme over the half-edges that are still to be decided."""
        known: dict[tuple[int, ...], tuple[float, Matching]] = {(): (0.0, ())}

        def solve(left: tuple[int, ...]) -> tuple[float, Matching]:
            if left not in known:
                least: tuple[float, Matching] = (math.inf, ())
                for step, used, made in self._choices(left, without):
                    cost, pairs = solve(tuple(h for h in left if h not in used))
                    if cost + step < least[0]:
                        least = (cost + step, pairs + made)
                known[left] = least
            return known[left]

        cost, pairs = solve(ends)
        return cost, tuple(sorted(pairs))

    def _choices(
        self, left: tuple[int, ...], without: Pair | None
    ) -> Iterator[tuple[float, tuple[int, ...], Matching]]:
        """What may become of the first half-edge: cost, half-edges decided, transitions made."""
        h, rest = left[0], left[1:]
        other, both = self.loose.get(h, (h, 0.0))
        if other in rest:
            yield self.free[h] + self.free[other] + both, (h, other), ()
            for b in rest:
                if b in self.pair[other] and ordered(b, other) != without:
                    cost = self.free[h] + self.pair[other][b]
                    yield cost, (h, other, b), (ordered(b, other),)
        else:
            yield self.free[h], (h,), ()
        for b in rest:
            if b in self.pair[h] and (h, b) != without:
                yield self.pair[h][b], (h, b), ((h, b),)

    def _by_integers(self, ends: tuple[int, ...]) -> tuple[float, Matching]:
        """The best matching where too many segments meet for listing."""
        from wrapit.highs import Programme

        programme = Programme()
        base = sum(self.free[h] for h in ends)
        for a in ends:
            for b, cost in self.pair[a].items():
                if a < b:
                    programme.add_column(("pair", a, b), cost - self.free[a] - self.free[b])
        for h in ends:
            programme.add_row({("pair", *ordered(h, b)): 1.0 for b in self.pair[h]}, high=1.0)
        for h, (other, both) in self.loose.items():
            if h in ends:
                programme.add_column(("loose", h), both)
                touching = {("pair", *ordered(x, b)): 1.0 for x in (h, other) for b in self.pair[x]}
                programme.add_row({**touching, ("loose", h): 1.0}, low=1.0)
        values = programme.solve(10**6).values
        assert values is not None
        chosen = [name for name, x in values.items() if x > 0.5]
        pairs = tuple(sorted((name[1], name[2]) for name in chosen if name[0] == "pair"))
        return base + sum(programme.costs[programme.columns[name]] for name in chosen), pairs
