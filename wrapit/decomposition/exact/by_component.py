"""Piece by piece: a solver on each connected piece of the drawing."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import pieces
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.problem import Answer, Problem

PieceAnswer = tuple[list[int], Answer]


def solve_piecewise(
    problem: Problem, parts: Sequence[list[int]], solve: Callable[[Problem], Answer | None]
) -> Answer | None:
    """The answers of all parts together; None where one has none."""
    answers: list[PieceAnswer] = []
    for part in parts:
        answer = solve(problem.part(part))
        if answer is None:
            return None
        answers.append((part, answer))
    return _together(problem, answers)


def best_answers(problem: Problem, parts: Sequence[list[int]], budget: int, count: int) -> list[Answer]:
    """The `count` best different answers, best first; fewer where there are no more."""
    combined: list[list[PieceAnswer]] = [[]]
    for part in parts:
        found: list[Answer] = []
        while len(found) < count:
            answer = solve_exactly(problem.part(part), budget, [other.mate for other in found])
            if answer is None:
                break
            found.append(answer)
        longer = [[*before, (part, answer)] for before in combined for answer in found]
        combined = sorted(longer, key=lambda answers: problem.energy(_together(problem, answers).mate).total)
        combined = combined[:count]
    return [_together(problem, answers) for answers in combined]


def parts_of(problem: Problem, bridges: bool) -> list[list[int]]:
    """Segments of each piece: what lines join, or bridges if they may be used, or mirror images."""
    graph = problem.graph
    offered = [e for e in range(graph.segments) if bridges or e not in graph.bridges]
    whole = problem.part(offered)
    images = [(h >> 1, image >> 1) for h, image in enumerate(whole.mirror) if image != NO_MATE]
    return [[offered[e] for e in piece] for piece in pieces(whole.graph, images)]


def _together(problem: Problem, answers: Sequence[PieceAnswer]) -> Answer:
    """One answer from those of the pieces; the bound is none if one of theirs is."""
    mate = [NO_MATE] * (2 * problem.graph.segments)
    for piece, answer in answers:
        half_edges = [h for e in piece for h in (2 * e, 2 * e + 1)]
        for h, other in zip(half_edges, answer.mate, strict=True):
            mate[h] = half_edges[other] if other != NO_MATE else NO_MATE
    bounds = [answer.lower_bound for _, answer in answers if answer.lower_bound is not None]
    return Answer(
        tuple(mate),
        sum(answer.iterations for _, answer in answers),
        sum(bounds) if len(bounds) == len(answers) else None,
    )
