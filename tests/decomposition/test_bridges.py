"""Bridges: where they are offered, and where they pay."""

from __future__ import annotations

import pytest

from tests.decomposition.asking import config, wires
from tests.decomposition.drawings import drawing_of, gap_drawing
from wrapit.decomposition.bridges import with_bridges
from wrapit.decomposition.solvers import SOLVERS
from wrapit.decomposition.stage import decompose


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
