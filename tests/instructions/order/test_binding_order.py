"""Ties are made once, when all their wires lie; what is laid next meets what lies there."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import drawing_of, solution_of
from wrapit.geometry import straight
from wrapit.instructions.order.binding_order import assembly_order, binding_length_mm, find_ties
from wrapit.wires.model import Wire


def star(count: int) -> tuple[Wire, ...]:
    """Wires out of one centre, each its own, and one more at the tip of the last."""
    rays = [straight((0, 0), (20 * math.cos(k), 20 * math.sin(k) * (1 + 0.01 * k))) for k in range(count)]
    tip = rays[-1].end
    rays.append(straight(tip, tip + np.array([5.0, 5.0])))
    return solution_of(drawing_of(rays), [[(index, False)] for index in range(len(rays))])[1]


@st.composite
def graphs(draw: st.DrawFn) -> tuple[Wire, ...]:
    """Straight wires between some points, each its own."""
    count = draw(st.integers(2, 7))
    points = [(10 * math.cos(2 * k) + k, 10 * math.sin(2 * k)) for k in range(count)]
    pairs = [(a, b) for a in range(count) for b in range(a)]
    chosen = draw(st.lists(st.sampled_from(pairs), min_size=1, max_size=9, unique=True))
    lines = [straight(points[a], points[b]) for a, b in chosen]
    return solution_of(drawing_of(lines), [[(index, False)] for index in range(len(lines))])[1]


def test_binding_law_for_two_passes() -> None:
    frame, thin = 1.02, 0.32
    expected = 5 * (math.pi * (frame + thin) + 2 * frame) + 80
    assert binding_length_mm(frame, thin, 5) == pytest.approx(expected)
    assert binding_length_mm(frame, thin, 5, passes=3) == pytest.approx(expected + 10 * frame)


def test_a_star_has_a_tie_for_all_and_one_for_two() -> None:
    assert sorted(len(tie.wires) for tie in find_ties(star(5), 0.32, 5)) == [2, 5]


@given(graphs())
@settings(max_examples=60)
def test_each_meeting_place_is_one_tie(wires: tuple[Wire, ...]) -> None:
    ties = find_ties(wires, 0.32, 5)
    met = {binding.junction for wire in wires for binding in wire.bindings}
    assert sorted(tie.junction for tie in ties) == sorted(met)
    assert len({tie.letter for tie in ties}) == len(ties)
    for tie in ties:
        mine = [b for wire in wires for b in wire.bindings if b.junction == tie.junction]
        assert tie.passes == max(2, len(mine))
        assert tie.binding_mm == pytest.approx(binding_length_mm(wires[0].diameter_mm, 0.32, 5, tie.passes))
        assert set(tie.wires) == {
            wire.number for wire in wires if any(b.junction == tie.junction for b in wire.bindings)
        }


@given(graphs(), st.data())
@settings(max_examples=80)
def test_ties_are_made_once_when_all_their_wires_lie(wires: tuple[Wire, ...], data: st.DataObject) -> None:
    ties = find_ties(wires, 0.32, 5)
    labels = data.draw(st.lists(st.integers(0, 3), min_size=len(wires), max_size=len(wires)))
    groups = [
        tuple(wire for wire, mine in zip(wires, labels, strict=True) if mine == label)
        for label in sorted(set(labels))
    ]
    placed: set[int] = set()
    made: list[str] = []
    order = assembly_order(groups, ties)
    for placement in order:
        met = {n for tie in ties if set(tie.wires) & set(placement.wires) for n in tie.wires}
        assert set(placement.joins) == met & placed
        waiting = {wire.number for wire in wires} - placed
        if not placement.joins and placed:
            # Nothing that still waits meets what lies there.
            assert not any(set(tie.wires) & placed and set(tie.wires) & waiting for tie in ties)
        assert not placed & set(placement.wires)
        placed |= set(placement.wires)
        assert all(set(tie.wires) <= placed for tie in placement.ties)
        made += [tie.letter for tie in placement.ties]
        # None that could be made is put off.
        assert {tie.letter for tie in ties if set(tie.wires) <= placed} == set(made)
    assert sorted(made) == sorted(tie.letter for tie in ties)
    assert sorted(placement.wires for placement in order) == sorted(
        tuple(wire.number for wire in group) for group in groups
    )


def test_the_longest_comes_first() -> None:
    wires = star(4)
    longest = max(wires, key=lambda wire: wire.length_mm)
    assert assembly_order([(wire,) for wire in wires], ())[0].wires == (longest.number,)


def test_many_wires_get_double_letters() -> None:
    rungs = [straight((0, float(y)), (10, float(y))) for y in range(30)]
    posts = [straight((10, float(y)), (20, float(y) + 0.3)) for y in range(30)]
    _, wires = solution_of(drawing_of(rungs + posts), [[(index, False)] for index in range(60)])
    letters = [tie.letter for tie in find_ties(wires, 0.32, 5)]
    assert letters[:2] + letters[24:28] == ["A", "B", "Y", "Z", "AA", "AB"]
    assert len(set(letters)) == 30
