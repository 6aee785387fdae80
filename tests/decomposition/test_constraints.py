"""What the user may ask of the wires: heeded by each solver, refused where it makes no sense."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.decomposition.asking import config, solved, wires
from tests.decomposition.drawings import cross, drawing_of, theta
from wrapit.config.loading import load_config
from wrapit.config.root import Config
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.solvers import SOLVERS
from wrapit.decomposition.stage import decompose
from wrapit.errors import ConfigError, DecompositionError


@pytest.mark.parametrize("solver", SOLVERS)
def test_wires_share_or_part_segments_as_asked(solver: str) -> None:
    assert {0, 1} in wires(solved(cross(), solver=solver))
    together = solved(cross(), solver=solver, constraints=[{"same_wire": [0, 2]}])
    assert {0, 2} in wires(together)
    apart = solved(cross(), solver=solver, constraints=[{"different_wire": [0, 1]}])
    assert {0, 1} not in wires(apart)


@pytest.mark.parametrize("solver", SOLVERS)
def test_transitions_are_made_or_not_as_asked(solver: str) -> None:
    through = solved(cross(), solver=solver, constraints=[{"through": [0, 3]}])
    assert {0, 3} in wires(through)
    not_through = solved(cross(), solver=solver, constraints=[{"not_through": [0, 1]}])
    assert {0, 1} not in wires(not_through)
    assert not_through.energy.complexity == 2


@pytest.mark.parametrize("solver", SOLVERS)
def test_wires_end_where_asked(solver: str) -> None:
    graph = graph_of(theta())
    start = solved(theta(), solver=solver, constraints=[{"start_at": 1}])
    mate = start.decomposition.mate
    assert any(mate[h] < 0 for h in graph.incident[1])
    cut = solved(theta(), solver=solver, constraints=[{"cut_at": 2}])
    assert all(cut.decomposition.mate[h] < 0 for h in graph.incident[2])


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_wire_is_longer_than_the_spool(solver: str) -> None:
    lengths = graph_of(theta()).lengths_mm
    short = solved(theta(), solver=solver, constraints=[{"max_wire_length": "30 mm"}])
    assert all(sum(lengths[e] for e in wire) <= 30 for wire in wires(short))
    assert short.energy.complexity == 2


@pytest.mark.parametrize(
    ("constraint", "message"),
    [
        ({"same_wire": [0, 9]}, "no segment 9"),
        ({"same_wire": [1, 1]}, "twice"),
        ({"through": [0, 2]}, "don't meet"),
        ({"through": [0, 1], "at": 0}, "don't meet at junction 0"),
        ({"start_at": 17}, "no junction 17"),
        ({"cut_at": -1}, "no junction -1"),
        ({"max_wire_length": "5 mm"}, "segment 4 alone is 14.1 mm"),
    ],
)
def test_a_constraint_that_the_drawing_does_not_fit_is_named(
    constraint: dict[str, Any], message: str
) -> None:
    with pytest.raises(ConfigError, match=message) as caught:
        decompose(theta(), config(constraints=[{"start_at": 0}, constraint]))
    assert caught.value.where == "decomposition.constraints.1"
    assert caught.value.exit_code == 2


def test_segments_of_two_pieces_share_no_wire() -> None:
    two = drawing_of([(0, 0), (9, 0), (0, 50), (9, 50)], [(0, 1), (2, 3)])
    with pytest.raises(ConfigError, match="nothing joins"):
        decompose(two, config(constraints=[{"same_wire": [0, 1]}]))
    assert solved(two, constraints=[{"different_wire": [0, 1]}]).energy.complexity == 2


def test_parallel_segments_need_the_junction() -> None:
    round_trip = drawing_of([(0, 0), (9, 0), (12, 5)], [(0, 1), (1, 2), (2, 1)])
    with pytest.raises(ConfigError, match=r"junctions 1 and 2.*at: 1"):
        decompose(round_trip, config(constraints=[{"through": [1, 2]}]))
    solution = solved(round_trip, constraints=[{"through": [1, 2], "at": 1}])
    assert solution.decomposition.mate[2] == 5


def test_a_contradiction_names_the_constraints_that_make_it() -> None:
    wishes = [{"start_at": 1}, {"through": [0, 1]}, {"max_wire_length": "99 mm"}, {"cut_at": 1}]
    with pytest.raises(DecompositionError) as caught:
        decompose(theta(), config(constraints=wishes))
    assert "constraints.1 (through" in str(caught.value)
    assert "constraints.3 (cut_at: 1)" in str(caught.value)
    assert "constraints.2" not in str(caught.value)
    assert caught.value.exit_code == 3


@pytest.mark.parametrize(
    "wish", [{"start_at": 1}, {"max_wire_length": "30 mm"}, {"different_wire": [0, 2]}], ids=str
)
def test_what_can_be_is_not_called_impossible_for_want_of_work(wish: dict[str, Any]) -> None:
    assert solved(theta(), constraints=[wish]).optimal
    with pytest.raises(DecompositionError, match="the solver exact found no wires") as caught:
        decompose(theta(), config(constraints=[wish], exact={"budget": 0}))
    assert caught.value.remedy == "raise decomposition.exact.budget"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{same_wire: [0, 1], cut_at: 3}", "says one thing, not 2"),
        ("{at: 3}", "says one thing, not 0"),
        ("{start_at: 3, at: 3}", "'at' goes with through"),
        ("{same_wires: [0, 1]}", "unknown key"),
        ("{max_wire_length: 300}", "no unit"),
    ],
)
def test_a_constraint_that_makes_no_sense_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "piece.yaml"
    path.write_text(f"drawing: x.svg\ndecomposition:\n  constraints:\n    - {text}\n")
    with pytest.raises(ConfigError, match=message) as caught:
        load_config(path)
    assert "piece.yaml:4:" in str(caught.value)


def test_the_config_reads_what_the_documents_show(tmp_path: Path) -> None:
    path = tmp_path / "piece.yaml"
    path.write_text(
        "drawing: x.svg\n"
        "decomposition:\n"
        "  solver: exact\n"
        "  weights: {smoothness: 0.1, robustness: 0.9, bridges: 0.1}\n"
        "  bridges: false\n"
        "  refine_dangling: false\n"
        "  constraints: [{same_wire: [3, 7]}, {different_wire: [1, 2]}, {start_at: 4}]\n"
    )
    read = load_config(path).decomposition
    assert (read.solver, read.bridges, read.refine_dangling) == ("exact", False, "never")
    assert read.constraints[0].same_wire == (3, 7)
    assert Config(drawing="x.svg").decomposition.solver == "exact"
