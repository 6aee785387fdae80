"""What the hand does along a wire: straight runs, wraps round walls, bends and curves without one."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import runs
from wrapit.jig.bench.model import Contact
from wrapit.jig.channel import SIDES
from wrapit.wires.model import Wire

MoveKind = Literal["straight", "wrap", "bend", "curve", "fold", "loop", "spiral", "bail"]

# How often a wire is looked at: a tenth of the thickness of the usual one.
STEP_MM: Final = 0.1
# Less turning than this is straight to a hand.
STRAIGHT_RAD: Final = math.radians(12)
# From a fold on the wire lies back on itself; from a loop on it closes; from a spiral on it goes on round.
FOLD_RAD, LOOP_RAD, SPIRAL_RAD = math.radians(155), math.radians(330), math.radians(405)
# A bend is what pliers do: all its turning within four thicknesses of wire, a radius under three.
BEND_MM: Final = 4.0
BEND_RADIUS_MM: Final = 3.0
# Spans round one wall that lie this near each other are one wrap to the hand, wherever the wall has a gap.
SAME_WRAP_MM: Final = 3.0
# Where a wire bends less than this share of a curve's mean, along so much, it is a straight run within it.
SLACK_SHARE: Final = 0.25
SLACK_MM: Final = 3.0
# Bends that follow one another to one side are one sweep where their radii differ by no more than this, or by
# no more than that where one of them is slight.
SAME_RATIO: Final = 2.0
SLIGHT_RATIO: Final = 3.0
SLIGHT_RAD: Final = math.radians(25)
# A straight run shorter than this is no run: the hand goes from one bend into the next.
LEAST_RUN_MM: Final = 1.5


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
    wall too; between wraps the wire is parted by the side to which it bends.
    """
    line = _Line.of(wire)
    wraps = _wraps(line, contacts)
    moves: list[Move] = []
    reached = 0
    for first, last, contact in wraps:
        moves += _free(line, reached, first)
        moves.append(replace(line.move("wrap", first, last), contacts=(contact,)))
        reached = last
    moves += _free(line, reached, line.count)
    moves = _settled(_one_sweep(moves))
    return tuple(_with_bail(wire, moves)) if wire.bail is not None else tuple(moves)


@dataclass(frozen=True, eq=False)
class _Line:
    """Places (n + 1,) along a wire, and its turning (n,) between them in rad."""

    at_mm: FloatArray
    turning: FloatArray

    @staticmethod
    def of(wire: Wire) -> _Line:
        lengths = ArcLength(wire.centreline)
        at_mm = lengths.stations(STEP_MM)
        tangents = wire.centreline.derivative(lengths.parameter(at_mm))
        headings = np.unwrap(np.arctan2(tangents[:, 1], tangents[:, 0]))
        return _Line(at_mm, np.diff(headings))

    @property
    def count(self) -> int:
        return len(self.turning)

    def turned(self, first: int, last: int) -> float:
        return float(self.turning[first:last].sum())

    def length(self, first: int, last: int) -> float:
        return float(self.at_mm[last] - self.at_mm[first])

    def move(self, kind: MoveKind, first: int, last: int) -> Move:
        start, end = float(self.at_mm[first]), float(self.at_mm[last])
        return Move(kind, start, end, self.turned(first, last))

    def index(self, at_mm: float) -> int:
        return int(np.clip(np.searchsorted(self.at_mm, at_mm - 1e-9), 0, self.count))


def _wraps(line: _Line, contacts: Sequence[Contact]) -> list[tuple[int, int, Contact]]:
    """(first, last, contact) of each wrap: contacts inside a bend, with all of the bend.

    Contacts of one wall that follow one another are one wrap; where two overlap, the longer keeps its span.
    """
    merged: list[tuple[int, int, Contact]] = []
    for contact in contacts:
        first, last = line.index(contact.start_mm), line.index(contact.end_mm)
        if line.turned(first, last) * SIDES[contact.side] <= 0:
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
            apart[index - 1][1] if index else 0,
            apart[index + 1][0] if index + 1 < len(apart) else line.count,
        )
        for index, wrap in enumerate(apart)
    ]
    bent = [wrap for wrap in grown if abs(line.turned(wrap[0], wrap[1])) >= STRAIGHT_RAD]
    return _apart(line, bent)


def _one_wrap(line: _Line, before: tuple[int, int, Contact], first: int, contact: Contact) -> bool:
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


def _apart(line: _Line, wraps: Sequence[tuple[int, int, Contact]]) -> list[tuple[int, int, Contact]]:
    """The same without overlaps: longer ones first, what is left of the others if that is something."""
    taken: list[tuple[int, int, Contact]] = []
    for start, end, contact in sorted(wraps, key=lambda wrap: wrap[0] - wrap[1]):
        first, last = start, end
        for a, b, _ in taken:
            if first < b and a < last:
                first, last = (b, last) if first >= a else (first, a)
        if last > first and line.turned(first, last) * SIDES[contact.side] > 0:
            taken.append((first, last, contact))
    return sorted(taken, key=lambda wrap: wrap[0])


def _grown(line: _Line, wrap: tuple[int, int, Contact], low: int, high: int) -> tuple[int, int, Contact]:
    """A wrap with the bending before and after it that goes on the same way, between two places."""
    first, last, contact = wrap
    sign = SIDES[contact.side]
    least = SLACK_SHARE * abs(line.turned(first, last)) / (last - first)
    while first > low and sign * line.turning[first - 1] > least:
        first -= 1
    while last < high and sign * line.turning[last] > least:
        last += 1
    return first, last, contact


def _free(line: _Line, first: int, last: int) -> Iterator[Move]:
    """The moves of a span without a wall: swings to one side, and the straight runs within and between."""
    for begin, end in _swings(line, first, last):
        for a, b in _parted(line, begin, end):
            yield line.move(_kind(line, a, b), a, b)


def _swings(line: _Line, first: int, last: int) -> list[tuple[int, int]]:
    """The span parted where the wire bends to the other side; slight swings join their neighbours."""
    if last <= first:
        return []
    bounds = [first, *(first + 1 + np.flatnonzero(np.diff(line.turning[first:last] > 0))), last]
    spans = [(int(a), int(b)) for a, b in itertools.pairwise(bounds)]
    while len(spans) > 1:
        turned = [abs(line.turned(a, b)) for a, b in spans]
        least = int(np.argmin(turned))
        if turned[least] >= STRAIGHT_RAD:
            break
        low, high = max(0, least - 1), min(len(spans), least + 2)
        spans[low:high] = [(spans[low][0], spans[high - 1][1])]
    return spans


def _parted(line: _Line, first: int, last: int) -> list[tuple[int, int]]:
    """A swing with its straight runs cut out: where it bends much less than on the whole."""
    turned = abs(line.turned(first, last))
    if turned < STRAIGHT_RAD:
        return [(first, last)]
    slack = np.abs(line.turning[first:last]) < SLACK_SHARE * turned / (last - first)
    cuts = {first, last}
    for a, b in runs(slack):
        # At the ends of a swing, any straight run that is one; within it, long ones alone.
        at_end = a == 0 or b == last - first - 1
        if line.length(first + a, first + b + 1) >= (LEAST_RUN_MM if at_end else SLACK_MM):
            cuts |= {first + a, first + b + 1}
    return list(itertools.pairwise(sorted(cuts)))


def _kind(line: _Line, first: int, last: int) -> MoveKind:
    turned, length = abs(line.turned(first, last)), line.length(first, last)
    if turned < STRAIGHT_RAD:
        return "straight"
    tight = length / turned <= BEND_RADIUS_MM
    if turned >= SPIRAL_RAD:
        return "spiral"
    if turned >= LOOP_RAD:
        return "loop"
    if turned >= FOLD_RAD and tight:
        return "fold"
    return "bend" if tight and length <= BEND_MM else "curve"


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
    if before.turn_rad * move.turn_rad <= 0 or {before.kind, move.kind} - {"wrap", "curve", "straight"}:
        return False
    if any(contact.around != "wall" for contact in (*before.contacts, *move.contacts)):
        return False
    if "straight" in (before.kind, move.kind):
        return False
    slight = min(abs(before.turn_rad), abs(move.turn_rad)) < SLIGHT_RAD
    ratio = before.radius_mm / move.radius_mm
    return max(ratio, 1 / ratio) <= (SLIGHT_RATIO if slight else SAME_RATIO)


def _settled(moves: Sequence[Move]) -> list[Move]:
    """Straight runs that are too short go to what comes after (or before, at the end); runs in a row join."""
    settled: list[Move] = []
    for move in moves:
        before = settled[-1] if settled else None
        if before is not None and before.kind == move.kind == "straight":
            settled[-1] = _joined(before, move, "straight")
        elif before is not None and before.kind == "straight" and before.length_mm < LEAST_RUN_MM:
            settled[-1] = _joined(before, move, move.kind)
        else:
            settled.append(move)
    if len(settled) > 1 and settled[-1].kind == "straight" and settled[-1].length_mm < LEAST_RUN_MM:
        last = settled.pop()
        settled[-1] = _joined(settled[-1], last, settled[-1].kind)
    return settled


def _joined(before: Move, move: Move, kind: MoveKind) -> Move:
    turned = before.turn_rad + move.turn_rad
    return Move(kind, before.start_mm, move.end_mm, turned, (*before.contacts, *move.contacts))


def _with_bail(wire: Wire, moves: Sequence[Move]) -> Iterator[Move]:
    """The moves with those of the loop to hang the piece from as one."""
    bail = wire.bail
    assert bail is not None
    start, end = max(bail.start_mm, 0.0), min(bail.end_mm, moves[-1].end_mm)
    one = Move("bail", start, end, 0.0)
    if start <= moves[0].start_mm:
        yield one
    for move in moves:
        kept = replace(move, start_mm=max(move.start_mm, end)) if start <= 0 else move
        kept = kept if start <= 0 else replace(kept, end_mm=min(kept.end_mm, start))
        if kept.length_mm > 1e-6:
            yield kept
    if start > moves[0].start_mm:
        yield one
