"""A solver is one line in the dict: what it can't do is refused, what it can do is asked of it alone."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest

from tests.decomposition.asking import config
from tests.decomposition.drawings import cross, gap_drawing, theta
from wrapit.config.decomposition import ConstraintConfig, DecompositionConfig, SolverName
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.problem import Answer, Problem
from wrapit.decomposition.solvers import SOLVERS, Solver
from wrapit.decomposition.stage import alternatives, decompose
from wrapit.errors import ConfigError, DecompositionError, WrapItError

CONSTRAINTS: dict[str, Any] = {
    "same_wire": [0, 1],
    "different_wire": [0, 1],
    "through": [0, 1],
    "not_through": [0, 1],
    "start_at": 0,
    "cut_at": 0,
    "max_wire_length": "90 mm",
}


def one_wire_each(problem: Problem, _config: DecompositionConfig, _rng: np.random.Generator) -> Answer:
    """The least of all solvers."""
    return Answer((NO_MATE,) * (2 * problem.graph.segments), 1)


@pytest.fixture
def solvers(monkeypatch: pytest.MonkeyPatch) -> dict[str, Solver]:
    """The dict, with a solver `plain` in it and room for one more, `other`."""
    held: dict[str, Solver] = {**SOLVERS}
    held["plain"] = Solver(one_wire_each)
    for name, solver in held.items():
        monkeypatch.setitem(SOLVERS, name, solver)  # type: ignore[misc]
    monkeypatch.setitem(SOLVERS, "other", Solver(one_wire_each))  # type: ignore[misc]
    return SOLVERS  # type: ignore[return-value]


def with_solver(name: str, **keys: Any) -> DecompositionConfig:
    """A config that names a solver which only the dict knows."""
    return config(**keys).model_copy(update={"solver": name})


def test_the_config_offers_what_the_dict_holds() -> None:
    assert tuple(SOLVERS) == get_args(SolverName)
    assert all(
        solver.alternatives_from is None or SOLVERS[solver.alternatives_from].another
        for solver in SOLVERS.values()
    )
    assert all(bool(solver.proves_more) == solver.exhaustive for solver in SOLVERS.values())


@pytest.mark.usefixtures("solvers")
def test_a_line_in_the_dict_makes_a_solver() -> None:
    solution, findings = decompose(cross(), with_solver("plain"))
    assert solution.solver == "plain"
    assert len(solution.trails) == 4
    assert (solution.lower_bound, solution.optimal, solution.iterations) == (None, False, 1)
    assert "not-proven-best" not in [finding.code for finding in findings]


def test_a_solver_that_promises_proof_says_where_it_has_none(solvers: dict[str, Solver]) -> None:
    solvers["other"] = Solver(one_wire_each, exhaustive=True, proves_more="wait longer")
    _, findings = decompose(cross(), with_solver("other"))
    assert [finding.remedy for finding in findings if finding.code == "not-proven-best"] == ["wait longer"]


@pytest.mark.parametrize("key", CONSTRAINTS)
def test_a_constraint_that_a_solver_cannot_heed_is_refused(key: str, solvers: dict[str, Solver]) -> None:
    solvers["other"] = Solver(one_wire_each, cannot=frozenset({key}))
    wishes = [{"start_at": 1} if key != "start_at" else {"cut_at": 1}, {key: CONSTRAINTS[key]}]
    with pytest.raises(ConfigError) as caught:
        decompose(theta(), with_solver("other", constraints=wishes))
    assert caught.value.where == "decomposition.constraints.1"
    assert f"other can't heed {key}" in caught.value.problem
    assert "use solver: exact or annealing" in caught.value.remedy
    assert "other" not in caught.value.remedy
    assert decompose(theta(), with_solver("other", constraints=wishes[:1]))[0].solver == "other"


def test_every_constraint_is_tried_here() -> None:
    assert set(CONSTRAINTS) == set(ConstraintConfig.model_fields) - {"at"}


def test_bridges_and_symmetry_may_be_refused_as_well(solvers: dict[str, Solver]) -> None:
    solvers["other"] = Solver(one_wire_each, cannot=frozenset({"bridges", "symmetry"}))
    with pytest.raises(ConfigError, match=r"^decomposition.bridges: the solver other can't heed bridges"):
        decompose(gap_drawing(), with_solver("other", bridges=True))
    with pytest.raises(ConfigError, match=r"^decomposition.weights.symmetry: "):
        decompose(gap_drawing(), with_solver("other", weights={"symmetry": 0.5}))
    assert decompose(gap_drawing(), with_solver("other"))[0].solver == "other"


@pytest.mark.usefixtures("solvers")
def test_what_a_search_misses_is_told_from_what_cannot_be() -> None:
    with pytest.raises(DecompositionError, match=r"plain found no wires.*use solver: exact"):
        decompose(cross(), with_solver("plain", constraints=[{"through": [0, 2]}]))
    with pytest.raises(DecompositionError, match=r"no wires can meet constraints.0.*and constraints.1"):
        decompose(cross(), with_solver("plain", constraints=[{"through": [0, 2]}, {"cut_at": 0}]))


def test_alternatives_are_asked_of_the_solver_that_has_them(solvers: dict[str, Solver]) -> None:
    with pytest.raises(WrapItError, match=r"plain finds no alternatives.*use solver: exact or annealing"):
        alternatives(theta(), with_solver("plain"), 2)
    solvers["other"] = Solver(
        one_wire_each,
        lambda problem, _, others: None if others else one_wire_each(problem, _, np.random.default_rng(0)),
    )
    assert [len(found.trails) for found in alternatives(theta(), with_solver("other"), 3)] == [5]
    solvers["other"] = Solver(one_wire_each, alternatives_from="exact")
    found, expected = (alternatives(theta(), with_solver(name), 3) for name in ("other", "exact"))
    assert [each.decomposition.mate for each in found] == [each.decomposition.mate for each in expected]
    assert {each.solver for each in found} == {"exact"}
