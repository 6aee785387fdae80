"""Steps put moves together without losing one, and repeat only what a hand does alike."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.instructions.order.walks import PLANNED, Part, Walk, bench_along, planned, walks, wire_along
from wrapit.instructions.order.moves import Move, moves_along
from wrapit.instructions.order.repeats import (
    LEAST_TIMES,
    LONGEST_PATTERN,
    SAME_MM,
    SAME_RAD,
    SAME_SHARE,
    Stretch,
    stretches_of,
)
from wrapit.jig.bench.model import Contact


def check(moves: tuple[Move, ...]) -> None:
    stretches, rest = stretches_of(moves)
    told = [move for stretch in stretches for move in stretch.moves]
    assert (*told, *rest) == moves
    assert len(rest) <= 1
    assert all(move.kind == "straight" for move in rest)
    for stretch in stretches:
        turns = [move for move in stretch.moves if move.kind != "straight"]
        assert len(turns) == stretch.times * len(stretch.pattern)
        assert tuple(turns[: len(stretch.pattern)]) == stretch.pattern
        assert stretch.lead == (stretch.moves[0] if stretch.moves[0].kind == "straight" else None)
        assert len(stretch.pattern) <= LONGEST_PATTERN
        assert stretch.times == 1 or stretch.times >= LEAST_TIMES
        for place, turn in enumerate(turns):
            check_alike(turn, stretch.pattern[place % len(stretch.pattern)])
        check_runs(stretch)
        check_period(stretch)


def check_alike(turn: Move, first: Move) -> None:
    assert turn.kind == first.kind
    assert turn.turn_rad * first.turn_rad > 0
    assert abs(turn.turn_rad - first.turn_rad) <= SAME_RAD
    assert near(turn.length_mm, first.length_mm)
    assert {contact.label for contact in turn.contacts} == {contact.label for contact in first.contacts}


def check_runs(stretch: Stretch) -> None:
    """Runs before the second and later ones are alike; that before the very first may be another."""
    runs, run = [], 0.0
    for move in stretch.moves:
        if move.kind == "straight":
            run = move.length_mm
        else:
            runs.append(run)
            run = 0.0
    length = len(stretch.pattern)
    for place in range(length + 1, len(runs)):
        first = place % length or length
        assert near(runs[place], runs[first])


def check_period(stretch: Stretch) -> None:
    """What is said once is the bends of one repeat and the runs between, end to end."""
    period = stretch.period
    assert tuple(move for move in period if move.kind != "straight") == stretch.pattern
    assert period[0] is stretch.turn
    assert all(a.end_mm == b.start_mm for a, b in itertools.pairwise(period))
    if stretch.times > 1 and stretch.plain:
        run = sum(move.length_mm for move in period[1:])
        assert near(run, stretch.lead.length_mm if stretch.lead is not None else 0.0)


def near(a: float, b: float) -> bool:
    return abs(a - b) <= max(SAME_MM, SAME_SHARE * max(a, b))


def turns() -> st.SearchStrategy[tuple[float, float, str]]:
    """Length of the run before (0 is none), angle, and the peg that it goes round, of few kinds."""
    return st.tuples(
        st.sampled_from([0.0, 8.0, 9.0, 20.0]),
        st.sampled_from([90.0, 95.0, -90.0, -60.0]),
        st.sampled_from(["", "", "", "A1"]),
    )


def moves_of(parts: list[tuple[float, float, str]], end_mm: float) -> tuple[Move, ...]:
    moves, at = [], 0.0
    for run, angle, hole in parts:
        if run:
            moves.append(Move("straight", at, at + run, 0.0))
            at += run
        contacts = (Contact(at, at + 3, "left" if angle > 0 else "right", "peg", 0, hole, 3.0),) * bool(hole)
        moves.append(Move("wrap" if hole else "curve", at, at + 3, math.radians(angle), contacts))
        at += 3
    return (*moves, Move("straight", at, at + end_mm, 0.0)) if end_mm else tuple(moves)


@given(st.lists(turns(), min_size=1, max_size=12), st.sampled_from([0.0, 10.0]))
@settings(max_examples=150)
def test_steps_expand_to_the_moves(parts: list[tuple[float, float, str]], end_mm: float) -> None:
    check(moves_of(parts, end_mm))


@given(st.lists(turns(), min_size=1, max_size=2, unique=True), st.integers(3, 7))
@settings(max_examples=60)
def test_what_repeats_is_said_once(pattern: list[tuple[float, float, str]], times: int) -> None:
    moves = moves_of(pattern * times, 0.0)
    stretches, _ = stretches_of(moves)
    assert len(stretches) == 1
    assert stretches[0].times >= times


@given(walks())
@settings(max_examples=40)
def test_along_wires(walk: Walk) -> None:
    bench = bench_along(walk)
    (wire,) = bench.wires
    check(moves_along(wire, bench.contacts[wire.name]))


@pytest.mark.parametrize("name", PLANNED)
def test_in_jigs_that_are_planned(name: str) -> None:
    for bench in planned(name).benches:
        for wire in bench.wires:
            check(moves_along(wire, bench.contacts[wire.name]))


@pytest.mark.parametrize("times", [1, 2, 3, 5])
def test_petals_repeat_from_three_on(times: int) -> None:
    petal = (Part(4, 220), Part(6), Part(3, -100), Part(6))
    moves = moves_along(wire_along(petal * times), ())
    stretches, _ = stretches_of(moves)
    assert [stretch.times for stretch in stretches] == ([times] if times >= 3 else [1, 1] * times)


def test_bends_to_other_sides_or_round_other_pegs_are_no_repeat() -> None:
    left, right, peg = (8.0, 90.0, ""), (8.0, -90.0, ""), (8.0, 90.0, "A1")
    for parts in itertools.permutations([left, right, peg]):
        stretches, _ = stretches_of(moves_of(list(parts), 0.0))
        assert [stretch.times for stretch in stretches] == [1, 1, 1]
