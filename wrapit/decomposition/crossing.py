"""All that wires can do at one junction on which blocks hang.

A best-first search over the matchings at the junction. What a partial matching costs at least comes
from the best matchings of what is left, with as many wire ends as the wanted kind of option needs.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from wrapit.decomposition.blocks import Doors
from wrapit.decomposition.local import Matching
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.modes import Branch, modes_of
from wrapit.decomposition.options import ENOUGH, Kind, Option, surcharge, useful
from wrapit.decomposition.passages import Passage, passage

_MOST_ENDS = 18  # the tables have a column for each subset of them


class OutOfWorkError(Exception):
    """A junction takes more work than there is."""


@dataclass
class Work:
    """Counts the partial matchings looked at."""

    most: int
    done: int = 0

    def spend(self, amount: int) -> None:
        """Raises OutOfWorkError beyond the most."""
        self.done += amount
        if self.done > self.most:
            raise OutOfWorkError


class Pattern(NamedTuple):
    """Whether a wire passes between the own doors, whether the wires at them are the only ones here,
    how many wire ends there are besides at least, and how many wires the own doors have."""

    through: bool
    alone: bool
    ends: int
    owners: int


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


def options_at(
    doors: Doors,
    branches: Sequence[Branch],
    pair: Sequence[Mapping[int, float]],
    weak_cost: float,
    work: Work,
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
    return _Search(doors, branches, pair, weak_cost).run(work)


class _State(NamedTuple):
    """A matching of the ends that aren't `left`, a set of bits; so many of them `loose`."""

    mode: int
    left: int
    cost: float
    loose: int
    pairs: Matching


class _Wanted(NamedTuple):
    """A pattern that may give something new in some mode: how many loose ends it needs, what the wires
    closed in there cost if all but as many as can be spared are weak, and what it is worth."""

    alone: bool
    ends: int
    weak: float
    worth: float


class _Search:
    def __init__(
        self, doors: Doors, branches: Sequence[Branch], pair: Sequence[Mapping[int, float]], weak_cost: float
    ) -> None:
        self._ends = (*doors, *(h for branch in branches for h in branch.doors))
        if len(self._ends) > _MOST_ENDS:
            raise OutOfWorkError
        place = {h: i for i, h in enumerate(self._ends)}
        self._pair = [
            {place[b]: cost for b, cost in pair[a].items() if place[b] < i} for i, a in enumerate(self._ends)
        ]
        self._tables = _tables(self._pair, weak_cost)
        self._weak_cost = weak_cost
        self._doors = len(doors)
        self._sizes = tuple(len(branch.doors) for branch in branches)
        self._twins = {
            place[branch.doors[1]]: (place[branch.doors[0]], index)
            for index, branch in enumerate(branches)
            if len(branch.doors) == 2
        }
        self._modes = modes_of(branches, weak_cost)
        self._wanted = [list[_Wanted]() for _ in self._modes]
        self._fresh = [False] * len(self._modes)
        self._passed: set[tuple[int, bool]] = set()
        self._found: dict[Kind, Option] = {}
        kinds = product((False, True), range(ENOUGH + 1)) if doors else [(False, ENOUGH)]
        self._limits: dict[Kind, float] = dict.fromkeys(kinds, math.inf)

    def run(self, work: Work) -> list[Option]:
        """The options that are of use, cheapest first. Raises OutOfWorkError."""
        heap: list[tuple[float, int, _State]] = []
        count = 0
        states = [
            _State(k, (1 << len(self._ends)) - 1, mode.cost, 0, ()) for k, mode in enumerate(self._modes)
        ]
        while True:
            for state in states:
                if (bound := self._at_least(state)) < math.inf:
                    count += 1
                    heapq.heappush(heap, (bound, count, state))
            if not heap:
                return useful(self._found.values(), self._weak_cost)
            bound, _, state = heapq.heappop(heap)
            if self._at_least(state) > bound:
                states = [state]  # options found since then have made some kinds needless
                continue
            work.spend(1)
            states = list(self._extended(state))
            if not state.left:
                self._look(state)

    def _extended(self, state: _State) -> Iterator[_State]:
        """What may become of the last end that is left."""
        if not state.left:
            return
        mode, left, cost, loose, pairs = state
        i = left.bit_length() - 1
        rest = left ^ (1 << i)
        yield _State(mode, rest, cost, loose + 1, pairs)
        twin, branch = self._twins.get(i, (-1, -1))
        for j, more in self._pair[i].items():
            if rest >> j & 1 and not (j == twin and self._modes[mode].through[branch]):
                yield _State(mode, rest ^ (1 << j), cost + more, loose, (*pairs, (j, i)))

    def _at_least(self, state: _State) -> float:
        """A lower bound on the cost of what is wanted still; infinite where nothing is."""
        number, left, cost, loose, _ = state
        if not self._fresh[number]:
            self._wanted[number] = list(self._still_wanted(number))
            self._fresh[number] = True
        least = math.inf
        for alone, ends, weak, worth in self._wanted[number]:
            missing = ends - loose
            bound = cost + self._tables[missing if missing > 0 else 0][left]
            if alone:
                if missing < 0:
                    continue
            else:
                bound = max(bound, cost + weak + self._weak_cost / 2 * loose + self._tables[-1][left])
            if bound < worth and bound < least:
                least = bound
        return least

    def _still_wanted(self, number: int) -> Iterator[_Wanted]:
        mode, limits = self._modes[number], self._limits
        for through, alone, ends, owners in _PATTERNS[self._doors]:
            if not self._doors:
                worth = limits[False, ENOUGH]
            elif alone:
                worth = max(limits[through, n] - more for n, more in mode.contacts.items())
            else:
                worth = limits[through, 1]
                if mode.enough < math.inf:
                    worth = max(worth, limits[through, ENOUGH] - mode.enough)
            if not (alone and (number, through) in self._passed):
                closed = (mode.ends + self._doors) / 2 - owners
                yield _Wanted(alone, ends - mode.ends, self._weak_cost * closed - mode.spared, worth)

    def _look(self, state: _State) -> None:
        """Finds out what a matching gives, and takes it where it is cheaper than what is known."""
        mates = [NO_MATE] * len(self._ends)
        for i, j in state.pairs:
            mates[i], mates[j] = j, i
        mode = self._modes[state.mode]
        wires = passage(self._doors, self._sizes, mode.through, tuple(mates))
        if wires is None:
            return
        if wires.alone:
            # From here on contacts depend on the branches alone: dearer matchings are of no use.
            self._passed.add((state.mode, wires.through))
            self._fresh = [False] * len(self._modes)
            for n, (total, parts) in mode.totals().items():
                cost = state.cost - mode.cost + total
                if self._doors:
                    self._offer((wires.through, n), cost, state, parts)
                else:
                    # One wire for everything but what it touches at one junction is weak.
                    self._offer((False, ENOUGH), cost + self._weak_cost * (n == 1), state, parts)
        else:
            self._look_beside_others(state, wires)

    def _look_beside_others(self, state: _State, wires: Passage) -> None:
        mode, cost = self._modes[state.mode], state.cost
        parts = list(mode.least)

        def touch(branches: Sequence[int]) -> None:
            branch = min(branches, key=mode.touched.__getitem__)
            parts[branch] = mode.in_touch(branch)

        for group in wires.closed:
            if (least := min(mode.touched[branch] for branch in group)) < self._weak_cost:
                touch(group)
            cost += min(self._weak_cost, least)
        if wires.partial or not self._doors:
            self._offer((wires.through, ENOUGH), cost, state, parts)
            return
        alone = {branch: option for branch in wires.whole if (option := mode.out_of_touch(branch))}
        if len(alone) == len(wires.whole):
            more = sum(option.cost - mode.least[branch].cost for branch, option in alone.items())
            chosen = [alone.get(branch, part) for branch, part in enumerate(parts)]
            self._offer((wires.through, 1), cost + more, state, chosen)
        least = min((mode.touched[branch] for branch in wires.whole), default=math.inf)
        if least < math.inf:
            touch(wires.whole)
            self._offer((wires.through, ENOUGH), cost + least, state, parts)

    def _offer(self, kind: Kind, cost: float, state: _State, parts: Sequence[Option]) -> None:
        if cost < self._limits[kind]:
            pairs = tuple((self._ends[i], self._ends[j]) for i, j in state.pairs)
            self._found[kind] = Option(cost, *kind, pairs, tuple(parts))
            self._fresh = [False] * len(self._modes)
            for other, limit in self._limits.items():
                self._limits[other] = min(limit, cost + surcharge(kind, other, self._weak_cost))


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
