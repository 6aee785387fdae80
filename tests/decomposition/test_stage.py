"""The verb of the package and its file."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable

import pytest

from tests.decomposition.drawings import cross, drawing_of, theta
from wrapit.config.decomposition import DecompositionConfig
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.json_file import decomposition_json
from wrapit.decomposition.stage import decompose
from wrapit.drawing.model import Drawing
from wrapit.errors import DecompositionError

ANNEALING = DecompositionConfig(solver="annealing")


def test_a_theta_is_one_wire() -> None:
    solution, findings = decompose(theta(), ANNEALING)
    assert solution.energy.complexity == len(solution.trails) == 1
    assert sorted(t.segment for t in solution.trails[0].traversals) == [0, 1, 2, 3, 4]
    assert findings == ()
    again = energy_of(graph_of(theta()), solution.decomposition.mate, solution.weights)
    assert again == solution.energy


@pytest.mark.parametrize("make", [theta, cross])
def test_both_solvers_find_the_same_on_small_drawings(make: Callable[[], Drawing]) -> None:
    exact, _ = decompose(make(), DecompositionConfig())
    annealed, _ = decompose(make(), ANNEALING)
    assert exact.optimal
    assert exact.solver == "exact"
    assert exact.lower_bound == pytest.approx(exact.energy.total)
    assert annealed.energy.total == pytest.approx(exact.energy.total)


def test_weak_wires_and_pieces_are_said() -> None:
    points = [(0, 0), (10, 0), (-10, 0), (0, 10), (0, -10), (50, 0), (60, 0)]
    two = drawing_of(points, [(0, 1), (0, 2), (0, 3), (0, 4), (5, 6)])
    solution, findings = decompose(two, ANNEALING)
    assert solution.energy.complexity == 3
    codes = [finding.code for finding in findings]
    assert codes.count("separate-pieces") == 1
    assert codes.count("weak-wire") == solution.energy.robustness == 2


def test_an_empty_drawing_is_refused() -> None:
    with pytest.raises(DecompositionError, match="no lines"):
        decompose(Drawing((), ()), ANNEALING)


def test_the_file_has_the_promised_keys_and_is_the_same_each_time() -> None:
    texts = {decomposition_json(decompose(cross(), ANNEALING)[0]) for _ in range(2)}
    assert len(texts) == 1
    document = json.loads(texts.pop())
    assert set(document) == {
        "format", "solver", "seed", "wires", "energy", "weights", "lower_bound", "optimal",
        "bridges_used", "doubled", "iterations",
    }  # fmt: skip
    assert document["format"] == "wrapit-decomposition/1"
    assert document["wires"][0]["name"] == "wire-01"
    assert set(document["wires"][0]) == {"name", "closed", "traversals"}
    assert set(document["energy"]) == {"total", "complexity", "smoothness_rad", "robustness", "bridges"}
    assert document["weights"] == {"smoothness": 0.1, "robustness": 0.9, "bridges": 0.1}
    runs = [tuple(step) for wire in document["wires"] for step in wire["traversals"]]
    assert sorted(segment for segment, _ in runs) == [0, 1, 2, 3]


def test_no_solver_of_scipy_is_loaded_before_it_is_needed() -> None:
    code = (
        "import sys; from tests.decomposition.drawings import theta;"
        "from wrapit.decomposition.stage import decompose;"
        "from wrapit.config.decomposition import DecompositionConfig;"
        "decompose(theta(), DecompositionConfig());"
        "sys.exit('scipy.optimize' in sys.modules or 'OCP' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
