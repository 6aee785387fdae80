"""The verb of this package: a drawing becomes wires-to-be."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from wrapit.config.decomposition import MOST_CHOICES, ConstraintConfig, DecompositionConfig, SolverName
from wrapit.decomposition.bridges import with_bridges
from wrapit.decomposition.constraints import rules_of
from wrapit.decomposition.doubling import doubled_back
from wrapit.decomposition.energy import energy_of_trails
from wrapit.decomposition.findings import findings_of
from wrapit.decomposition.graph import Graph, graph_of, most_of_a_piece
from wrapit.decomposition.model import NO_MATE, Decomposition, Solution, Weights, half_edges
from wrapit.decomposition.problem import Answer, Problem, best_answers, parts_of, solve_piecewise
from wrapit.decomposition.second_runs import SideBySide, cramped, with_second_runs
from wrapit.decomposition.solvers import (
    SOLVERS,
    check_solver,
    exhaustive_solver,
    more_thorough,
    source_of_alternatives,
)
from wrapit.decomposition.trails import first_runs, trails_of
from wrapit.drawing.model import Drawing
from wrapit.drawing.reflection import mirror_images
from wrapit.errors import ConfigError, DecompositionError, Finding

# An energy that exceeds its lower bound by less than this share meets it.
_CLOSE = 1e-9


def decompose(
    drawing: Drawing, config: DecompositionConfig, room: SideBySide | None = None
) -> tuple[Solution, tuple[Finding, ...]]:
    """The best wires that the chosen solver finds for a drawing (paper, section 4).

    A drawing in several pieces is decomposed piece by piece: robustness, and its exemption for a
    single wire, are those of each piece. Trails come in wire order, longest first. With
    `config.bridges` the solution's drawing has the bridges on offer appended to its segments. With
    `config.doubling` or `config.max_wires` lines may be run along twice; where `room` says that two wires
    side by side have too little of it, at a higher price.

    Raises DecompositionError for a drawing without segments and for constraints that can't be met
    together; ConfigError for a constraint that names what the drawing doesn't have, for what the
    solver can't heed, and for a `config.choice` beyond those that there are.
    """
    if config.choice > 1:
        return _chosen(drawing, config, room)
    drawing, problem = _posed(drawing, config, room)
    answer = _answer(problem, config)
    if answer is None:
        raise _refusal(problem, config)
    solution = _solution(drawing, problem, answer, config, config.solver)
    return solution, findings_of(problem.graph, solution, room, SOLVERS[config.solver].proves_more)


def alternatives(
    drawing: Drawing, config: DecompositionConfig, k: int, room: SideBySide | None = None
) -> tuple[Solution, ...]:
    """The k best different decompositions, best first, by the solver or the one that it names for this.

    Where a closed wire is left open makes no difference. `optimal` says that no other decomposition
    but those before is better. Raises as `decompose` does, and ConfigError where the
    solver finds none.
    """
    solver, drawing, problem, answers = _best(drawing, config, k, room)
    return tuple(_solution(drawing, problem, answer, config, solver) for answer in answers)


def front(
    drawing: Drawing, config: DecompositionConfig, room: SideBySide | None = None
) -> tuple[Solution, ...]:
    """Wires against length run twice: the cheapest answer for each number of wires, the most wires first.

    From the best without second runs down to one wire for each piece of the drawing, or to as few as the
    constraints allow; of more than MOST_CHOICES numbers the least ones. The first is what `decompose` finds
    without `max_wires`, each other one what it finds with `max_wires: most_of_a_piece(it)`. Raises as
    `decompose` does.
    """
    free = config.model_copy(update={"max_wires": None, "doubling": False, "choice": 1})
    found = [decompose(drawing, free, room)[0]]
    most = min(most_of_a_piece(found[0]), MOST_CHOICES) - 1
    while most > 0:
        fewer = free.model_copy(update={"max_wires": most})
        shown, problem = _posed(drawing, fewer, room)
        answer = _answer(problem, fewer)
        if answer is None:
            break
        found.append(_solution(shown, problem, answer, fewer, fewer.solver))
        most = most_of_a_piece(found[-1]) - 1  # the numbers between have the same answer
    return tuple(found)


def _answer(problem: Problem, config: DecompositionConfig) -> Answer | None:
    """What the chosen solver finds for a problem; None where it finds nothing that the rules allow."""
    rng, solver = np.random.default_rng(config.seed), SOLVERS[config.solver]
    parts = parts_of(problem, config.bridges)
    answer = solve_piecewise(problem, parts, lambda part: solver.solve(part, config, rng))
    return answer if answer is not None and problem.is_allowed(answer.mate) else None


def _chosen(
    drawing: Drawing, config: DecompositionConfig, room: SideBySide | None
) -> tuple[Solution, tuple[Finding, ...]]:
    """The alternative that `config.choice` names, measured against the bound that the best one meets."""
    solver, drawing, problem, answers = _best(drawing, config, min(config.choice, MOST_CHOICES), room)
    if len(answers) < config.choice:
        there_are = "the best of many are" if len(answers) == MOST_CHOICES else "this drawing has"
        raise ConfigError(
            f"there is no alternative {config.choice}: {there_are} {len(answers)}",
            "decomposition.choice",
            f"choose between 1 and {len(answers)}" if len(answers) > 1 else "take it away",
        )
    answer = replace(answers[-1], lower_bound=answers[0].lower_bound)
    solution = _solution(drawing, problem, answer, config, solver)
    return solution, findings_of(problem.graph, solution, room)


def _best(
    drawing: Drawing, config: DecompositionConfig, k: int, room: SideBySide | None
) -> tuple[SolverName, Drawing, Problem, list[Answer]]:
    """The best answers, with the problem and the solver that they are of; raises as `alternatives` does."""
    solver, another = source_of_alternatives(config)
    drawing, problem = _posed(drawing, config, room)
    answers = best_answers(
        problem,
        parts_of(problem, config.bridges),
        lambda part, others: another(part, config, others),
        k,
    )
    if not answers or not problem.is_allowed(answers[0].mate):
        raise _refusal(problem, config)
    return solver, drawing, problem, [answer for answer in answers if problem.is_allowed(answer.mate)]


def _posed(drawing: Drawing, config: DecompositionConfig, room: SideBySide | None) -> tuple[Drawing, Problem]:
    """The drawing, with bridges if they are asked for, and the problem that it poses."""
    if not any(segment.kind == "stroke" for segment in drawing.segments):
        raise DecompositionError("the drawing has no lines to make wires of", remedy="draw at least one line")
    check_solver(config)
    if config.bridges:
        drawing = with_bridges(drawing)
    graph = graph_of(drawing)
    if config.second_runs:
        graph = with_second_runs(graph, cramped(drawing, room))
    return drawing, Problem(
        graph,
        Weights(**config.weights.model_dump()),
        rules_of(graph, config.constraints, config.bridges, config.max_wires),
        _mirror(drawing, graph, config),
    )


def _mirror(drawing: Drawing, graph: Graph, config: DecompositionConfig) -> tuple[int, ...]:
    """The mirror image of each half-edge where symmetry has a weight; that of a second run is one too."""
    if not config.weights.symmetry:
        return ()
    mirror = mirror_images(drawing, config.mirror)
    second = {run.segment: e for e, run in graph.second_runs.items()}
    images = []
    for run in graph.second_runs.values():
        for h in half_edges(run.segment):
            image = mirror[h]
            twin = second.get(image >> 1) if image != NO_MATE else None
            images.append(NO_MATE if twin is None else 2 * twin + image % 2)
    return (*mirror, *images)


def _solution(
    drawing: Drawing, problem: Problem, answer: Answer, config: DecompositionConfig, solver: SolverName
) -> Solution:
    """An answer with its trails and with its energy, evaluated anew from them."""
    graph = problem.graph
    trails = trails_of(graph, answer.mate)
    energy, bound = problem.energy(answer.mate), answer.lower_bound
    optimal = bound is not None and energy.total - bound < _CLOSE * (1 + energy.total)
    if config.refine_dangling == "auto":
        trails = doubled_back(graph, trails)
        refined = energy_of_trails(graph, trails, problem.weights, energy.asymmetry)
        # The bound is about decompositions as they are before any doubling.
        bound = None if bound is None else bound + refined.total - energy.total
        energy = refined
    trails = first_runs(graph, trails)
    runs = Counter(traversal.segment for trail in trails for traversal in trail.traversals)
    return Solution(
        decomposition=Decomposition(drawing, answer.mate),
        trails=trails,
        energy=energy,
        weights=problem.weights,
        solver=solver,
        seed=config.seed,
        iterations=answer.iterations,
        lower_bound=bound,
        optimal=optimal,
        bridges_used=tuple(sorted(runs.keys() & graph.bridges)),
        doubled=tuple(sorted(e for e, count in runs.items() if count > 1)),
    )


def _refusal(problem: Problem, config: DecompositionConfig) -> DecompositionError:
    """Names the fewest constraints that can't be met together: each of them is needed for that.

    Where nothing is proved about them, it says that none were found, and how to find more.
    """
    kept = list(enumerate(config.constraints))
    if not _is_impossible(problem, config, [constraint for _, constraint in kept]):
        asked = [f"max_wires: {config.max_wires}"] if config.max_wires is not None else []
        asked += ["all constraints"] if kept else []
        return DecompositionError(
            f"the solver {config.solver} found no wires that meet {' and '.join(asked)}",
            "decomposition.constraints" if kept else "decomposition.max_wires",
            more_thorough(config),
        )
    for entry in list(kept):
        fewer = [other for other in kept if other is not entry]
        if _is_impossible(problem, config, [constraint for _, constraint in fewer]):
            kept = fewer
    named = [f"constraints.{index} ({_said(constraint)})" for index, constraint in kept]
    any_number = config.model_copy(update={"max_wires": None})
    if config.max_wires is not None and not _is_impossible(problem, any_number, [each for _, each in kept]):
        named.append(f"max_wires: {config.max_wires}")
    return DecompositionError(
        f"no wires can meet {' and '.join(named)}" + (" together" if len(named) > 1 else ""),
        "decomposition.constraints",
        "drop or change one of them",
    )


def _is_impossible(
    problem: Problem, config: DecompositionConfig, constraints: Sequence[ConstraintConfig]
) -> bool:
    """Whether no wires can meet the constraints, proved; a search that ran out of work proves nothing."""
    rules = rules_of(problem.graph, constraints, config.bridges, config.max_wires)
    asked = replace(problem, rules=rules)
    solver, rng = exhaustive_solver(config), np.random.default_rng(config.seed)
    answer = solve_piecewise(
        asked, parts_of(asked, config.bridges), lambda part: solver.solve(part, config, rng)
    )
    return answer is None


def _said(constraint: ConstraintConfig) -> str:
    return ", ".join(
        f"{key}: {value}" for key, value in constraint.model_dump(mode="json", exclude_none=True).items()
    )
