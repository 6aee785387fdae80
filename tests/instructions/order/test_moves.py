"""Moves follow the wire from end to end, turn as it turns, and lie round walls that really stand there."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon

from tests.exports.pieces_for_tests import drawing_of, solution_of
from tests.instructions.order.walks import (
    PLANNED,
    REACH_MM,
    Part,
    Walk,
    bench_along,
    course,
    planned,
    walks,
    walls_inside,
    wire_along,
    with_bail,
)
from tests.jig.metal import arcs, circle, wires_of
from wrapit.config import Config
from wrapit.geometry import BezierChain, Region, joined, straight
from wrapit.instructions.order.moves import Move, moves_along
from wrapit.instructions.order.repeats import stretches_of
from wrapit.instructions.order.swings import STRAIGHT_RAD
from wrapit.jig.bench.model import Bench
from wrapit.jig.channel import SIDES
from wrapit.jig.sheet.sheet_kind import make
from wrapit.wires.mirror import mirrored
from wrapit.wires.model import Side, Wire

OTHER: dict[Side, Side] = {"left": "right", "right": "left"}
# How far behind the place of a wall's face there has to be wall.
FACE_MM = 0.2


def moves_of(bench: Bench) -> list[tuple[Wire, tuple[Move, ...]]]:
    return [(wire, moves_along(wire, bench.contacts[wire.name])) for wire in bench.wires]


def check_tiling(moves: Sequence[Move], length_mm: float) -> None:
    assert moves[0].start_mm == 0
    assert moves[-1].end_mm == pytest.approx(length_mm, abs=1e-3)
    assert [move.start_mm for move in moves[1:]] == [move.end_mm for move in moves[:-1]]
    assert all(move.length_mm > 0 for move in moves)


def check_turning(moves: Sequence[Move]) -> None:
    for move in moves:
        if move.kind == "straight":
            assert abs(move.turn_rad) < STRAIGHT_RAD
            assert move.contacts == ()
        elif move.kind != "bail":
            assert abs(move.turn_rad) >= STRAIGHT_RAD
        assert (move.kind == "wrap") == bool(move.contacts)
        assert all(SIDES[contact.side] * move.turn_rad > 0 for contact in move.contacts)


def check_walls(wire: Wire, moves: Sequence[Move], walls: Sequence[Region], reach_mm: float) -> None:
    """By shapely alone: from the wire to the wall's side there is wall within reach."""
    at_mm, points, normals = course(wire)
    for contact in (each for move in moves for each in move.contacts):
        if contact.around == "peg":
            continue
        index = int(np.searchsorted(at_mm, (contact.start_mm + contact.end_mm) / 2))
        far = reach_mm + FACE_MM if contact.around == "wall" else reach_mm + contact.rod_mm
        probe = points[index] + far * SIDES[contact.side] * normals[index]
        outline = Polygon(
            walls[contact.index].outer.sampled(0.005),
            [hole.sampled(0.005) for hole in walls[contact.index].holes],
        )
        assert LineString([points[index], probe]).intersects(outline)


@given(walks())
@settings(max_examples=80)
def test_moves_lie_end_to_end_and_turn_as_the_wire_does(walk: Walk) -> None:
    ((wire, moves),) = moves_of(bench_along(walk))
    check_tiling(moves, sum(part.length_mm for part in walk))
    check_turning(moves)
    assert sum(move.turn_rad for move in moves) == pytest.approx(
        math.radians(sum(part.turn_deg for part in walk)), abs=1e-3
    )
    check_walls(wire, moves, walls_inside(walk), REACH_MM)


@given(walks(), st.floats(2, 12), st.booleans())
@settings(max_examples=40)
def test_a_bail_is_one_move_and_the_others_turn_as_what_is_left_of_them(
    walk: Walk, length_mm: float, at_end: bool
) -> None:
    bench = bench_along(walk)
    bare = bench.wires[0]
    assume(bare.length_mm > length_mm + 1)
    wire = with_bail(bare, length_mm, at_end=at_end)
    moves = moves_along(wire, bench.contacts[wire.name])
    check_tiling(moves, bare.length_mm)
    check_turning(moves)
    assert [move.kind for move in moves].count("bail") == 1
    bail = moves[-1 if at_end else 0]
    assert bail.kind == "bail"
    assert bail.length_mm == pytest.approx(length_mm, abs=0.11)
    assert sum(move.turn_rad for move in moves) == pytest.approx(
        math.radians(sum(part.turn_deg for part in walk)), abs=1e-3
    )


@given(walks())
@settings(max_examples=40)
def test_the_mirror_image_has_the_mirrored_moves(walk: Walk) -> None:
    ((_, moves),) = moves_of(bench_along(walk))
    (wire,) = mirrored([wire_along(walk)])
    contacts = [
        replace(contact, side=OTHER[contact.side]) for contact in bench_along(walk).contacts[wire.name]
    ]
    assert [mirror_of(move) for move in moves_along(wire, contacts)] == [rounded(move) for move in moves]


Rounded = tuple[str, float, float, float, tuple[tuple[str, int], ...]]


def rounded(move: Move) -> Rounded:
    contacts = tuple((contact.side, contact.index) for contact in move.contacts)
    return move.kind, round(move.start_mm, 3), round(move.end_mm, 3), round(move.turn_rad, 3), contacts


def mirror_of(move: Move) -> Rounded:
    kind, start_mm, end_mm, turn_rad, contacts = rounded(move)
    return kind, start_mm, end_mm, -turn_rad, tuple((OTHER[side], index) for side, index in contacts)


@pytest.mark.parametrize("name", PLANNED)
def test_in_jigs_that_are_planned(name: str) -> None:
    for bench in planned(name).benches:
        for wire, moves in moves_of(bench):
            check_tiling(moves, wire.length_mm)
            check_turning(moves)
            check_walls(wire, moves, bench.walls, wire.diameter_mm / 2 + 0.2)


def polyline(*points: tuple[float, float]) -> BezierChain:
    return joined([straight(a, b) for a, b in itertools.pairwise(points)])


def by_hand(chain: BezierChain) -> tuple[Move, ...]:
    _, (wire,) = solution_of(drawing_of([chain]), [[(0, False)]])
    return moves_along(wire, ())


def test_a_square_is_four_bends_and_the_runs_between() -> None:
    moves = by_hand(polyline((10, 0), (20, 0), (20, 20), (0, 20), (0, 0), (10, 0)))
    assert [move.kind for move in moves] == ["straight", *["bend", "straight"] * 4]
    assert [round(math.degrees(move.turn_rad)) for move in moves] == [0, *[90, 0] * 4]
    runs = [move.length_mm for move in moves if move.kind == "straight"]
    assert runs == pytest.approx([10, 20, 20, 20, 10], abs=0.5)


@pytest.mark.parametrize(("size", "kind"), [(350, "loop"), (360, "loop"), (500, "spiral"), (170, "curve")])
@pytest.mark.parametrize("sign", [1, -1])
def test_round_ones_have_names(size: float, kind: str, sign: int) -> None:
    (move,) = moves_along(wire_along((Part(6, sign * size),)), ())
    assert move.kind == kind
    assert move.radius_mm == pytest.approx(6, rel=1e-3)


def test_a_circle_is_one_loop() -> None:
    (wire,) = wires_of([circle(8)])
    (move,) = moves_along(wire, ())
    assert (move.kind, round(math.degrees(move.turn_rad))) == ("loop", 360)


def test_a_hairpin_of_little_radius_is_a_fold() -> None:
    moves = moves_along(wire_along((Part(20), Part(1.2, 180), Part(20))), ())
    assert [move.kind for move in moves] == ["straight", "fold", "straight"]


@pytest.mark.parametrize("angle", [40, 90, 140])
def test_a_zigzag_is_one_step(angle: float) -> None:
    parts = [Part(10), *(part for k in range(6) for part in (Part(1, angle * (-1) ** k), Part(10)))]
    (stretch,), rest = stretches_of(moves_along(wire_along(tuple(parts)), ()))
    assert (len(stretch.pattern), stretch.times) == (2, 3)
    assert [move.kind for move in rest] == ["straight"]


def test_a_wrap_goes_along_one_side_of_its_wall_then_round_the_tip() -> None:
    """A petal round one wall: a wide side, the tip, and the other side."""
    wires = wires_of([arcs((0, 0), 0, (20, -60), (2, -110), (20, -60))])
    handling = make(wires, Config(drawing="x", jigs=["sheet"])).handling
    assert handling is not None
    (bench,) = handling.benches
    moves = [move for move in moves_along(wires[0], bench.contacts["wire-01"]) if move.kind == "wrap"]
    turned = [round(math.degrees(move.turn_rad)) for move in moves]
    assert turned == pytest.approx([-60, -110, -60], abs=6)
    assert moves[0].radius_mm > 3 * moves[1].radius_mm
    assert all(move.contacts[0].index == moves[0].contacts[0].index for move in moves)
