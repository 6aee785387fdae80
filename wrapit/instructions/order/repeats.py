"""Moves put together as a person would say them: a straight run with the bend after it, repeats once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from wrapit.instructions.order.moves import Move

# Moves are the same to the hand within these: a fifth of the length, and what an eye tells of an angle.
SAME_SHARE: Final = 0.2
SAME_MM: Final = 1.5
SAME_RAD: Final = math.radians(12)
# So often at least, or saying that it repeats takes longer than saying it; and the most moves of one repeat.
LEAST_TIMES: Final = 3
LONGEST_PATTERN: Final = 2


@dataclass(frozen=True)
class Stretch:
    """One step along a wire: all its `moves` end to end, and those of one repeat.

    `pattern` has the bends of one repeat, `lead` the straight run before the first, if there is one.
    """

    moves: tuple[Move, ...]
    pattern: tuple[Move, ...]
    lead: Move | None
    times: int = 1

    @property
    def period(self) -> tuple[Move, ...]:
        """The bends of one repeat, each with the run after it, up to the first bend of the next."""
        bends = [index for index, move in enumerate(self.moves) if move.kind != "straight"]
        return self.moves[bends[0] : bends[len(self.pattern)]] if self.times > 1 else self.moves[bends[0] :]

    @property
    def plain(self) -> bool:
        """Whether it is one bend, which may repeat after runs like that before the first."""
        return len(self.pattern) == 1 and (
            self.times == 1
            or _near(
                self.lead.length_mm if self.lead is not None else 0.0,
                sum(move.length_mm for move in self.period[1:]),
            )
        )

    @property
    def turn(self) -> Move:
        """The bend, curve or wrap that it is for; the first of a pattern."""
        return self.pattern[0]


def stretches_of(moves: Sequence[Move]) -> tuple[tuple[Stretch, ...], tuple[Move, ...]]:
    """The steps of a wire, and the straight run that is left at its end."""
    pairs: list[tuple[Move | None, Move]] = []
    lead: Move | None = None
    for move in moves:
        if move.kind == "straight":
            lead = move
        else:
            pairs.append((lead, move))
            lead = None
    stretches: list[Stretch] = []
    index = 0
    while index < len(pairs):
        length, times = _repeat(pairs, index)
        taken = pairs[index : index + length * times]
        stretches.append(
            Stretch(
                tuple(move for pair in taken for move in pair if move is not None),
                tuple(turn for _, turn in taken[:length]),
                taken[0][0],
                times,
            )
        )
        index += length * times
    return tuple(stretches), () if lead is None else (lead,)


def _repeat(pairs: Sequence[tuple[Move | None, Move]], first: int) -> tuple[int, int]:
    """(moves of one repeat, how often) from here on; (1, 1) where nothing repeats."""
    best = (1, 1)
    for length in range(1, LONGEST_PATTERN + 1):
        times = 1
        while _once_more(pairs, first, length, times):
            times += 1
        if times >= LEAST_TIMES and length * times > best[0] * best[1]:
            best = (length, times)
    return best


def _once_more(pairs: Sequence[tuple[Move | None, Move]], first: int, length: int, times: int) -> bool:
    """Whether what was done so many `times` from here on comes once more.

    The run before the very first bend may be another: it is told by itself.
    """
    for k in range(length):
        next_one = first + times * length + k
        if next_one >= len(pairs) or not _alike(pairs[first + k][1], pairs[next_one][1]):
            return False
        before = first + k if k else first + length
        if next_one != before and not _near(_run_mm(pairs[before]), _run_mm(pairs[next_one])):
            return False
    return True


def _alike(turn: Move, other: Move) -> bool:
    """Whether a hand bends the same twice."""
    return (
        turn.kind == other.kind
        and _round(turn) == _round(other)
        and turn.turn_rad * other.turn_rad > 0
        and abs(turn.turn_rad - other.turn_rad) <= SAME_RAD
        and _near(turn.length_mm, other.length_mm)
    )


def _run_mm(pair: tuple[Move | None, Move]) -> float:
    return pair[0].length_mm if pair[0] is not None else 0.0


def _round(turn: Move) -> tuple[tuple[str, str], ...]:
    """What a bend is made round, by name: a peg is told from the next, a wall isn't."""
    return tuple(dict.fromkeys((contact.around, contact.label) for contact in turn.contacts))


def _near(a: float, b: float) -> bool:
    return abs(a - b) <= max(SAME_MM, SAME_SHARE * max(a, b))
