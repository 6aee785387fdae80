"""Given which optional segments are used, what is left to decide is a plain drawing."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.model import NO_MATE, half_edges
from wrapit.decomposition.problem import Problem, parts_of, solve_piecewise
from wrapit.decomposition.rules import in_use


def used_in(problem: Problem, mate: Sequence[int]) -> frozenset[int]:
    """The optional segments that a matching uses."""
    return frozenset(e for e in problem.graph.optional if in_use(problem.graph, mate, e))


def with_chosen(problem: Problem, used: Collection[int]) -> list[int]:
    """The matching that local reasoning finds best where just these optional segments are used.

    Rules other than forbidden transitions aren't heeded.
    """
    graph = problem.graph
    segments = [e for e in range(graph.segments) if e not in graph.optional or e in used]
    part = problem.part(segments)
    plain = replace(part, graph=replace(part.graph, bridges=frozenset(), second_runs={}))
    answer = solve_piecewise(plain, parts_of(plain, True), certified)
    assert answer is not None  # local reasoning always finds some matching
    ends = [h for e in segments for h in half_edges(e)]
    mate = [NO_MATE] * (2 * graph.segments)
    for h, other in zip(ends, answer.mate, strict=True):
        if other != NO_MATE:
            mate[h] = ends[other]
    return mate
