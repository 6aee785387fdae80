"""What part of a drawing can do, as far as the rest has to know."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from wrapit.decomposition.exact.junction_matching import Matching

ENOUGH = 2
"""A wire with so many contacts isn't weak; more needn't be told apart."""


Kind = tuple[bool, int]


class Option(NamedTuple):
    """One way to divide what hangs on a block or a junction, at the least cost besides one for each segment.

    `through` says that its two doors are the ends of one wire; else wires end in there. `contacts`
    counts the junctions in there where a wire that has all its doors touches others, up to ENOUGH,
    which also says that such a wire doesn't have all of it.
    """

    cost: float
    through: bool
    contacts: int
    pairs: Matching = ()
    parts: tuple[Option, ...] = ()


def useful(options: Iterable[Option], weak_cost: float) -> list[Option]:
    """The options that others don't make needless, cheapest first."""
    kept: list[Option] = []
    for option in sorted(options, key=lambda option: option[:3]):
        kind = option.through, option.contacts
        if all(other.cost + surcharges(other[1:3], weak_cost)[kind] > option.cost for other in kept):
            kept.append(option)
    return kept


@lru_cache(maxsize=256)
def surcharges(kept: Kind, weak_cost: float) -> dict[Kind, float]:
    """What the rest of a drawing pays at most for one kind of option in place of each other one.

    Each kind is (through, contacts). Where a wire passes in place of two that end, it may close a
    ring, which costs one wire to open; else it makes one wire of two. Where two end in place of one,
    neither has all of the block, so neither is weak.
    """
    weak = 0.0 if kept[1] == ENOUGH else weak_cost
    surcharges = {}
    for wanted in product((False, True), range(ENOUGH + 1)):
        if wanted[0] and not kept[0]:
            surcharges[wanted] = 0.0
        elif kept[0] and not wanted[0]:
            surcharges[wanted] = max(1.0 if kept[1] == wanted[1] else 1.0 + weak, weak)
        else:
            surcharges[wanted] = 0.0 if kept[1] == wanted[1] else weak
    return surcharges
