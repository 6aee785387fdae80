"""What a solver is asked, piece by piece of the drawing, and what it answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import NO_MATE, Energy, Weights, half_edges
from wrapit.decomposition.rules import NO_RULES, Rules, broken

CLOSE = 1e-9
"""Energies that differ by less are equal: sums of some thousand terms err by 1e-12, and HiGHS by this."""


@dataclass(frozen=True, eq=False)
class Problem:
    """One graph to divide into trails, with the weights of the energy and the user's rules.

    `mirror` gives the mirror image of each half-edge, empty where symmetry has no weight.
    """

    graph: Graph
    weights: Weights
    rules: Rules = NO_RULES
    mirror: tuple[int, ...] = ()

    def energy(self, mate: Sequence[int]) -> Energy:
        """The energy of a matching."""
        return energy_of(self.graph, mate, self.weights, self.mirror)

    def price(self, e: int) -> float:
        """What a segment that may stay unused costs as soon as it is used, a wire more aside."""
        if e in self.graph.second_runs:
            return self.weights.doubling * self.graph.second_runs[e].cost
        return self.weights.bridges

    def part(self, segments: Sequence[int]) -> Problem:
        """The problem of these segments alone, renumbered in order."""
        number = {h: index for index, h in enumerate(h for e in segments for h in half_edges(e))}
        mirror = tuple(number.get(self.mirror[h], NO_MATE) for h in number) if self.mirror else ()
        return Problem(self.graph.subgraph(segments), self.weights, self.rules.renumbered(number), mirror)

    def is_allowed(self, mate: Sequence[int]) -> bool:
        """Whether a matching breaks no rule."""
        return broken(self.graph, self.rules, mate) == 0


@dataclass(frozen=True)
class Answer:
    """A matching, and what the solver proved about it.

    `iterations` counts the solver's own steps; `lower_bound` is None where nothing was proved;
    `proven` says that the energy meets it.
    """

    mate: tuple[int, ...]
    iterations: int
    lower_bound: float | None = None
    proven: bool = False


PieceAnswer = tuple[list[int], Answer]


def parts_of(problem: Problem, bridges: bool) -> list[list[int]]:
    """Segments of each piece: what lines join, or bridges if they may be used, or mirror images."""
    graph = problem.graph
    offered = [e for e in range(graph.segments) if bridges or e not in graph.bridges]
    whole = problem.part(offered)
    images = [(h >> 1, image >> 1) for h, image in enumerate(whole.mirror) if image != NO_MATE]
    return [[offered[e] for e in piece] for piece in pieces(whole.graph, images)]


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


def best_answers(
    problem: Problem,
    parts: Sequence[list[int]],
    another: Callable[[Problem, Sequence[Sequence[int]]], Answer | None],
    count: int,
) -> list[Answer]:
    """The `count` best different answers, best first; fewer where there are no more.

    `another` gives the best answer for one part that differs from those matchings, None after the last.
    """
    combined: list[list[PieceAnswer]] = [[]]
    for part in parts:
        found: list[Answer] = []
        while len(found) < count:
            answer = another(problem.part(part), [other.mate for other in found])
            if answer is None:
                break
            found.append(answer)
        longer = [[*before, (part, answer)] for before in combined for answer in found]
        combined = sorted(longer, key=lambda answers: problem.energy(_together(problem, answers).mate).total)
        combined = combined[:count]
    return [_together(problem, answers) for answers in combined]


def _together(problem: Problem, answers: Sequence[PieceAnswer]) -> Answer:
    """One answer from those of the pieces; the bound is none if one of theirs is."""
    mate = [NO_MATE] * (2 * problem.graph.segments)
    for piece, answer in answers:
        ends = [h for e in piece for h in half_edges(e)]
        for h, other in zip(ends, answer.mate, strict=True):
            mate[h] = ends[other] if other != NO_MATE else NO_MATE
    bounds = [answer.lower_bound for _, answer in answers if answer.lower_bound is not None]
    return Answer(
        tuple(mate),
        sum(answer.iterations for _, answer in answers),
        sum(bounds) if len(bounds) == len(answers) else None,
    )
