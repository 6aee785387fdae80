"""Lines run along twice: against all matchings, all choices and the Chinese postman; and how long it takes.

WRAPIT_BENCH_BRUTE sets the number of small graphs of each kind.
"""

from __future__ import annotations

import itertools
import math
import os
import time
from collections.abc import Iterator
from itertools import islice

import numpy as np

from tests.bench.graphs import FAMILIES
from tests.conftest import CONFIGS
from tests.decomposition.brute import energy_by_definition
from tests.decomposition.exact.test_postman import LENGTHS_ALONE, drawn, open_route_mm
from tests.decomposition.second_runs_judge import (
    best_of_all,
    best_of_all_choices,
    grants,
    matchings,
    plainly_solved,
    posed,
)
from wrapit.config import load_config
from wrapit.config.decomposition import ConstraintConfig
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import Rules
from wrapit.decomposition.second_runs import with_second_runs
from wrapit.decomposition.stage import decompose
from wrapit.pipeline.trying.tried import read
from wrapit.wires.beside.side_by_side import room_of
from wrapit.wires.stage import draw_wires

BUDGET = 2_000_000
_MATCHINGS = 3_000  # of larger graphs there are too many to try them all


def main() -> None:
    count = int(os.environ.get("WRAPIT_BENCH_BRUTE", "1000"))
    print("\ngraphs of up to 6 segments; at most 1, 2, 3 wires or any number; price 0, 0.2, 1, 3 by turns")
    print(f"{'':36}{'graphs':>8}{'equal':>8}{'proven':>8}{'impossible':>12}")
    for bridged, wished in itertools.product((False, True), repeat=2):
        name = f"all matchings{', bridges' * bridged}{', wishes' * wished}"
        _compared(name, _tried(count, bridged=bridged, wished=wished))
    for bridged in (False, True):
        _compared(f"all choices{', bridges' * bridged}", _chosen(count, bridged=bridged))
    _compared("Chinese postman", _postman(200))
    _timed()
    _laid()


# The problem, its wishes, and the least energy that the judge found.
Judged = tuple[Problem, list[ConstraintConfig], float]


def _compared(name: str, cases: Iterator[Judged]) -> None:
    total = equal = proven = impossible = 0
    for problem, wishes, best in cases:
        answer = solve_exactly(problem, BUDGET)
        total += 1
        if answer is None:
            impossible += 1
            equal += math.isinf(best)
            continue
        energy = energy_by_definition(problem.graph, answer.mate, problem.weights)
        kept = grants(problem.graph, wishes, problem.rules.most_wires, answer.mate)
        equal += kept and energy is not None and abs(energy - best) < 1e-7
        proven += answer.lower_bound is not None and abs(answer.lower_bound - best) < 1e-7
    print(f"{name:36}{total:8}{equal:8}{proven:8}{impossible:12}", flush=True)


def _tried(count: int, *, bridged: bool, wished: bool) -> Iterator[Judged]:
    cases = (posed(seed, 6, bridged=bridged, wished=wished) for seed in itertools.count())
    few = ((problem, wishes) for problem, wishes in cases if matchings(problem.graph) <= _MATCHINGS)
    for problem, wishes in islice(few, count):
        yield problem, wishes, best_of_all(problem, wishes)


def _chosen(count: int, *, bridged: bool) -> Iterator[Judged]:
    for seed in range(count):
        problem, wishes = posed(seed, 6, bridged=bridged)
        yield problem, wishes, best_of_all_choices(problem, plainly_solved)


def _postman(count: int) -> Iterator[Judged]:
    for seed in range(count):
        graph = drawn(seed)
        least = open_route_mm(graph) * graph.segments / sum(graph.lengths_mm)
        yield Problem(with_second_runs(graph), LENGTHS_ALONE, Rules(most_wires=1)), [], 1 + least


def _timed() -> None:
    print("\none wire (max_wires: 1), processor time")
    print(f"{'':14}{'segments':>10}{'time':>10}{'E':>10}{'gap':>10}{'doubled':>10}")
    for family, make in FAMILIES.items():
        for size in (54, 200):
            graph = make(np.random.default_rng(size), size)
            whole = with_second_runs(graph.subgraph(max(pieces(graph), key=len)))
            problem = Problem(whole, Weights(), Rules(most_wires=1))
            start = time.process_time()
            answer = solve_exactly(problem, BUDGET)
            spent_s = time.process_time() - start
            assert answer is not None
            assert answer.lower_bound is not None
            energy = problem.energy(answer.mate)
            strokes = whole.segments - len(whole.second_runs)
            print(
                f"{family:14}{strokes:10}{spent_s:8.2f} s{energy.total:10.3f}"
                f"{max(0.0, energy.total - answer.lower_bound):10.1e}{energy.doubling:10.2f}",
                flush=True,
            )


def _laid() -> None:
    """What of the project's own drawings, each in one wire for each piece, comes to lie side by side."""
    print("\nour drawings with max_wires: 1")
    print(
        f"{'':20}{'segments':>10}{'run twice':>12}{'beside':>10}{'layers':>8}{'too tight':>11}{'laid in':>9}"
    )
    for path in sorted(CONFIGS.glob("*.yaml")):
        settings = load_config(path)
        wanted = settings.decomposition.model_copy(update={"max_wires": 1})
        config = settings.model_copy(update={"decomposition": wanted})
        drawing, _ = read(config, CONFIGS / config.drawing)
        solution, _ = decompose(drawing, wanted, room_of(config))
        start = time.process_time()
        wires, findings = draw_wires(solution, config)
        spent_s = time.process_time() - start
        beside_mm = sum(run.end_mm - run.start_mm for wire in wires for run in wire.doubles if run.first)
        tight = sum(each.code == "tight-bend" for each in findings)
        print(
            f"{path.stem:20}{len(drawing.segments):10}{solution.doubled_mm:9.0f} mm{beside_mm:7.0f} mm"
            f"{max(wire.layers for wire in wires):8}{tight:11}{spent_s:7.2f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
