"""What a user may ask for in the config, on drawings."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.bench.graphs import FAMILIES
from tests.decomposition.drawings import cross, drawing_of, theta
from wrapit.config.decomposition import DecompositionConfig
from wrapit.config.loading import load_config
from wrapit.config.root import Config
from wrapit.decomposition.bridges import with_bridges
from wrapit.decomposition.doubling import doubled_back
from wrapit.decomposition.energy import weak_trails
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.json_file import decomposition_json
from wrapit.decomposition.model import Solution, Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.stage import alternatives, decompose
from wrapit.decomposition.symmetry import mirror_images
from wrapit.decomposition.trails import trails_of
from wrapit.drawing.model import Drawing
from wrapit.errors import ConfigError, DecompositionError

SOLVERS = ["exact", "annealing"]


def config(**keys: Any) -> DecompositionConfig:
    return DecompositionConfig.model_validate(keys)


def wires(solution: Solution) -> list[set[int]]:
    return [{t.segment for t in trail.traversals} for trail in solution.trails]


def solved(drawing: Drawing, **keys: Any) -> Solution:
    return decompose(drawing, config(**keys))[0]


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


def gap_drawing() -> Drawing:
    """A frame with two twigs inside whose tips nearly meet."""
    points = [(0, 0), (30, 0), (30, 20), (0, 20), (0, 10), (30, 10), (14, 10), (16, 10)]
    return drawing_of(points, [(0, 1), (1, 5), (5, 2), (2, 3), (3, 4), (4, 0), (4, 6), (5, 7)])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bridge_closes_a_gap_where_it_pays(solver: str) -> None:
    without, _ = decompose(gap_drawing(), config(solver=solver))
    solution, _ = decompose(gap_drawing(), config(solver=solver, bridges=True))
    drawing = solution.decomposition.drawing
    assert [segment.kind for segment in drawing.segments].count("bridge") == 1
    assert solution.bridges_used == (8,)
    assert solution.energy.bridges == 1
    assert solution.energy.total < without.energy.total - 0.5
    assert any({6, 7, 8} <= wire for wire in wires(solution))


def test_bridges_leap_over_no_line_and_reach_no_further_than_asked() -> None:
    lines = [(0, 1), (1, 5), (5, 2), (2, 3), (3, 4), (4, 0), (4, 6), (5, 7), (8, 9)]
    points = [(0, 0), (30, 0), (30, 20), (0, 20), (0, 10), (30, 10), (14, 10), (16, 10), (15, 5), (15, 15)]
    assert len(with_bridges(drawing_of(points, lines)).segments) == len(lines)
    far = drawing_of([(0, 0), (10, 0), (13.1, 0), (23, 0)], [(0, 1), (2, 3)])
    near = drawing_of([(0, 0), (10, 0), (12.9, 0), (23, 0)], [(0, 1), (2, 3)])
    assert len(with_bridges(far).segments) == 2
    assert len(with_bridges(near).segments) == 3


def test_a_bridge_in_the_drawing_stays_unused_unless_asked_for() -> None:
    offered = with_bridges(gap_drawing())
    solution, _ = decompose(offered, config())
    assert solution.bridges_used == ()
    assert solution.optimal
    used, _ = decompose(offered, config(bridges=True))
    assert used.bridges_used == (8,)
    assert len(used.decomposition.drawing.segments) == 9


def twig_drawing() -> Drawing:
    """Two crossing diagonals in a frame, and a twig that hangs on a side."""
    points = [(0, 0), (20, 0), (20, 20), (0, 20), (10, 10), (10, 0), (10, -8)]
    lines = [(0, 5), (5, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 2), (1, 4), (4, 3), (5, 6)]
    return drawing_of(points, lines)


def test_a_hanging_wire_is_taken_in_and_doubled() -> None:
    tee = drawing_of([(0, 0), (10, 0), (20, 0), (10, 8), (10, 14)], [(0, 1), (1, 2), (1, 3), (3, 4)])
    plain, findings = decompose(tee, config())
    assert plain.energy.robustness == 2
    assert "weak-wire" in [finding.code for finding in findings]
    refined, findings = decompose(tee, config(refine_dangling="auto"))
    assert refined.energy.robustness == 0
    assert len(refined.trails) == refined.energy.complexity == 1
    assert refined.doubled
    runs = [t.segment for t in refined.trails[0].traversals]
    assert {e for e in runs if runs.count(e) == 2} == set(refined.doubled)
    assert set(runs) == {0, 1, 2, 3}
    graph = graph_of(tee)
    at = [graph.junction_of[2 * t.segment + t.reversed] for t in refined.trails[0].traversals]
    to = [graph.junction_of[2 * t.segment + 1 - t.reversed] for t in refined.trails[0].traversals]
    assert at[1:] == to[:-1]  # it is one walk
    assert refined.optimal
    assert refined.lower_bound == pytest.approx(refined.energy.total)
    assert "doubled-wire" in [finding.code for finding in findings]


def test_refinement_leaves_good_wires_alone() -> None:
    before, after = solved(theta()), solved(theta(), refine_dangling="auto")
    assert after.trails == before.trails
    assert after.doubled == ()


def test_no_weak_wire_is_left_by_refinement() -> None:
    for weights in ({}, {"robustness": 0.0}, {"robustness": 0.0, "smoothness": 0.0}):
        for drawing in (twig_drawing(), gap_drawing(), cross()):
            solution = solved(drawing, weights=weights, refine_dangling="auto")
            assert weak_trails(graph_of(drawing), solution.trails) == []


def lotus() -> Drawing:
    """Mirrored about x = 0: a stem, two petals that cross, two leaves; drawn a little unevenly."""
    points = [(0, 0), (0, 20), (12, 30), (-12.2, 30.1), (0, 34), (10, 8), (-10.1, 8), (16, 18), (-15.9, 18)]
    lines = [(0, 1), (1, 2), (1, 3), (2, 4), (3, 4), (0, 5), (0, 6), (5, 7), (6, 8), (7, 2), (8, 3), (1, 4)]
    return drawing_of(points, lines)


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_the_mirror_axis_is_found(turn: float) -> None:
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    plain = lotus()
    turned = drawing_of(
        [tuple(rotation @ junction.point) for junction in plain.junctions],
        [(segment.start, segment.end) for segment in plain.segments],
    )
    mirror = mirror_images(turned, "auto")
    assert [mirror[2 * e] // 2 for e in range(12)] == [0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 11]
    assert mirror[2 * 5] == 2 * 6
    assert all(mirror[mirror[h]] == h for h in range(24))
    if not turn:
        assert mirror_images(turned, "vertical") == mirror
        assert mirror_images(turned, "horizontal") != mirror


def test_symmetry_is_kept_when_it_weighs() -> None:
    loose = solved(lotus())
    kept = solved(lotus(), weights={"symmetry": 3.0})
    assert kept.optimal
    assert kept.energy.asymmetry < max(1, solved(lotus(), weights={"symmetry": 1e-9}).energy.asymmetry)
    assert kept.energy.total >= loose.energy.total - 1e-9


def test_the_file_speaks_of_symmetry_where_it_was_asked_for() -> None:
    plain = json.loads(decomposition_json(solved(lotus())))
    assert "symmetry" not in plain["weights"]
    assert "asymmetry" not in plain["energy"]
    kept = json.loads(decomposition_json(solved(lotus(), weights={"symmetry": 0.5})))
    terms = kept["energy"]
    assert kept["weights"]["symmetry"] == 0.5
    total = terms["complexity"] + 0.1 * terms["smoothness_rad"] + 0.9 * terms["robustness"]
    assert terms["total"] == pytest.approx(total + 0.5 * terms["asymmetry"])


def test_alternatives_differ_and_come_in_order() -> None:
    found = alternatives(theta(), config(), 4)
    assert len(found) == 4
    totals = [solution.energy.total for solution in found]
    assert totals == sorted(totals)
    assert totals[0] == pytest.approx(solved(theta()).energy.total)
    assert all(solution.optimal for solution in found)
    assert len({solution.decomposition.mate for solution in found}) == 4


def test_alternatives_of_a_drawing_in_pieces_combine_theirs() -> None:
    points = [(0, 0), (9, 0), (0, 9), (50, 0), (59, 0), (50, 9), (0, 30)]
    corners = drawing_of(points, [(0, 1), (0, 2), (3, 4), (3, 5)])
    found = alternatives(corners, config(), 9)
    assert [len(solution.trails) for solution in found] == [2, 3, 3, 4]


@pytest.mark.parametrize("family", ["voronoi", "cactus"])
def test_refinement_of_any_graph_is_a_few_walks_over_everything(family: str) -> None:
    changed = 0
    for seed in range(16):
        graph = FAMILIES[family](np.random.default_rng(seed), 14)
        answer = solve_exactly(Problem(graph, Weights(0.1, 0.0)), 0)
        assert answer is not None
        before = trails_of(graph, answer.mate)
        trails, doubled = doubled_back(graph, before)
        runs = [t.segment for trail in trails for t in trail.traversals]
        assert weak_trails(graph, trails) == []
        assert set(runs) == set(range(graph.segments))
        assert {e for e in runs if runs.count(e) > 1} == set(doubled)
        for trail in trails:
            ends = [(2 * t.segment + t.reversed, 2 * t.segment + 1 - t.reversed) for t in trail.traversals]
            stops = [(graph.junction_of[a], graph.junction_of[b]) for a, b in ends]
            assert all(arrived == left for (_, arrived), (left, _) in pairwise(stops))
            assert trail.closed == (stops[0][0] == stops[-1][1])
        changed += trails != before
    assert changed > 3
