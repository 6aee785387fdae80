"""All that wires can do at one junction on which blocks hang.

Few ends are matched in all ways, more in a best-first search. What a partial matching costs at least comes
from the best matchings of what is left, with as many wire ends as the wanted kind of option needs.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wrapit.decomposition.exact.cactus.blocks import Doors
from wrapit.decomposition.exact.cactus.modes import Branch, Mode, modes_of
from wrapit.decomposition.exact.cactus.offers import Offers
from wrapit.decomposition.exact.cactus.options import ENOUGH, Option, useful
from wrapit.decomposition.exact.cactus.passages import passage, passages
from wrapit.decomposition.exact.junction_matching import Matching

# Costs that differ by less are equal: their sums err by some 1e-14.
_ROUNDING = 1e-12

# How many ends a junction has for all its matchings to be tried (76 of 6 ends). 29 graphs of this kind take
# 0.08 / 0.11 / 0.07 / 0.14 / 0.28 s with 4 / 5 / 6 / 7 / 8.
_LISTED_ENDS = 6

# How many ends the search takes on: its six tables have a column for each subset of them (262 144 of 18
# ends), and each end more doubles that. From 12 on it makes no difference to those 29; beyond 18 it is
# memory that it bounds.
_MOST_ENDS = 18


class OutOfWorkError(Exception):
    """A junction takes more work than there is."""


@dataclass
class WorkCounter:
    """Counts the partial matchings looked at."""

    most: int
    done: int = 0

    def spend(self, amount: int) -> None:
        """Raises OutOfWorkError beyond the most."""
        self.done += amount
        if self.done > self.most:
            raise OutOfWorkError


def options_at(
    doors: Doors,
    branches: Sequence[Branch],
    pair: Sequence[Mapping[int, float]],
    weak_cost: float,
    work: WorkCounter,
) -> list[Option]:
    """What wires can do at a junction with all that hangs on it, cheapest first.

    `doors` are its half-edges of the block that it hangs on itself: two, one or, where the tree of
    blocks begins, none; then there is just one option. `pair[a][b]` is the cost of the transition
    a–b. Raises OutOfWorkError.
    """
    if not branches:
        apart = Option(0.0, False, 0)
        if len(doors) == 1 or doors[1] not in pair[doors[0]]:
            return [apart]
        a, b = doors
        return useful((apart, Option(pair[a][b], True, 0, ((a, b),))), weak_cost)
    ends = (*doors, *(h for branch in branches for h in branch.doors))
    if len(ends) > _MOST_ENDS:
        raise OutOfWorkError
    sizes = tuple(len(branch.doors) for branch in branches)
    offers = Offers(ends, len(doors), weak_cost)
    modes = modes_of(branches, weak_cost)
    if len(ends) <= _LISTED_ENDS:
        for mode in sorted(modes, key=lambda mode: mode.cost):
            for wires, matchings in passages(len(doors), sizes, mode.through):
                work.spend(1)
                cost, pairs = min(
                    [
                        (sum([pair[ends[i]].get(ends[j], math.inf) for i, j in pairs]), pairs)
                        for pairs in matchings
                    ]
                )
                offers.take(mode, wires, mode.cost + cost, pairs)
    else:
        place = {h: i for i, h in enumerate(ends)}
        below = [{place[b]: cost for b, cost in pair[a].items() if place[b] < i} for i, a in enumerate(ends)]
        _Search(len(doors), sizes, modes, below, weak_cost, offers).run(work)
    return offers.useful()


class Pattern(NamedTuple):
    """Whether a wire passes between the own doors, whether the wires at them are the only ones here,
    how many wire ends there are besides at least, and how many wires the own doors have."""

    through: bool
    alone: bool
    ends: int
    owners: int


# All patterns by the number of own doors. An owner that doesn't pass has a wire end for each door, and
# wires that are closed here have two each: that is what the numbers of ends count.
_PATTERNS = {
    0: (Pattern(False, True, 2, 1), Pattern(False, False, 4, 0)),
    1: (Pattern(False, True, 1, 1), Pattern(False, False, 3, 1)),
    2: (
        Pattern(True, True, 0, 1),
        Pattern(False, True, 2, 2),
        Pattern(True, False, 2, 1),
        Pattern(False, False, 4, 2),
    ),
}


class _State(NamedTuple):
    """A matching of the ends that aren't `left`, a set of bits; so many of them `loose`."""

    mode: int
    left: int
    cost: float
    loose: int
    pairs: Matching


class _Wanted(NamedTuple):
    """Options that may be of use, with a pattern in some mode: how many loose ends they need, how much
    they cost besides transitions (`more`), or how much if all wires that no branch spares that are weak
    (`weak`, with half a weak wire for each loose end), and below which cost they are of use."""

    alone: bool
    ends: int
    more: float
    weak: float
    worth: float


class _Search:
    """Best first; what is found makes other kinds of options needless, and so the search shorter."""

    def __init__(
        self,
        doors: int,
        sizes: tuple[int, ...],
        modes: Sequence[Mode],
        below: Sequence[Mapping[int, float]],
        weak_cost: float,
        offers: Offers,
    ) -> None:
        self._doors, self._sizes, self._modes, self._below = doors, sizes, modes, below
        self._weak_cost, self._offers = weak_cost, offers
        self._tables = _tables(below, weak_cost)
        seconds = {
            doors + sum(sizes[: branch + 1]) - 1: branch for branch, size in enumerate(sizes) if size == 2
        }
        self._loops = [
            {i for i, branch in seconds.items() if mode.through[branch]} for mode in modes
        ]  # ends that would close a ring with the end before them
        self._passed: set[tuple[int, bool]] = set()
        self._wanted: dict[int, list[_Wanted]] = {}

    def run(self, work: WorkCounter) -> None:
        """Takes what is worth it. Raises OutOfWorkError."""
        everything = (1 << len(self._below)) - 1
        states: Iterable[_State] = [
            _State(number, everything, mode.cost, 0, ()) for number, mode in enumerate(self._modes)
        ]
        heap: list[tuple[float, int, int, _State]] = []  # of equal bounds, what is nearest to its end
        count = 0
        while True:
            for state in states:
                if (bound := self._at_least(state)) < math.inf:
                    count += 1
                    heapq.heappush(heap, (bound - bound % _ROUNDING, state.left, count, state))
            if not heap:
                return
            bound, _, _, state = heapq.heappop(heap)
            if self._at_least(state) > bound + _ROUNDING:
                states = [state]  # what was found since then has made some kinds needless
                continue
            work.spend(1)
            states = self._extended(state) if state.left else ()
            if not state.left:
                self._look(state)

    def _extended(self, state: _State) -> Iterator[_State]:
        """What may become of the last end that is left."""
        mode, left, cost, loose, pairs = state
        i = left.bit_length() - 1
        rest = left ^ (1 << i)
        yield _State(mode, rest, cost, loose + 1, pairs)
        closing = i - 1 if i in self._loops[mode] else -1
        for j, more in self._below[i].items():
            if rest >> j & 1 and j != closing:
                yield _State(mode, rest ^ (1 << j), cost + more, loose, (*pairs, (j, i)))

    def _at_least(self, state: _State) -> float:
        """A lower bound on the cost of what is wanted still; infinite where nothing is."""
        number, left, cost, loose, _ = state
        if number not in self._wanted:
            self._wanted[number] = list(self._still_wanted(number))
        least, tables = math.inf, self._tables
        for alone, ends, more, weak, worth in self._wanted[number]:
            missing = ends - loose
            if alone and missing < 0:
                continue
            bound = cost + more + tables[missing if missing > 0 else 0][left]
            if not alone:
                bound = max(bound, cost + weak + self._weak_cost / 2 * loose + tables[-1][left])
            if bound < worth and bound < least:
                least = bound
        return least

    def _still_wanted(self, number: int) -> Iterator[_Wanted]:
        mode, limits = self._modes[number], self._offers.limits
        for through, alone, ends, owners in _PATTERNS[self._doors]:
            missing = ends - mode.ends
            weak = self._weak_cost * ((mode.ends + self._doors) / 2 - owners) - mode.spared
            if alone:
                if (number, through) not in self._passed:
                    kinds = mode.contacts.items() if self._doors else [(ENOUGH, 0.0)]
                    worth = max(limits[through, n] - more for n, more in kinds)
                    yield _Wanted(True, missing, 0.0, 0.0, worth - _ROUNDING)
            elif not self._doors:
                yield _Wanted(False, missing, 0.0, weak, limits[through, ENOUGH] - _ROUNDING)
            else:
                yield _Wanted(False, missing, 0.0, weak, limits[through, 1] - _ROUNDING)
                # Here the wires at the doors, taken as one, need a branch that spares them too.
                weak += self._weak_cost
                yield _Wanted(False, missing, mode.enough, weak, limits[through, ENOUGH] - _ROUNDING)

    def _look(self, state: _State) -> None:
        mode = self._modes[state.mode]
        wires = passage(self._doors, self._sizes, mode.through, state.pairs)
        if wires is not None:
            self._offers.take(mode, wires, state.cost, state.pairs)
            if wires.alone:
                # What else there is depends on the branches alone: dearer matchings are of no use.
                self._passed.add((state.mode, wires.through))
            self._wanted.clear()


def _tables(pair: Sequence[Mapping[int, float]], weak_cost: float) -> list[list[float]]:
    """For each set of ends the least cost of a matching: with at least 0 … 4 ends left loose, and one
    in which each loose end costs half a weak wire."""
    tables = np.full((6, 1 << len(pair)), math.inf)
    tables[[0, -1], 0] = 0.0
    for i, mates in enumerate(pair):
        without, added = tables[:, : 1 << i], tables[:, 1 << i : 2 << i]
        added[:] = without[[0, 0, 1, 2, 3, 5]]
        added[-1] += weak_cost / 2
        for j, cost in mates.items():
            before, after = (part.reshape(6, -1, 2, 1 << j) for part in (without, added))
            np.minimum(after[:, :, 1], before[:, :, 0] + cost, out=after[:, :, 1])
    return tables.tolist()
