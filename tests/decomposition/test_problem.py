"""A drawing in several pieces: each by itself, and the best combinations of their answers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import pytest

from tests.decomposition.drawings import drawing_of
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.model import NO_MATE, Weights, half_edges
from wrapit.decomposition.problem import Answer, Problem, best_answers, parts_of, solve_piecewise
from wrapit.decomposition.rules import Rules

# Two corners and a stroke, and their segments in a mixed order.
POINTS = [(0, 0), (9, 0), (0, 9), (50, 0), (59, 0), (50, 9), (0, 30), (9, 30)]
LINES = [(0, 1), (3, 4), (0, 2), (6, 7), (3, 5)]
CORNERS = Problem(graph_of(drawing_of(POINTS, LINES)), Weights())
PARTS = [[0, 2], [1, 4], [3]]


def joined(problem: Problem) -> Answer:
    """Each corner is one wire."""
    mate = [NO_MATE] * (2 * problem.graph.segments)
    if problem.graph.segments == 2:
        mate[0], mate[2] = 2, 0
    return Answer(tuple(mate), 5, 1.0)


def another(problem: Problem, others: Sequence[Sequence[int]]) -> Answer | None:
    """First joined, then apart, then no more."""
    apart = Answer((NO_MATE,) * (2 * problem.graph.segments), 5, 1.0)
    options = [joined(problem), apart] if problem.graph.segments == 2 else [apart]
    return options[len(others)] if len(others) < len(options) else None


def test_pieces_are_found_and_put_together() -> None:
    assert parts_of(CORNERS, bridges=False) == PARTS
    answer = solve_piecewise(CORNERS, PARTS, joined)
    assert answer is not None
    assert (answer.iterations, answer.lower_bound) == (15, 3.0)
    pairs = {(a, b) for a, b in enumerate(answer.mate) if a < b}
    assert pairs == {(half_edges(0)[0], half_edges(2)[0]), (half_edges(1)[0], half_edges(4)[0])}


def test_a_piece_without_a_bound_or_an_answer_leaves_the_whole_without() -> None:
    unproved = solve_piecewise(
        CORNERS,
        PARTS,
        lambda part: Answer(joined(part).mate, 1, None if part.graph.segments == 1 else 1.0),
    )
    assert unproved is not None
    assert unproved.lower_bound is None
    missing = solve_piecewise(CORNERS, PARTS, lambda part: joined(part) if part.graph.segments == 2 else None)
    assert missing is None


@pytest.mark.parametrize("count", [1, 2, 3, 4, 9])
def test_the_best_of_the_whole_are_combinations_of_the_best_of_each(count: int) -> None:
    found = [CORNERS.energy(answer.mate) for answer in best_answers(CORNERS, PARTS, another, count)]
    assert [energy.complexity for energy in found] == [3, 4, 4, 5][:count]
    totals = [energy.total for energy in found]
    assert totals == sorted(totals)


def test_rules_go_with_their_segments() -> None:
    rules = Rules(
        forbidden=frozenset({(0, 4), (2, 8)}), same=(((0,), (2,)),), apart=((1, 4),), longest_mm=7.0
    )
    ruled = Problem(CORNERS.graph, Weights(), rules)
    first, second, last = (ruled.part(part).rules for part in PARTS)
    assert (first.forbidden, first.same, first.apart) == ({(0, 2)}, (((0,), (1,)),), ())
    assert (second.forbidden, second.same, second.apart) == ({(0, 2)}, (), ((0, 1),))
    assert last == Rules(longest_mm=7.0)


def test_mirror_images_belong_to_one_piece() -> None:
    mirror = [NO_MATE] * 10
    for e, image in product((0, 1), repeat=2):
        if e != image:
            mirror[2 * e], mirror[2 * e + 1] = half_edges(image)
    mirrored = Problem(CORNERS.graph, Weights(symmetry=1.0), mirror=tuple(mirror))
    assert parts_of(mirrored, bridges=False) == [[0, 1, 2, 4], [3]]
