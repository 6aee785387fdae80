"""How far a taut wire is off, against distances that are plain to see."""

from __future__ import annotations

import numpy as np
import pytest

from tests.jig.taut.ground import arc, joined
from wrapit.jig.taut.deviation import deviations, largest_within


def line(a: tuple[float, float], b: tuple[float, float], count: int = 101) -> np.ndarray:
    return np.linspace(a, b, count)


def test_a_wire_is_not_off_itself() -> None:
    drawn = arc(0, 0, 10, 0, 300)
    assert deviations(drawn, drawn) == pytest.approx(0, abs=1e-12)


def test_side_by_side_is_off_by_the_distance() -> None:
    assert deviations(line((0, 0), (40, 0)), line((0, 1.5), (40, 1.5), 2)) == pytest.approx(1.5)


def test_a_tooth_that_was_pulled_straight_is_off_by_its_height() -> None:
    drawn = joined(
        line((0, 0), (10, 0)),
        line((10, 0), (15, 5))[1:],
        line((15, 5), (20, 0))[1:],
        line((20, 0), (30, 0))[1:],
    )
    assert deviations(drawn, np.array([(0.0, 0), (30, 0)])).max() == pytest.approx(5)


def test_a_loop_that_was_pulled_straight_counts_with_its_height() -> None:
    drawn = joined(line((-10, 0), (0, 0)), arc(0, 3, 3, -90, 270)[1:], line((0, 0), (10, 0))[1:])
    off = deviations(drawn, np.array([(-10.0, 0), (10, 0)]))
    assert off.max() == pytest.approx(6, abs=0.1)
    assert off[[0, -1]] == pytest.approx(0)


def test_a_place_that_is_passed_at_another_time_does_not_count() -> None:
    """Drawn out along 0, up, and back along 4; taut back along 1: the way out is on it, the other 3 off."""
    drawn = joined(line((0, 0), (40, 0)), line((40, 0), (40, 4), 11)[1:], line((40, 4), (0, 4))[1:])
    taut = np.array([(0.0, 0), (40, 0), (40, 1), (0, 1)])
    off = deviations(drawn, taut)
    assert off[:95] == pytest.approx(0, abs=1e-9)
    assert off[-95:] == pytest.approx(3, abs=1e-9)
    # The other way round, the way back along 0 passes the drawn way out: no less off for that.
    swapped = deviations(drawn, np.array([(0.0, 4), (40, 4), (40, 0), (0, 0)]))
    assert swapped[10:90] == pytest.approx(4, abs=1e-9)
    assert swapped[-90:-10] == pytest.approx(4, abs=1e-9)


def test_twice_over_one_place_is_matched_round_by_round() -> None:
    drawn = joined(arc(0, 0, 5, 0, 360), arc(0, 0, 6, 0, 360))
    taut = joined(arc(0, 0, 5, 0, 360), arc(0, 0, 5, 0, 360))
    off = deviations(drawn, taut)
    assert off[:80] == pytest.approx(0, abs=1e-9)
    assert off[-80:] == pytest.approx(1, abs=0.02)


def test_from_a_point_it_is_the_distance_to_it() -> None:
    drawn = arc(0, 0, 4, 0, 356)
    for point in (np.zeros((1, 2)), np.zeros((2, 2))):
        assert deviations(drawn, point) == pytest.approx(4)


def test_largest_within_reads_vertices_and_between_them() -> None:
    off, at = np.array([0.0, 2.0, 1.0, 5.0]), np.array([0.0, 10.0, 20.0, 30.0])
    intervals = np.array([(0.0, 30.0), (0, 15), (12, 14), (15, 20), (25, 26), (10, 10)])
    assert largest_within(off, at, intervals) == pytest.approx([5, 2, 1.8, 1.5, 3.4, 2])
    assert largest_within(off, at, np.zeros((0, 2))).shape == (0,)
