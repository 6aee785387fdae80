"""The verb of this package: a drawing becomes wires-to-be."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from wrapit.config.decomposition import DecompositionConfig
from wrapit.decomposition.annealing import anneal
from wrapit.decomposition.energy import energy_of, weak_trails
from wrapit.decomposition.graph import Graph, fewest_possible_wires, graph_of, pieces
from wrapit.decomposition.model import Decomposition, Solution, Trail, Weights
from wrapit.decomposition.problem import Answer, Problem
from wrapit.decomposition.trails import trails_of
from wrapit.drawing.model import Drawing
from wrapit.errors import DecompositionError, Finding

Solver = Callable[[Problem, DecompositionConfig, np.random.Generator], Answer]

SOLVERS: dict[str, Solver] = {
    "annealing": lambda problem, config, rng: anneal(problem, config.annealing, rng),
}


def decompose(drawing: Drawing, config: DecompositionConfig) -> tuple[Solution, tuple[Finding, ...]]:
    """The best wires that the chosen solver finds for a drawing (paper, section 4).

    A drawing in several pieces is decomposed piece by piece: robustness, and its exemption for a
    single wire, are those of each piece. Trails are named in wire order, longest first. Raises
    DecompositionError for a drawing without segments.
    """
    if not drawing.segments:
        raise DecompositionError("the drawing has no lines to make wires of", remedy="draw at least one line")
    graph = graph_of(drawing)
    weights = Weights(**config.weights.model_dump())
    answer = _solve(Problem(graph, weights), config)
    trails = trails_of(graph, answer.mate)
    energy = energy_of(graph, answer.mate, weights)
    solution = Solution(
        decomposition=Decomposition(drawing, answer.mate),
        trails=trails,
        energy=energy,
        weights=weights,
        solver=config.solver,
        seed=config.seed,
        iterations=answer.iterations,
        bridges_used=tuple(sorted({t.segment for trail in trails for t in trail.traversals} & graph.bridges)),
    )
    return solution, tuple(_findings(graph, trails))


def wire_name(index: int) -> str:
    """Name of the wire that trail `index` becomes.

    >>> wire_name(0)
    'wire-01'
    """
    return f"wire-{index + 1:02d}"


def _solve(problem: Problem, config: DecompositionConfig) -> Answer:
    """Each connected piece apart, in the order of their first segments."""
    rng = np.random.default_rng(config.seed)
    mate = [-1] * (2 * problem.graph.segments)
    iterations = 0
    for piece in pieces(problem.graph):
        answer = SOLVERS[config.solver](Problem(problem.graph.subgraph(piece), problem.weights), config, rng)
        iterations += answer.iterations
        half_edges = [h for e in piece for h in (2 * e, 2 * e + 1)]
        for h, other in zip(half_edges, answer.mate, strict=True):
            mate[h] = half_edges[other] if other >= 0 else other
    return Answer(tuple(mate), iterations)


def _findings(graph: Graph, trails: tuple[Trail, ...]) -> list[Finding]:
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
