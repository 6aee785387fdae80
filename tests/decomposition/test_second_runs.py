"""Lines run along twice: the answer against all there are, and what `decompose` makes of it."""

from __future__ import annotations

import itertools
import math
import re
from collections import Counter
from collections.abc import Sequence
from itertools import islice

import pytest

from tests.decomposition.asking import config, solved
from tests.decomposition.brute import all_matchings, energy_by_definition
from tests.decomposition.cases import closed_up
from tests.decomposition.drawings import cross, drawing_of, gap_drawing, lotus, theta, twig_drawing
from tests.decomposition.second_runs_judge import (
    best_of_all,
    best_of_all_choices,
    grants,
    matchings,
    plainly_solved,
    posed,
)
from wrapit.config.decomposition import DecompositionConfig
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, fewest_possible_wires, graph_of
from wrapit.decomposition.model import NO_MATE, Solution, half_edges
from wrapit.decomposition.second_runs import SideBySide, with_second_runs
from wrapit.decomposition.stage import alternatives, decompose, front
from wrapit.errors import DecompositionError

BUDGET = 10_000_000
DRAWINGS = {
    "cross": cross(),
    "theta": theta(),
    "gap": gap_drawing(),
    "twig": twig_drawing(),
    "lotus": lotus(),
    "two pieces": drawing_of(
        [(0, 0), (10, 0), (-10, 0), (0, 9), (50, 0), (60, 0), (50, 9), (41, 0)],
        [(0, 1), (0, 2), (0, 3), (4, 5), (4, 6), (4, 7)],
    ),
}


def small(graph: Graph, most: int = 700) -> bool:
    return matchings(graph) <= most


@pytest.mark.parametrize("bridged", [False, True])
@pytest.mark.parametrize("wished", [False, True])
def test_nothing_is_better_than_the_answer(bridged: bool, wished: bool) -> None:
    cases = (posed(seed, 6, bridged=bridged, wished=wished) for seed in itertools.count())
    solvable = 0
    for problem, wishes in islice((case for case in cases if small(case[0].graph)), 40):
        best = best_of_all(problem, wishes)
        answer = solve_exactly(problem, BUDGET)
        assert (answer is None) == math.isinf(best)
        if answer is not None:
            solvable += 1
            assert grants(problem.graph, wishes, problem.rules.most_wires, answer.mate)
            energy = energy_by_definition(problem.graph, answer.mate, problem.weights)
            assert (energy, answer.lower_bound) == (pytest.approx(best, abs=1e-7),) * 2
    assert solvable >= (20 if wished else 40)  # wishes may contradict one another


@pytest.mark.parametrize("bridged", [False, True])
def test_no_choice_of_second_runs_is_better(bridged: bool) -> None:
    cases = (posed(seed, 6, bridged=bridged) for seed in itertools.count())
    dense = (problem for problem, _ in cases if not small(problem.graph) and len(problem.graph.optional) < 6)
    for problem in islice(dense, 10):
        best = best_of_all_choices(problem, plainly_solved)
        answer = solve_exactly(problem, BUDGET)
        assert answer is not None
        energy = energy_by_definition(problem.graph, answer.mate, problem.weights)
        assert (energy, answer.lower_bound) == (pytest.approx(best, abs=1e-7),) * 2


def test_a_wish_is_met_by_either_run() -> None:
    """Segment 0 is to be with 1 and with 2, which may not be together: its two runs do that."""
    wishes = [{"same_wire": [0, 1]}, {"same_wire": [0, 2]}, {"different_wire": [1, 2]}]
    solution = solved(cross(), doubling=True, constraints=wishes)
    wires = [{t.segment for t in trail.traversals} for trail in solution.trails]
    assert any({0, 1} <= wire for wire in wires)
    assert any({0, 2} <= wire for wire in wires)
    assert not any({1, 2} <= wire for wire in wires)
    assert 0 in solution.doubled
    assert solution.optimal


def looks(graph: Graph, mate: Sequence[int]) -> tuple[tuple[int, int], ...]:
    """What wires look like: the closed matching, under the first of the names that the runs may have."""
    used = {h >> 1 for h, other in enumerate(mate) if other != NO_MATE}
    both = [(e, run.segment) for e, run in graph.second_runs.items() if {e, run.segment} <= used]
    forms = []
    for swapped in itertools.product((False, True), repeat=len(both)):
        name = {e: e for e in range(graph.segments)}
        for e, f in itertools.compress(both, swapped):
            name[e], name[f] = f, e
        number = [2 * name[h >> 1] + h % 2 for h in range(2 * graph.segments)]
        pairs = ((number[a], number[b]) for a, b in closed_up(graph, mate))
        forms.append(tuple(sorted((min(pair), max(pair)) for pair in pairs)))
    return min(forms)


def test_other_answers_are_other_wires_in_order() -> None:
    cases = (posed(seed, 4, bridged=seed % 3 == 0) for seed in itertools.count())
    for problem, _ in islice((case for case in cases if small(case[0].graph, 100)), 16):
        graph, most = problem.graph, problem.rules.most_wires
        least: dict[tuple[tuple[int, int], ...], float] = {}
        for mate in all_matchings(graph):
            energy = energy_by_definition(graph, mate, problem.weights)
            if energy is not None and grants(graph, [], most, mate):
                form = looks(graph, mate)
                least[form] = min(energy, least.get(form, math.inf))
        found: list[tuple[int, ...]] = []
        while len(found) < 4 and (answer := solve_exactly(problem, BUDGET, found)) is not None:
            found.append(answer.mate)
        energies = [energy_by_definition(graph, mate, problem.weights) for mate in found]
        assert energies == pytest.approx(sorted(least.values())[:4], abs=1e-7)
        assert len({looks(graph, mate) for mate in found}) == len(found)


@pytest.mark.parametrize("name", ["theta", "gap", "twig", "two pieces"])
def test_alternatives_differ_as_wires(name: str) -> None:
    found = alternatives(DRAWINGS[name], config(max_wires=1), 5)
    assert len(found) == 5
    assert any(solution.doubled for solution in found) or name == "theta"
    totals = [solution.energy.total for solution in found]
    assert totals == sorted(totals)
    assert all(solution.optimal for solution in found)
    graph = with_second_runs(graph_of(DRAWINGS[name]))
    assert len({looks(graph, solution.decomposition.mate) for solution in found}) == 5


def test_a_choice_is_one_of_the_alternatives() -> None:
    second = alternatives(twig_drawing(), config(max_wires=1), 2)[1]
    chosen = solved(twig_drawing(), max_wires=1, choice=2)
    assert chosen.trails == second.trails
    assert chosen.energy == second.energy


def energy_of_runs(solution: Solution, tight: frozenset[int] = frozenset()) -> float:
    """The energy by its definition, from the trails over the drawing's own segments."""
    drawing, weights = solution.decomposition.drawing, solution.weights
    graph = graph_of(drawing)
    runs = Counter(t.segment for trail in solution.trails for t in trail.traversals)
    strokes = [segment.curve.length for segment in drawing.segments if segment.kind == "stroke"]
    mean_mm = sum(strokes) / len(strokes)
    doubled = sum(graph.lengths_mm[e] / mean_mm + (e in tight) for e, times in runs.items() if times == 2)
    bends, at = 0.0, []
    for trail in solution.trails:
        at.append({graph.junction_of[h] for t in trail.traversals for h in half_edges(t.segment)})
        for one, other in itertools.pairwise(trail.traversals):
            cosine = graph.tangents[one.arrival] @ graph.tangents[other.departure]
            bends += math.pi - math.acos(max(-1.0, min(1.0, cosine)))
    touched = [
        {j for j in mine for k, theirs in enumerate(at) if k != i and j in theirs}
        for i, mine in enumerate(at)
    ]
    return (
        len(solution.trails)
        + weights.smoothness * bends
        + weights.robustness * sum(len(junctions) == 1 for junctions in touched)
        + weights.bridges * len(runs.keys() & graph.bridges)
        + weights.symmetry * solution.energy.asymmetry
        + weights.doubling * doubled
    )


def check(solution: Solution, pieces: int, most: int | None) -> None:
    """That trails are walks over every line, once or twice, with the energy and the names as said."""
    graph = graph_of(solution.decomposition.drawing)
    for trail in solution.trails:
        for one, other in itertools.pairwise(trail.traversals):
            assert graph.junction_of[one.arrival] == graph.junction_of[other.departure]
    runs = Counter(t.segment for trail in solution.trails for t in trail.traversals)
    assert set(range(graph.segments)) - graph.bridges <= runs.keys()
    assert set(runs.values()) <= {1, 2}
    assert {e for e, times in runs.items() if times == 2} == set(solution.doubled)
    assert most is None or len(solution.trails) <= most * pieces
    assert solution.energy.total == pytest.approx(energy_of_runs(solution), abs=1e-6)
    assert solution.optimal
    assert solution.lower_bound == pytest.approx(solution.energy.total, abs=1e-6)


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize(
    "keys",
    [{"max_wires": 1}, {"max_wires": 2}, {"doubling": True}, {"max_wires": 1, "weights": {"doubling": 0.2}}],
    ids=str,
)
def test_wires_run_along_every_line_once_or_twice(name: str, keys: dict[str, object]) -> None:
    pieces = 2 if name == "two pieces" else 1
    solution, findings = decompose(DRAWINGS[name], DecompositionConfig.model_validate(keys))
    check(solution, pieces, DecompositionConfig.model_validate(keys).max_wires)
    assert ("doubled-wire" in [finding.code for finding in findings]) == bool(solution.doubled)


def test_symmetry_bridges_and_second_runs_go_together() -> None:
    for keys in ({"weights": {"symmetry": 0.5}}, {"bridges": True}):
        for drawing in (lotus(), gap_drawing()):
            check(solved(drawing, max_wires=1, **keys), 1, 1)
            assert solved(drawing, max_wires=1, **keys).energy.complexity == 1
    # Annealing counts like treatment by its own way: it finds nothing better.
    short = {"cooling": 2e-3}
    annealed = solved(lotus(), max_wires=2, weights={"symmetry": 0.5}, solver="annealing", annealing=short)
    exact = solved(lotus(), max_wires=2, weights={"symmetry": 0.5})
    assert annealed.energy.total >= exact.energy.total - 1e-9


@pytest.mark.parametrize("name", DRAWINGS)
def test_what_needs_no_second_run_has_none(name: str) -> None:
    drawing = DRAWINGS[name]
    plain = solved(drawing)
    pieces = 2 if name == "two pieces" else 1
    for most in range(1, 4):
        if fewest_possible_wires(graph_of(drawing)) <= most * pieces == most:
            limited = solved(drawing, max_wires=most, weights={"robustness": 0.0})
            assert limited.doubled == ()
    assert solved(drawing, max_wires=len(plain.trails)).energy.total <= plain.energy.total + 1e-9


@pytest.mark.parametrize("name", DRAWINGS)
def test_the_front_trades_wires_for_length(name: str) -> None:
    drawing = DRAWINGS[name]
    found = front(drawing, config(weights={"doubling": 50.0}))
    assert found[0].trails == solved(drawing, weights={"doubling": 50.0}).trails
    counts = [solution.energy.complexity for solution in found]
    assert counts == sorted(set(counts), reverse=True)
    assert counts[-1] == (2 if name == "two pieces" else 1)
    fewest = fewest_possible_wires(graph_of(drawing))
    for one, other in itertools.pairwise(found):
        assert other.energy.doubling >= one.energy.doubling
        assert other.energy.doubling > one.energy.doubling or other.energy.complexity >= fewest
    assert all(solution.optimal for solution in found)


@pytest.mark.parametrize(("height_mm", "doubled"), [(4.3, (1, 2)), (6.0, (0,))])
def test_cramped_lines_are_avoided_where_another_way_costs_little_more(
    height_mm: float, doubled: tuple[int, ...]
) -> None:
    """Two junctions with a short line between them and a way around, of one mean segment more or less."""
    points = [(0, 0), (4, 0), (2, height_mm), (-9, 0), (13, 0)]
    drawing = drawing_of(points, [(0, 1), (0, 2), (2, 1), (3, 0), (1, 4)])
    direct, *around = (segment.curve.length for segment in drawing.segments)
    assert (sum(around[:2]) - direct < (direct + sum(around)) / 5) == (doubled == (1, 2))
    room = SideBySide(apart_mm=1.0, radius_mm=0.5, shortest_mm=4.5)
    asked = config(max_wires=1, constraints=[{"start_at": 3}, {"start_at": 4}], weights={"smoothness": 0.0})
    solution, findings = decompose(drawing, asked, room)
    assert solution.doubled == doubled
    assert solution.energy.total == pytest.approx(energy_of_runs(solution, frozenset({0})), abs=1e-6)
    assert ("cramped-double" in [finding.code for finding in findings]) == (doubled == (0,))
    assert decompose(drawing, asked)[0].doubled == (0,)


def test_mirrored_pieces_have_so_many_wires_each() -> None:
    fork = [(4, 0), (4, 9), (12, 16), (9, 25)]
    points = [*fork, *((-x, y) for x, y in fork)]
    pair = drawing_of(points, [(0, 1), (1, 2), (1, 3), (4, 5), (5, 6), (5, 7)])
    solution = solved(pair, max_wires=1, weights={"symmetry": 0.5})
    check(solution, 2, 1)
    assert (solution.energy.complexity, solution.energy.asymmetry) == (2, 0)


@pytest.mark.parametrize(
    ("most", "wishes", "said"),
    [
        (1, [{"different_wire": [0, 4]}], r"constraints\.0 .* and max_wires: 1 together"),
        (2, [{"different_wire": [0, 4, 2]}], r"constraints\.0 .* and max_wires: 2 together"),
        (1, [{"max_wire_length": "30 mm"}], r"constraints\.0 .* and max_wires: 1 together"),
        (
            2,
            [{"same_wire": [0, 4]}, {"different_wire": [4, 0]}],
            r"constraints\.0 .* constraints\.1 [^:]*:[^:]*$",
        ),
    ],
)
def test_wishes_that_so_few_wires_cannot_meet_are_named(
    most: int, wishes: list[dict[str, object]], said: str
) -> None:
    with pytest.raises(DecompositionError) as refusal:
        solved(theta(), max_wires=most, constraints=wishes)
    assert re.search(said, str(refusal.value).split(";")[0])
    assert solved(theta(), max_wires=most + 1, constraints=wishes[:1]).trails


def test_as_many_lines_apart_as_wires_are_no_contradiction() -> None:
    answer = solved(theta(), max_wires=2, constraints=[{"different_wire": [0, 4]}])
    runs = [{t.segment for t in trail.traversals} for trail in answer.trails]
    assert len(runs) <= 2
    assert not any({0, 4} <= run for run in runs)
