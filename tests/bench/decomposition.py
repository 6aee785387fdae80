"""Decomposition: proven against brute force, and timed beside the paper's algorithm in plain C++.

The reference program is compiled where it is present: `../shared/peers/reference.cpp` next to the
checkout, or the file that WRAPIT_REFERENCE names. WRAPIT_BENCH_BRUTE sets the number of small graphs.
"""

from __future__ import annotations

import math
import os
import resource
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np

from tests.bench.graphs import FAMILIES, all_even, composed, flowers, graph_text, random_multigraph
from tests.decomposition.brute import best_by_trying, energy_by_definition
from tests.decomposition.cases import obeys, some_rules, with_some_bridges
from wrapit.config.decomposition import AnnealingConfig
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Energy, Weights
from wrapit.decomposition.problem import Answer, Problem, parts_of, solve_piecewise
from wrapit.decomposition.rules import NO_RULES
from wrapit.decomposition.trails import trails_of

T = TypeVar("T")

WEIGHTS = Weights(0.1, 0.9, 0.1)
BUDGET = 2_000_000
SIZES = (12, 24, 54, 214, 1000, 5000)
_WHOLE_RUN = 138_149
_REFERENCE_SEGMENTS = 220  # larger graphs run part of the schedule, and the rest is extrapolated
_PART_RUN = 10_000


def main() -> None:
    _brute_force(int(os.environ.get("WRAPIT_BENCH_BRUTE", "2400")))
    _against_reference()
    _annealing_against_exact()
    _known_wires()


def _brute_force(count: int) -> None:
    print("\nagainst all matchings of graphs of up to 7 segments: loops, parallels, cut junctions, all-even")
    print(f"{'':24}{'graphs':>8}{'equal':>8}{'proven':>8}{'impossible':>12}")
    for name, small, bridged, ruled, share in (
        ("plain", _small, False, False, 1.0),
        ("rings on cut junctions", _small_cactus, False, False, 0.5),
        ("with bridges", _small, True, False, 0.5),
        ("with constraints", _small, False, True, 0.5),
        ("with both", _small, True, True, 0.5),
    ):
        equal = proven = impossible = total = 0
        for seed in range(round(count * share)):
            graph, rng = small(seed)
            graph = with_some_bridges(graph, rng) if bridged else graph
            rules = some_rules(graph, rng) if ruled else NO_RULES
            best = best_by_trying(graph, WEIGHTS, lambda mate, g=graph, r=rules: obeys(g, r, mate))
            answer = solve_exactly(Problem(graph, WEIGHTS, rules), BUDGET)
            total += 1
            if answer is None:
                impossible += 1
                equal += math.isinf(best)
                continue
            energy = energy_by_definition(graph, answer.mate, WEIGHTS)
            good = energy is not None and abs(energy - best) < 1e-7 and obeys(graph, rules, answer.mate)
            equal += good
            proven += answer.lower_bound is not None and abs(answer.lower_bound - best) < 1e-7
            if not good:
                print(f"  seed {seed}: {energy} instead of {best}")
        print(f"{name:24}{total:8}{equal:8}{proven:8}{impossible:12}", flush=True)


def _small(seed: int) -> tuple[Graph, np.random.Generator]:
    rng = np.random.default_rng(seed)
    segments = int(rng.integers(1, 8))
    junctions = int(rng.integers(3 if segments > 5 else 1, 8))
    graph = (all_even if seed % 3 == 0 else random_multigraph)(rng, segments, junctions)
    return graph.subgraph(max(pieces(graph), key=len)), rng


def _small_cactus(seed: int) -> tuple[Graph, np.random.Generator]:
    rng = np.random.default_rng(seed)
    return flowers(rng, int(rng.integers(1, 7)), int(rng.integers(1, 4)), float(rng.uniform())), rng


def _against_reference() -> None:
    source = Path(os.environ.get("WRAPIT_REFERENCE", "../shared/peers/reference.cpp"))
    compiler = shutil.which("g++")
    usable = source.is_file() and compiler is not None
    reason = "" if usable else f" (no reference: {source} or g++ is missing)"
    print(f"\nproven optimum, annealing, and the paper's algorithm in C++ -O2, one run each{reason}")
    print(
        f"{'':14}{'segments':>9}{'E exact':>10}{'gap':>8}{'N':>5}{'weak':>5}{'exact':>11}"
        f"{'E anneal':>10}{'anneal':>9}{'its/s':>9}{'E ref':>10}{'reference':>11}{'ratio':>8}"
    )
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder, "reference")
        if usable:
            subprocess.run([str(compiler), "-O2", "-o", str(program), str(source)], check=True)
        for family, make in FAMILIES.items():
            for size in SIZES:
                _one_row(family, make, size, program if usable else None)


def _one_row(
    family: str, make: Callable[[np.random.Generator, int], Graph], size: int, program: Path | None
) -> None:
    def fresh() -> Problem:
        graph = make(np.random.default_rng(size), size)
        return Problem(graph.subgraph(max(pieces(graph), key=len)), WEIGHTS)

    problem = fresh()
    answer, exact_s = _timed(lambda: solve_exactly(problem, BUDGET))
    assert answer is not None
    for again in [fresh() for _ in range(5 if exact_s < 1 else 0)]:  # what imports and caches cost once
        exact_s = min(exact_s, _timed(lambda again=again: solve_exactly(again, BUDGET))[1])
    energy = problem.energy(answer.mate)
    row = f"{family:14}{problem.graph.segments:9}{energy.total:10.3f}{energy.total - answer.lower_bound:8.1e}"
    row += f"{energy.complexity:5}{energy.robustness:5}{exact_s * 1e3:8.1f} ms"
    if size <= 1000:
        annealed, anneal_s = _timed(lambda: anneal(problem, AnnealingConfig(), np.random.default_rng(1)))
        row += f"{problem.energy(annealed.mate).total:10.3f}{anneal_s:7.2f} s{_WHOLE_RUN / anneal_s:9.0f}"
    if program is not None and size <= 1000:
        whole = size <= _REFERENCE_SEGMENTS
        found, seconds = _reference(program, problem.graph, _WHOLE_RUN if whole else _PART_RUN)
        scaled_s = seconds if whole else seconds * _WHOLE_RUN / _PART_RUN
        row += f"{found:10.3f}" if whole else f"{'–':>10}"
        row += f"{scaled_s:9.2f} s{'' if whole else '~'}{scaled_s / exact_s:8.0f}"
    print(row, flush=True)


def _timed(work: Callable[[], T]) -> tuple[T, float]:
    """The result and the processor time; other programs on the machine don't count."""
    start = time.process_time()
    return work(), time.process_time() - start


def _reference(program: Path, graph: Graph, iterations: int) -> tuple[float, float]:
    path = program.with_name("graph.txt")
    path.write_text(graph_text(graph))
    command = [
        str(program),
        str(path),
        str(WEIGHTS.smoothness),
        str(WEIGHTS.robustness),
        "1",
        "1",
        str(iterations),
    ]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    words = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    return float(words[words.index("E") + 1]), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def _annealing_against_exact(graphs: int = 4, runs: int = 8) -> None:
    print(f"\nhow often annealing ends in the proven optimum ({graphs} graphs, {runs} seeds each):")
    print(f"the paper's method at the paper's schedule, T = 100 … 1e-4 in {_WHOLE_RUN} steps, untuned.")
    print("Closed curves are hard for it: one wire runs along everything, and two of its turns have to")
    print("change at once for it to stay one. It finds the fewest wires, but not always the smoothest.")
    print(f"{'':14}{'segments':>9}{'optimum':>9}{'fewest wires':>14}{'mean excess':>13}")
    for family, make in FAMILIES.items():
        for size in (12, 24, 54):
            hits = least = 0
            excess = 0.0
            for number in range(graphs):
                graph = make(np.random.default_rng([size, number]), size)
                problem = Problem(graph.subgraph(max(pieces(graph), key=len)), WEIGHTS)
                answer = solve_exactly(problem, BUDGET)
                assert answer is not None
                best = problem.energy(answer.mate)
                for seed in range(runs):
                    energy = _annealed_energy(problem, seed)
                    hits += energy.total < best.total + 1e-6
                    least += energy.complexity <= best.complexity
                    excess += energy.total - best.total
            count = graphs * runs
            print(
                f"{family:14}{size:9}{hits / count:9.0%}{least / count:14.0%}{excess / count:13.3f}",
                flush=True,
            )


def _known_wires(pieces_each: int = 12) -> None:
    """The paper's Figure 5: pieces laid out of known wires, taken apart again; no drawing in between."""
    print("\npieces composed of known smooth wires: share of the wires that is recovered exactly")
    print(
        f"{'wires':>7}{'segments':>10}{'recovered':>11}{'energy of the answer at most that of the truth':>48}"
    )
    for count in (5, 8, 12, 16):
        total = recovered = lower = segments = 0
        for number in range(pieces_each):
            graph, truth = composed(np.random.default_rng([count, number]), count)
            problem = Problem(graph, WEIGHTS)
            answer = solve_piecewise(
                problem, parts_of(problem, False), lambda part: solve_exactly(part, BUDGET)
            )
            assert answer is not None
            found = [{t.segment for t in trail.traversals} for trail in trails_of(graph, answer.mate)]
            straight = [-1] * (2 * graph.segments)
            for wire in truth:
                for e in sorted(wire)[:-1]:
                    straight[2 * e + 1], straight[2 * e + 2] = 2 * e + 2, 2 * e + 1
            recovered += sum(wire in found for wire in truth)
            total += len(truth)
            segments += graph.segments
            lower += problem.energy(answer.mate).total <= problem.energy(straight).total + 1e-9
        print(
            f"{count:7}{segments / pieces_each:10.0f}{recovered / total:11.0%}{lower / pieces_each:48.0%}",
            flush=True,
        )


def _annealed_energy(problem: Problem, seed: int) -> Energy:
    answer: Answer = anneal(problem, AnnealingConfig(), np.random.default_rng(seed))
    return problem.energy(answer.mate)


if __name__ == "__main__":
    main()
