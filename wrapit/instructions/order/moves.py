"""What the hand does along a wire: straight runs, wraps round walls, bends and curves without one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal

from wrapit.instructions.order.swings import (
    LEAST_RUN_MM,
    NO_TURN_RAD,
    SLACK_SHARE,
    STRAIGHT_RAD,
    Line,
    at_corners,
    parted,
    swings,
)
from wrapit.jig.bench.model import Contact
from wrapit.jig.channel import SIDES
from wrapit.jig.paired.hairpins import hairpins
from wrapit.wires.model import Wire

MoveKind = Literal["straight", "wrap", "bend", "curve", "fold", "loop", "spiral", "bail", "hairpin"]

# From a fold on the wire lies back on itself; from a loop on it closes; from a spiral on it goes on round.
FOLD_RAD, LOOP_RAD, SPIRAL_RAD = math.radians(155), math.radians(330), math.radians(405)
# A bend is what pliers do: all its turning within four thicknesses of wire, a radius under three.
BEND_MM: Final = 4.0
BEND_RADIUS_MM: Final = 3.0
# Spans round one wall that lie this near each other are one wrap to the hand, wherever the wall has a gap.
SAME_WRAP_MM: Final = 3.0
# Bends that follow one another to one side are one sweep where their radii differ by no more than this, or by
# no more than that where one of them is slight.
SAME_RATIO: Final = 2.0
SLIGHT_RATIO: Final = 3.0
SLIGHT_RAD: Final = math.radians(25)


@dataclass(frozen=True)
class Move:
    """One thing that the hand does along a span of a wire, by arc length.

    `turn_rad` is positive to the left; a wrap has the `contacts` that it is made round, in their order.
    """

    kind: MoveKind
    start_mm: float
    end_mm: float
    turn_rad: float
    contacts: tuple[Contact, ...] = ()

    @property
    def length_mm(self) -> float:
        """Along the wire."""
        return self.end_mm - self.start_mm

    @property
    def radius_mm(self) -> float:
        """Mean radius of the wire's centreline."""
        return self.length_mm / abs(self.turn_rad) if self.turn_rad else math.inf


def moves_along(wire: Wire, contacts: Sequence[Contact]) -> tuple[Move, ...]:
    """The moves of one wire, end to end from 0 to its length.

    A wrap takes in all bending to its wall's side that follows on without a straight run, along the next
    wall too, up to a corner; between wraps the wire is parted by the side to which it bends.
    """
    line = Line.of(wire)
    low, high = _beside_bail(line, wire)
    moves: list[Move] = []
    reached = low
    for first, last, contact in _wraps(line, contacts, low, high):
        moves += _free(line, reached, first)
        moves += (
            replace(_move(line, "wrap", a, b), contacts=(contact,)) for a, b in at_corners(line, first, last)
        )
        reached = last
    moves += _free(line, reached, high)
    moves = _turned_back(_settled(_one_sweep(moves)), wire)
    before = [_move(line, "bail", 0, low)] if low > 0 else []
    after = [_move(line, "bail", high, line.count)] if high < line.count else []
    return (*before, *moves, *after)


def _beside_bail(line: Line, wire: Wire) -> tuple[int, int]:
    """First and last place of what is left without the loop to hang the piece from."""
    if wire.bail is None:
        return 0, line.count
    if wire.bail.start_mm <= 0:
        return line.index(wire.bail.end_mm), line.count
    return 0, line.index(wire.bail.start_mm)


def _move(line: Line, kind: MoveKind, first: int, last: int) -> Move:
    return Move(kind, float(line.at_mm[first]), float(line.at_mm[last]), line.turned(first, last))


def _wraps(line: Line, contacts: Sequence[Contact], low: int, high: int) -> list[tuple[int, int, Contact]]:
    """(first, last, contact) of each wrap between two places: contacts inside a bend, with all of the bend.

    Contacts of one wall that follow one another are one wrap; where two overlap, the longer keeps its span.
    """
    merged: list[tuple[int, int, Contact]] = []
    for contact in contacts:
        first, last = max(low, line.index(contact.start_mm)), min(high, line.index(contact.end_mm))
        if last <= first or line.turned(first, last) * SIDES[contact.side] <= NO_TURN_RAD:
            continue
        before = merged[-1] if merged else None
        if before is not None and _one_wrap(line, before, first, contact):
            merged[-1] = (before[0], max(before[1], last), before[2])
        else:
            merged.append((first, last, contact))
    apart = _apart(line, merged)
    grown = [
        _grown(
            line,
            wrap,
            apart[index - 1][1] if index else low,
            apart[index + 1][0] if index + 1 < len(apart) else high,
        )
        for index, wrap in enumerate(apart)
    ]
    bent = [wrap for wrap in grown if abs(line.turned(wrap[0], wrap[1])) >= STRAIGHT_RAD]
    return _apart(line, bent)


def _one_wrap(line: Line, before: tuple[int, int, Contact], first: int, contact: Contact) -> bool:
    same = (before[2].around, before[2].index, before[2].side) == (
        contact.around,
        contact.index,
        contact.side,
    )
    gap = line.turning[before[1] : first]
    return (
        same
        and line.length(min(before[1], first), first) <= SAME_WRAP_MM
        and bool((gap * SIDES[contact.side] >= -1e-3).all())
    )


def _apart(line: Line, wraps: Sequence[tuple[int, int, Contact]]) -> list[tuple[int, int, Contact]]:
    """The same without overlaps: longer ones first, what is left of the others if that is something."""
    taken: list[tuple[int, int, Contact]] = []
    for start, end, contact in sorted(wraps, key=lambda wrap: wrap[0] - wrap[1]):
        first, last = start, end
        for a, b, _ in taken:
            if first < b and a < last:
                first, last = (b, last) if first >= a else (first, a)
        if last > first and line.turned(first, last) * SIDES[contact.side] > NO_TURN_RAD:
            taken.append((first, last, contact))
    return sorted(taken, key=lambda wrap: wrap[0])


def _grown(line: Line, wrap: tuple[int, int, Contact], low: int, high: int) -> tuple[int, int, Contact]:
    """A wrap with the bending before and after it that goes on the same way, between two places."""
    first, last, contact = wrap
    sign = SIDES[contact.side]
    least = SLACK_SHARE * abs(line.turned(first, last)) / (last - first)
    while first > low and sign * line.turning[first - 1] > least:
        first -= 1
    while last < high and sign * line.turning[last] > least:
        last += 1
    return first, last, contact


def _free(line: Line, first: int, last: int) -> Iterator[Move]:
    """The moves of a span without a wall: swings to one side, and the straight runs within and between."""
    for begin, end in swings(line, first, last):
        for a, b in parted(line, begin, end):
            yield _move(line, _kind(line.turned(a, b), line.length(a, b)), a, b)


def _kind(turn_rad: float, length_mm: float) -> MoveKind:
    """What a hand calls it."""
    turned = abs(turn_rad)
    if turned < STRAIGHT_RAD:
        return "straight"
    tight = length_mm / turned <= BEND_RADIUS_MM
    if turned >= SPIRAL_RAD:
        return "spiral"
    if turned >= LOOP_RAD:
        return "loop"
    if turned >= FOLD_RAD and tight:
        return "fold"
    return "bend" if tight and length_mm <= BEND_MM else "curve"


def _one_sweep(moves: Sequence[Move]) -> list[Move]:
    """Wraps that go on into one another as one, slight curves too; what hardly bends is straight."""
    swept: list[Move] = []
    for move in moves:
        before = swept[-1] if swept else None
        if before is not None and "wrap" in (before.kind, move.kind) and _goes_on(before, move):
            swept[-1] = _joined(before, move, "wrap")
        else:
            swept.append(move)
    return [
        replace(move, kind="straight", contacts=()) if abs(move.turn_rad) < STRAIGHT_RAD else move
        for move in swept
    ]


def _goes_on(before: Move, move: Move) -> bool:
    """Whether two bends to one side are one to the hand: about as tight, or one of them slight."""
    if before.turn_rad * move.turn_rad <= 0 or {before.kind, move.kind} - {"wrap", "curve"}:
        return False
    if any(contact.around != "wall" for contact in (*before.contacts, *move.contacts)):
        return False
    slight = min(abs(before.turn_rad), abs(move.turn_rad)) < SLIGHT_RAD
    ratio = before.radius_mm / move.radius_mm
    return max(ratio, 1 / ratio) <= (SLIGHT_RATIO if slight else SAME_RATIO)


def _settled(moves: Sequence[Move]) -> list[Move]:
    """Straight runs that are too short go to what comes after (or before, at the end); runs in a row join."""
    settled: list[Move] = []
    for move in moves:
        _settle(settled, move)
    while len(settled) > 1 and _too_short(settled[-1]):
        last, before = settled.pop(), settled.pop()
        _settle(settled, _joined(before, last, before.kind))
    return settled


def _turned_back(moves: Sequence[Move], wire: Wire) -> list[Move]:
    """The same, with the bends in which the wire turns back to lie beside itself called so."""
    middles = [(each.middle_mm, SIDES[each.side]) for each in hairpins(wire)]
    return [
        replace(move, kind="hairpin")
        if any(
            move.start_mm < at_mm < move.end_mm and sign * move.turn_rad >= FOLD_RAD
            for at_mm, sign in middles
        )
        else move
        for move in moves
    ]


def _settle(settled: list[Move], move: Move) -> None:
    """Adds a move, joined with those before that are no moves of their own."""
    while settled and settled[-1].kind == "straight" and (move.kind == "straight" or _too_short(settled[-1])):
        move = _joined(settled.pop(), move, move.kind)
    settled.append(move)


def _too_short(move: Move) -> bool:
    return move.kind == "straight" and move.length_mm < LEAST_RUN_MM


def _joined(before: Move, move: Move, kind: MoveKind) -> Move:
    """Both as one of this kind, unless they bend too little for it together, or too much for a run."""
    turned, length_mm = before.turn_rad + move.turn_rad, move.end_mm - before.start_mm
    if kind == "straight" or abs(turned) < STRAIGHT_RAD:
        return Move(_kind(turned, length_mm), before.start_mm, move.end_mm, turned)
    return Move(kind, before.start_mm, move.end_mm, turned, (*before.contacts, *move.contacts))
