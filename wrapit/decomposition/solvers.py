"""The solvers, each with what it can do and what it can't; no other module knows them by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from wrapit.config.decomposition import DecompositionConfig, SolverName
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.exact.branch_and_bound import certified
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.problem import Answer, Problem
from wrapit.errors import ConfigError

Solve = Callable[[Problem, DecompositionConfig, np.random.Generator], Answer | None]
Another = Callable[[Problem, DecompositionConfig, Sequence[Sequence[int]]], Answer | None]


@dataclass(frozen=True)
class Solver:
    """A way to divide one connected piece of a drawing into wires.

    `solve` gives the best matching that it finds, None where it finds none that keeps the rules.
    `another` gives the best one that differs from those given, None after the last; a solver that
    has no such thing either names one that does it instead (`alternatives_from`) or offers no
    alternatives. `cannot` are the keys of the config that it can't heed: those of constraints,
    `bridges`, and `symmetry` among the weights. An `exhaustive` solver searches until it has proof:
    its None says that there is none, and where its budget ends before the proof, `proves_more` tells
    the user what to do.
    """

    solve: Solve
    another: Another | None = None
    alternatives_from: SolverName | None = None
    cannot: frozenset[str] = frozenset()
    exhaustive: bool = False
    proves_more: str = ""


def _exact(problem: Problem, config: DecompositionConfig, _: np.random.Generator) -> Answer | None:
    return solve_exactly(problem, config.exact.budget)


def _another_exact(
    problem: Problem, config: DecompositionConfig, others: Sequence[Sequence[int]]
) -> Answer | None:
    return solve_exactly(problem, config.exact.budget, others)


def _annealed(problem: Problem, config: DecompositionConfig, rng: np.random.Generator) -> Answer:
    """Annealing proves nothing; what local reasoning proves, in no time, says how good it is."""
    answer = anneal(problem, config.annealing, rng)
    return replace(answer, lower_bound=certified(problem).lower_bound)


# The one place that knows solvers by name; the keys are those of the config.
SOLVERS: dict[SolverName, Solver] = {
    "exact": Solver(_exact, _another_exact, exhaustive=True, proves_more="raise decomposition.exact.budget"),
    "annealing": Solver(_annealed, alternatives_from="exact"),
}


def check_solver(config: DecompositionConfig) -> None:
    """Raises ConfigError where the config asks for what its solver can't heed, naming those that can."""
    for key, where in _asked(config):
        if key in SOLVERS[config.solver].cannot:
            able = [name for name, solver in SOLVERS.items() if key not in solver.cannot]
            raise ConfigError(
                f"the solver {config.solver} can't heed {key}", where, _instead(f"take {key} away", able)
            )


def source_of_alternatives(config: DecompositionConfig) -> tuple[SolverName, Another]:
    """The solver that gives alternatives for the config's own, and how. Raises ConfigError if none does."""
    name = SOLVERS[config.solver].alternatives_from or config.solver
    another = SOLVERS[name].another
    if another is None:
        able = [name for name, solver in SOLVERS.items() if solver.another or solver.alternatives_from]
        raise ConfigError(
            f"the solver {config.solver} finds no alternatives",
            "decomposition.solver",
            _instead("ask for one answer", able),
        )
    return name, another


def exhaustive_solver(config: DecompositionConfig) -> Solver:
    """The solver that says for certain whether constraints can be met: the config's own where it can."""
    own = SOLVERS[config.solver]
    return own if own.exhaustive else next(solver for solver in SOLVERS.values() if solver.exhaustive)


def more_thorough(config: DecompositionConfig) -> str:
    """What the user can do where wires were neither found nor proved impossible."""
    own = SOLVERS[config.solver]
    if own.exhaustive:
        return own.proves_more
    able = [name for name, solver in SOLVERS.items() if solver.exhaustive]
    return f"use solver: {' or '.join(able)}"


def _asked(config: DecompositionConfig) -> Iterator[tuple[str, str]]:
    """What the config asks for that a solver may be unable to heed, and where it does."""
    for index, constraint in enumerate(config.constraints):
        for key, value in constraint:
            if value is not None and key != "at":
                yield key, f"decomposition.constraints.{index}"
    if config.bridges:
        yield "bridges", "decomposition.bridges"
    if config.weights.symmetry:
        yield "symmetry", "decomposition.weights.symmetry"


def _instead(remedy: str, able: Sequence[SolverName]) -> str:
    return f"{remedy}, or use solver: {' or '.join(able)}" if able else remedy
