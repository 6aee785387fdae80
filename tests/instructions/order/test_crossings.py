"""What a wire passes over: found again by comparing every place with every other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import eye, spiral, woven
from tests.instructions.order.walks import Part, Walk, course, lines, tangle, walks, wire_along
from tests.jig.metal import line, wires_of
from wrapit.geometry import FloatArray
from wrapit.instructions.model import Crossing
from wrapit.instructions.order.crossings import ONE_PASS_DIAMETERS, crossings_in
from wrapit.wires.model import Wire
from wrapit.wires.stacking import SELF_DIAMETERS

# What sampling every 0.25 mm may miss of a distance, and of a place along the wire.
SAMPLED_MM = 0.25
SLACK_MM = 0.07


def apart(points: FloatArray, others: FloatArray) -> FloatArray:
    """All distances (n, m)."""
    return np.asarray(np.hypot(*(points[:, None] - others[None]).transpose(2, 0, 1)))


def thinned(wire: Wire) -> tuple[FloatArray, FloatArray]:
    at_mm, points, _ = course(wire)
    keep = np.unique(np.searchsorted(at_mm, np.arange(0, at_mm[-1], SAMPLED_MM)))
    return at_mm[keep], points[keep]


def check(wire: Wire, laid: tuple[Wire, ...], found: tuple[Crossing, ...]) -> None:
    """Every near place is near a crossing that names what it is near to; every crossing is one."""
    at_mm, points = thinned(wire)
    reach = wire.diameter_mm
    self_apart = apart(points, points)
    later_mm = at_mm[:, None] - at_mm[None] - SELF_DIAMETERS * reach
    nearest = {other.number: apart(points, thinned(other)[1]).min(axis=1) for other in laid}
    near_itself = [
        np.where(later_mm > least, self_apart, np.inf).min(axis=1) for least in (0, -2 * SAMPLED_MM)
    ]
    surely, perhaps = (
        {number: at_mm[distance < most_mm] for number, distance in (nearest | {wire.number: own}).items()}
        for own, most_mm in zip(near_itself, (reach - SLACK_MM, reach + SLACK_MM), strict=True)
    )
    for number, places in surely.items():
        told = [each for each in found if number in each.over]
        assert (len(places) > 0) <= (len(told) > 0)
    for each in found:
        assert set(each.over) <= set(perhaps)
        assert all(len(perhaps[number]) for number in each.over)
        assert 0 <= each.at_mm <= at_mm[-1] + SAMPLED_MM
    assert [each.at_mm for each in found] == sorted(each.at_mm for each in found)
    # As many passes as there are groups of near places, where sampling leaves no doubt.
    groups = [count_groups(np.unique(np.concatenate([*kept.values()])), reach) for kept in (surely, perhaps)]
    if groups[0] == groups[1] >= 0:
        assert len(found) == groups[0]


def count_groups(places: FloatArray, reach_mm: float) -> int:
    if not len(places):
        return 0
    gaps = np.diff(places)
    doubtful = np.abs(gaps - ONE_PASS_DIAMETERS * reach_mm) < 3 * SAMPLED_MM
    return -1 if doubtful.any() else 1 + int((gaps > ONE_PASS_DIAMETERS * reach_mm).sum())


@given(walks())
@settings(max_examples=25)
def test_a_wire_over_itself(walk: Walk) -> None:
    wire = wire_along(walk)
    found = crossings_in((wire,))[-1]
    assert {number for each in found for number in each.over} <= {wire.number}
    check(wire, (), found)


@pytest.mark.parametrize("wires", [eye()[1], spiral(), woven(3), *map(tangle, range(4))])
def test_wires_over_those_before_them(wires: tuple[Wire, ...]) -> None:
    for index, wire in enumerate(wires):
        laid = wires[:index]
        found = crossings_in((*laid, wire))[-1]
        allowed = {each.number for each in wires[: index + 1]}
        assert {number for each in found for number in each.over} <= allowed
        check(wire, laid, found)


def test_a_weave_passes_over_each_thread_that_lies_there() -> None:
    wires = woven(3)
    total = sum(len(crossings_in((*wires[:index], wire))[-1]) for index, wire in enumerate(wires))
    assert total > 0
    assert crossings_in((wires[0],))[-1] == ()


@given(st.floats(1.05, 20), st.lists(lines(), min_size=1, max_size=3))
@settings(max_examples=30)
def test_wires_side_by_side_are_no_crossing(times: float, parts: list[Part]) -> None:
    length_mm = sum(part.size_mm for part in parts)
    first, second = wires_of([line((0, 0), (length_mm, 0)), line((0, 1), (length_mm, 1))])
    away_mm = times * first.diameter_mm
    first, second = wires_of([line((0, 0), (length_mm, 0)), line((0, away_mm), (length_mm, away_mm))])
    assert crossings_in((first, second))[-1] == ()


@given(st.floats(15, 165), st.floats(-8, 8))
@settings(max_examples=30)
def test_two_straight_wires_cross_where_they_cross(angle_deg: float, offset_mm: float) -> None:
    direction = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    ends = [(offset_mm + sign * 30 * direction[0], sign * 30 * direction[1]) for sign in (-1, 1)]
    first, second = wires_of([line((-60, 0), (60, 0)), line(ends[0], ends[1])])
    (crossing,) = crossings_in((first, second))[-1]
    assert crossing.over == (1,)
    assert crossing.at_mm == pytest.approx(30, abs=0.11)
