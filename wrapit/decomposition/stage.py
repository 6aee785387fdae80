"""The verb of this package: a drawing becomes wires-to-be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from wrapit.config.decomposition import DecompositionConfig
from wrapit.decomposition.annealing import anneal
from wrapit.decomposition.energy import weak_trails
from wrapit.decomposition.exact import certified, solve_exactly
from wrapit.decomposition.graph import Graph, fewest_possible_wires, graph_of, pieces
from wrapit.decomposition.model import NO_MATE, Decomposition, Solution, Weights
from wrapit.decomposition.problem import Answer, Problem
from wrapit.decomposition.trails import trails_of
from wrapit.drawing.model import Drawing
from wrapit.errors import DecompositionError, Finding

_CLOSE = 1e-9

Solver = Callable[[Problem, DecompositionConfig, np.random.Generator], Answer]


def decompose(drawing: Drawing, config: DecompositionConfig) -> tuple[Solution, tuple[Finding, ...]]:
    """The best wires that the chosen solver finds for a drawing (paper, section 4).

    A drawing in several pieces is decomposed piece by piece: robustness, and its exemption for a
    single wire, are those of each piece. Trails are named in wire order, longest first. Raises
    DecompositionError for a drawing without segments.
    """
    if not drawing.segments:
        raise DecompositionError("the drawing has no lines to make wires of", remedy="draw at least one line")
    graph = graph_of(drawing)
    problem = Problem(graph, Weights(**config.weights.model_dump()))
    answer = solve(problem, config)
    solution = solution_of(drawing, problem, answer, config)
    return solution, tuple(_findings(graph, solution))


def solution_of(drawing: Drawing, problem: Problem, answer: Answer, config: DecompositionConfig) -> Solution:
    """An answer with its trails and with its energy, evaluated anew."""
    trails = trails_of(problem.graph, answer.mate)
    energy = problem.energy(answer.mate)
    bound = answer.lower_bound
    used = {traversal.segment for trail in trails for traversal in trail.traversals}
    return Solution(
        decomposition=Decomposition(drawing, answer.mate),
        trails=trails,
        energy=energy,
        weights=problem.weights,
        solver=config.solver,
        seed=config.seed,
        iterations=answer.iterations,
        lower_bound=bound,
        optimal=bound is not None and energy.total - bound < _CLOSE * (1 + energy.total),
        bridges_used=tuple(sorted(used & problem.graph.bridges)),
    )


def wire_name(index: int) -> str:
    """Name of the wire that trail `index` becomes.

    >>> wire_name(0)
    'wire-01'
    """
    return f"wire-{index + 1:02d}"


def solve(problem: Problem, config: DecompositionConfig) -> Answer:
    """Each connected piece apart, in the order of their first segments."""
    rng = np.random.default_rng(config.seed)
    mate = [NO_MATE] * (2 * problem.graph.segments)
    iterations, bounds = 0, []
    for piece in pieces(problem.graph):
        part = Problem(problem.graph.subgraph(piece), problem.weights)
        answer = SOLVERS[config.solver](part, config, rng)
        iterations += answer.iterations
        bounds.append(answer.lower_bound)
        half_edges = [h for e in piece for h in (2 * e, 2 * e + 1)]
        for h, other in zip(half_edges, answer.mate, strict=True):
            mate[h] = half_edges[other] if other != NO_MATE else NO_MATE
    known = [bound for bound in bounds if bound is not None]
    return Answer(tuple(mate), iterations, sum(known) if len(known) == len(bounds) else None)


def _annealed(problem: Problem, config: DecompositionConfig, rng: np.random.Generator) -> Answer:
    """Annealing proves nothing; what local reasoning proves, in no time, says how good it is."""
    answer = anneal(problem, config.annealing, rng)
    return replace(answer, lower_bound=certified(problem).lower_bound)


def _exact(problem: Problem, config: DecompositionConfig, _: np.random.Generator) -> Answer:
    return solve_exactly(problem, config.exact.budget)


SOLVERS: dict[str, Solver] = {"exact": _exact, "annealing": _annealed}


def _findings(graph: Graph, solution: Solution) -> list[Finding]:
    trails = solution.trails
    findings = [
        Finding(
            "warning",
            "weak-wire",
            wire_name(index),
            f"{wire_name(index)} is tied to the others at one junction only and can swing about it",
            "extend the line until it meets another one, or bind it twice",
        )
        for index in weak_trails(graph, trails)
    ]
    strokes = graph.subgraph([e for e in range(graph.segments) if e not in graph.bridges])
    if len(parts := pieces(strokes)) > 1:
        findings.append(
            Finding(
                "warning",
                "separate-pieces",
                "drawing",
                f"the drawing is in {len(parts)} pieces that no line joins",
                "join them with a line, or make them as pieces of their own",
            )
        )
    if solution.solver == "exact" and not solution.optimal:
        gap = solution.energy.total - (solution.lower_bound or 0.0)
        findings.append(
            Finding(
                "warning",
                "not-proven-best",
                "decomposition",
                f"better wires may exist: {solution.energy.total:.4f} is at most {gap:.4f} above the best energy",
                "raise decomposition.exact.budget",
            )
        )
    fewest = fewest_possible_wires(graph)
    if len(trails) > fewest:
        findings.append(
            Finding(
                "note",
                "more-wires-than-needed",
                "drawing",
                f"{len(trails)} wires, where {fewest} would do, are what the weights ask for",
                "lower weights.smoothness and weights.robustness for fewer wires",
            )
        )
    return findings
