"""An independent judge: the energy by its definition, and the best of all matchings by trying them all.

Written from the definition, sharing nothing with the solvers but the graph.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Weights


def energy_by_definition(graph: Graph, mate: Sequence[int], weights: Weights) -> float | None:
    """The energy of a matching, None where it closes a ring."""
    wires = wires_of(graph, mate)
    if wires is None:
        return None
    at = [{graph.junction_of[h] for e in wire for h in (2 * e, 2 * e + 1)} for wire in wires]
    weak = 0
    for i, mine in enumerate(at):
        touched = {j for j in mine for k, other in enumerate(at) if k != i and j in other}
        weak += len(touched) == 1
    bends = sum(_bend(graph, a, b) for a, b in enumerate(mate) if a < b)
    used = set().union(*wires)
    optional = weights.bridges * len(used & graph.bridges)
    optional += weights.doubling * sum(run.cost for e, run in graph.second_runs.items() if e in used)
    return len(wires) + weights.smoothness * bends + weights.robustness * weak + optional


def wires_of(graph: Graph, mate: Sequence[int]) -> list[set[int]] | None:
    """Segment sets of the wires, None where there is a ring; what is optional and joins nothing is none."""
    count = len(graph.junction_of) // 2
    wires = []
    left = {e for e in range(count) if e not in graph.optional or mate[2 * e] >= 0 or mate[2 * e + 1] >= 0}
    while left:
        group, frontier = set(), [min(left)]
        while frontier:
            e = frontier.pop()
            if e not in group:
                group.add(e)
                frontier += [mate[h] // 2 for h in (2 * e, 2 * e + 1) if mate[h] >= 0]
        ends = sum(mate[h] < 0 for e in group for h in (2 * e, 2 * e + 1))
        if ends != 2:
            return None
        left -= group
        wires.append(group)
    return wires


def best_by_trying(
    graph: Graph, weights: Weights, accept: Callable[[Sequence[int]], bool] = lambda mate: True
) -> float:
    """Least energy over all matchings that `accept` takes; infinity where there is none."""
    best = math.inf
    for mate in all_matchings(graph):
        energy = energy_by_definition(graph, mate, weights)
        if energy is not None and energy < best and accept(mate):
            best = energy
    return best


def all_matchings(graph: Graph) -> Iterator[list[int]]:
    """Every matching of half-edges that meet, rings included."""
    mate = [-1] * len(graph.junction_of)
    groups = [list(ends) for ends in graph.incident]

    def extend(group: int, index: int) -> Iterator[list[int]]:
        if group == len(groups):
            yield mate
            return
        ends = groups[group]
        while index < len(ends) and mate[ends[index]] >= 0:
            index += 1
        if index == len(ends):
            yield from extend(group + 1, 0)
            return
        a = ends[index]
        yield from extend(group, index + 1)
        for b in ends[index + 1 :]:
            if mate[b] < 0 and a // 2 != b // 2:
                mate[a], mate[b] = b, a
                yield from extend(group, index + 1)
                mate[a] = mate[b] = -1

    yield from extend(0, 0)


def _bend(graph: Graph, a: int, b: int) -> float:
    (ax, ay), (bx, by) = graph.tangents[a], graph.tangents[b]
    return math.pi - abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by))
