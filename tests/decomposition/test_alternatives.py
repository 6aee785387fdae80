"""The best different decompositions, in order."""

from __future__ import annotations

import pytest

from tests.decomposition.asking import config, solved
from tests.decomposition.drawings import drawing_of, theta
from wrapit.decomposition.stage import alternatives


def test_alternatives_differ_and_come_in_order() -> None:
    found = alternatives(theta(), config(), 4)
    assert len(found) == 4
    totals = [solution.energy.total for solution in found]
    assert totals == sorted(totals)
    assert totals[0] == pytest.approx(solved(theta()).energy.total)
    assert all(solution.optimal for solution in found)
    assert len({solution.decomposition.mate for solution in found}) == 4


def test_annealing_refers_to_the_proven_ones() -> None:
    found, expected = (alternatives(theta(), config(solver=solver), 3) for solver in ("annealing", "exact"))
    assert [each.decomposition.mate for each in found] == [each.decomposition.mate for each in expected]
    assert {each.solver for each in found} == {"exact"}


def test_alternatives_of_a_drawing_in_pieces_combine_theirs() -> None:
    points = [(0, 0), (9, 0), (0, 9), (50, 0), (59, 0), (50, 9), (0, 30)]
    corners = drawing_of(points, [(0, 1), (0, 2), (3, 4), (3, 5)])
    found = alternatives(corners, config(), 9)
    assert [len(solution.trails) for solution in found] == [2, 3, 3, 4]
