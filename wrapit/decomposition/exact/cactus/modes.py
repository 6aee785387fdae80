"""What the branches at a junction do together, whatever joins them there."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import NamedTuple

from wrapit.decomposition.exact.cactus.blocks import Doors
from wrapit.decomposition.exact.cactus.options import ENOUGH, Option


class Branch(NamedTuple):
    """A block that hangs on a junction by its doors, and what it can do."""

    doors: Doors
    options: Sequence[Option]


def modes_of(branches: Sequence[Branch], weak_cost: float) -> list[Mode]:
    """A mode for each way to say through which branches wires pass."""
    ways = []
    for branch in branches:
        by_kind: dict[bool, dict[int, Option]] = {}
        for option in branch.options:
            by_kind.setdefault(option.through, {})[option.contacts] = option
        ways.append(by_kind.values())
    return [Mode(branches, chosen, weak_cost) for chosen in product(*ways)]


class Mode:
    """Branches of which it is known whether wires pass, with their options by contacts.

    `least` are the cheapest of these, `cost` is their cost; `touched[i]` is how much more it costs if
    there are contacts in branch i.
    """

    def __init__(
        self, branches: Sequence[Branch], chosen: Sequence[Mapping[int, Option]], weak_cost: float
    ) -> None:
        self._branches, self._chosen, self._weak_cost = branches, chosen, weak_cost
        self.least = [min(options.values()) for options in chosen]
        self.cost = sum(option.cost for option in self.least)
        self.through = tuple(option.through for option in self.least)
        self.touched = [
            min((option.cost for n, option in options.items() if n), default=math.inf) - least.cost
            for options, least in zip(chosen, self.least, strict=True)
        ]

    @cached_property
    def contacts(self) -> dict[int, float]:
        """What contacts in all branches together cost more, by their number (2: or more)."""
        return {n: cost - self.cost for n, (cost, _) in self.totals().items()}

    @cached_property
    def ends(self) -> int:
        """Number of wire ends in all branches."""
        return sum(
            len(branch.doors)
            for branch, passes in zip(self._branches, self.through, strict=True)
            if not passes
        )

    @cached_property
    def enough(self) -> float:
        """The least at which a wire here touches another one in some branch: two that have a door each do."""
        return 0.0 if any(self._parted) else min(self.touched)

    @cached_property
    def spared(self) -> float:
        """How much of the weight of weak wires all branches can save at most."""
        return sum(
            2 * self._weak_cost if parted else self._weak_cost - min(self._weak_cost, touched)
            for parted, touched in zip(self._parted, self.touched, strict=True)
        )

    @property
    def _parted(self) -> list[bool]:
        return [
            len(branch.doors) == 2 and not passes
            for branch, passes in zip(self._branches, self.through, strict=True)
        ]

    def totals(self) -> dict[int, tuple[float, tuple[Option, ...]]]:
        """Least cost and options for each number of contacts that all branches together can have."""
        totals: dict[int, tuple[float, tuple[Option, ...]]] = {0: (0.0, ())}
        for options in self._chosen:
            longer: dict[int, tuple[float, tuple[Option, ...]]] = {}
            for n, option in options.items():
                for m, (cost, chosen) in totals.items():
                    k = min(n + m, ENOUGH)
                    if k not in longer or cost + option.cost < longer[k][0]:
                        longer[k] = cost + option.cost, (*chosen, option)
            totals = longer
        return totals

    def in_touch(self, branch: int) -> Option:
        """The cheapest option of a branch that has contacts; there is one where `touched` is finite."""
        return min(option for n, option in self._chosen[branch].items() if n)

    def out_of_touch(self, branch: int) -> Option | None:
        """The option of a branch that has no contacts, if there is one."""
        return self._chosen[branch].get(0)
