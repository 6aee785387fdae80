"""The best of all ways to run along some segments twice, by trying every choice of them.

What is left once it is chosen which optional segments are used is a plain multigraph; its best matching is
found by trying all (`plain=None`), or by a solver of plain multigraphs that was itself held against that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations

from tests.decomposition.brute import all_matchings, energy_by_definition, wires_of
from tests.decomposition.cases import obeys
from wrapit.decomposition.problem import Problem

Plain = Callable[[Problem], tuple[int, ...] | None]


def best_of_all_choices(problem: Problem, plain: Plain | None = None) -> float:
    """Least energy over all choices of optional segments; infinity where no choice keeps the rules."""
    graph, weights, best = problem.graph, problem.weights, math.inf
    optional = sorted(graph.optional)
    for used in (some for count in range(len(optional) + 1) for some in combinations(optional, count)):
        price = sum(problem.price(e) for e in used)
        if 1 + price >= best:
            continue
        segments = [e for e in range(graph.segments) if e not in graph.optional or e in used]
        part = problem.part(segments)
        chosen = replace(part, graph=replace(part.graph, bridges=frozenset(), second_runs={}))
        for mate in _matchings(chosen, plain):
            energy = energy_by_definition(chosen.graph, mate, weights)
            if energy is not None and energy + price < best and _keeps(problem, segments, mate):
                best = energy + price
    return best


def _matchings(problem: Problem, plain: Plain | None) -> Iterator[tuple[int, ...]]:
    if plain is None:
        yield from map(tuple, all_matchings(problem.graph))
    elif (mate := plain(problem)) is not None:
        yield mate


def _keeps(problem: Problem, segments: list[int], mate: Sequence[int]) -> bool:
    """Whether a matching of these segments keeps the rules of the whole."""
    ends = [h for e in segments for h in (2 * e, 2 * e + 1)]
    whole = [-1] * (2 * problem.graph.segments)
    for h, other in zip(ends, mate, strict=True):
        whole[h] = ends[other] if other >= 0 else -1
    wires, rules = wires_of(problem.graph, whole), problem.rules
    assert wires is not None
    return len(wires) <= (rules.most_wires or math.inf) and obeys(problem.graph, rules, whole)
