"""What wires at a junction come to, and which of it is worth knowing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

from wrapit.decomposition.exact.cactus.modes import Mode
from wrapit.decomposition.exact.cactus.options import ENOUGH, Kind, Option, surcharges, useful
from wrapit.decomposition.exact.cactus.passages import Passage
from wrapit.decomposition.exact.junction_matching import Matching

# The kinds of options by the number of own doors: where there are none, all is closed; one door is passed
# by no wire.
_KINDS: tuple[tuple[Kind, ...], ...] = (
    ((False, ENOUGH),),
    tuple(product((False,), range(ENOUGH + 1))),
    tuple(product((False, True), range(ENOUGH + 1))),
)


class Offers:
    """The cheapest option of each kind at one junction so far.

    `limits` says for each kind below which cost an option isn't made needless by others. A junction
    without doors, where the tree of blocks begins, has just the kind (False, ENOUGH).
    """

    def __init__(self, ends: Sequence[int], doors: int, weak_cost: float) -> None:
        self._ends, self._doors, self._weak_cost = ends, doors, weak_cost
        self._found: dict[Kind, tuple[float, Matching, Sequence[Option]]] = {}
        self.limits: dict[Kind, float] = dict.fromkeys(_KINDS[doors], math.inf)
        self._most = math.inf  # of these limits

    def useful(self) -> list[Option]:
        """The options that are of use, cheapest first."""
        options = (
            Option(cost, *kind, tuple((self._ends[i], self._ends[j]) for i, j in pairs), tuple(parts))
            for kind, (cost, pairs, parts) in self._found.items()
        )
        return useful(options, self._weak_cost)

    def take(self, mode: Mode, wires: Passage, cost: float, pairs: Matching) -> None:
        """Takes what wires come to that run so, where it is cheaper than what is known.

        `cost` is that of the transitions `pairs`, given by positions, and of the mode at least.
        """
        if cost >= self._most:
            return
        if wires.alone:
            for n, (total, chosen) in mode.totals().items():
                if self._doors:
                    self._offer((wires.through, n), cost - mode.cost + total, pairs, chosen)
                else:
                    # One wire for everything but what it touches at one junction is weak.
                    weak = self._weak_cost * (n == 1)
                    self._offer((False, ENOUGH), cost - mode.cost + total + weak, pairs, chosen)
            return
        parts = list(mode.least)
        for group in wires.closed:
            i = min(group, key=mode.touched.__getitem__)
            if mode.touched[i] < self._weak_cost:
                parts[i] = mode.in_touch(i)
            cost += min(self._weak_cost, mode.touched[i])
        if wires.partial or not self._doors:
            self._offer((wires.through, ENOUGH), cost, pairs, parts)
        else:
            self._take_whole(mode, wires, cost, pairs, parts)

    def _take_whole(
        self, mode: Mode, wires: Passage, cost: float, pairs: Matching, parts: list[Option]
    ) -> None:
        """The wires at the doors touch others here, and have all doors of each branch they run into."""
        alone = {branch: option for branch in wires.whole if (option := mode.out_of_touch(branch))}
        if len(alone) == len(wires.whole):
            more = sum(option.cost - mode.least[branch].cost for branch, option in alone.items())
            chosen = [alone.get(branch, part) for branch, part in enumerate(parts)]
            self._offer((wires.through, 1), cost + more, pairs, chosen)
        i = min(wires.whole, key=mode.touched.__getitem__, default=-1)
        if i >= 0 and mode.touched[i] < math.inf:
            parts[i] = mode.in_touch(i)
            self._offer((wires.through, ENOUGH), cost + mode.touched[i], pairs, parts)

    def _offer(self, kind: Kind, cost: float, pairs: Matching, parts: Sequence[Option]) -> None:
        limits = self.limits
        if cost < limits[kind]:
            self._found[kind] = cost, pairs, parts
            for other, surcharge in surcharges(kind, self._weak_cost).items():
                if cost + surcharge < limits.get(other, -math.inf):
                    limits[other] = cost + surcharge
            self._most = max(limits.values())
