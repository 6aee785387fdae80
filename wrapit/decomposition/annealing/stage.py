"""The paper's Algorithm 1: simulated annealing over joins, splits and permutations of wires.

All operators are one local move, "make half-edges a–b a transition, or undo it", so a step costs
the same on a drawing of any size. Two things differ from the paper: energies are updated instead
of evaluated, and a wire may be permuted with itself, without which drawings whose junctions are
all even get stuck in one self-crossing wire.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from wrapit.config.decomposition import AnnealingConfig
from wrapit.decomposition.local_moves.matching_state import Wires
from wrapit.decomposition.model import NO_MATE, half_edges
from wrapit.decomposition.problem import Answer, Problem

# Random numbers drawn at a time. From 1024 to 32 768 a run takes the same time to 5 %; what each seed finds
# hangs on the number, so it stays.
_BLOCK = 1 << 13


def anneal(problem: Problem, schedule: AnnealingConfig, rng: np.random.Generator) -> Answer:
    """The best matching met on the way; random numbers come from `rng` alone."""
    wires = Wires(problem)
    best, best_energy = tuple(wires.mate), wires.energy
    temperature, keep = schedule.temperature, 1.0 - schedule.cooling
    iterations = 0
    for operator, a, choice, patience in _draws(problem, schedule, rng):
        if temperature < schedule.end_temperature:
            break
        iterations += 1
        if _step(wires, operator, a, choice, temperature * patience) and wires.energy < best_energy - 1e-12:
            best, best_energy = tuple(wires.mate), wires.energy
        temperature *= keep
    return Answer(best, iterations)


def _draws(
    problem: Problem, schedule: AnnealingConfig, rng: np.random.Generator
) -> Iterator[tuple[str, int, float, float]]:
    """Operator, half-edge, choice in [0, 1) and patience, without end.

    Metropolis: a step that costs Δ is taken with probability exp(−Δ / T), that is when Δ is at most
    T · patience with an exponentially distributed patience.
    """
    there = {"bridge": problem.graph.bridges, "double": problem.graph.second_runs}
    operators = [name for name in schedule.operators if there.get(name, True)]
    while True:
        yield from zip(
            [operators[index] for index in rng.integers(len(operators), size=_BLOCK).tolist()],
            rng.integers(2 * problem.graph.segments, size=_BLOCK).tolist(),
            rng.random(_BLOCK).tolist(),
            rng.standard_exponential(_BLOCK).tolist(),
            strict=True,
        )


def _step(wires: Wires, operator: str, a: int, choice: float, budget: float) -> bool:
    mate = wires.mate
    if operator == "split":
        return mate[a] != NO_MATE and wires.toggle(a, mate[a], budget)
    if operator == "bridge":
        return _switch(wires, wires.bridges[a % len(wires.bridges)], choice, budget)
    if operator == "double":
        return _switch(wires, wires.second_runs[a % len(wires.second_runs)], choice, budget)
    partners = wires.partners[a]
    if not partners:
        return False
    b = partners[int(choice * len(partners))]
    if (mate[a] == NO_MATE and mate[b] == NO_MATE) != (operator == "join") or mate[a] == b:
        return False
    return wires.toggle(a, b, budget)


def _switch(wires: Wires, optional: int, choice: float, budget: float) -> bool:
    """Takes a bridge or a second run out of use, or joins both its ends to something."""
    first, last = half_edges(optional)
    start, end = wires.partners[first], wires.partners[last]
    if wires.mate[first] != NO_MATE or wires.mate[last] != NO_MATE:
        return wires.drop(optional, budget)
    if not start or not end:
        return False
    index, rest = divmod(choice * len(start), 1.0)
    return wires.use(first, start[int(index)], last, end[int(rest * len(end))], budget)
