"""Which wires a matching makes at a junction, told by positions so that like junctions share the answer."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from wrapit.decomposition.exact.junction_matching import Matching, matchings_of


class Passage(NamedTuple):
    """The wires at a junction: those that own its doors, and those that are closed in there.

    `through` says that one wire has both doors. `alone`: there are no other wires here. `whole` are
    the branches that the owners of the doors have with all their doors, `partial` says that they have
    one door of another. `closed` are the branches of each other wire that has all doors of each.
    """

    through: bool
    alone: bool
    partial: bool
    whole: tuple[int, ...]
    closed: tuple[tuple[int, ...], ...]


@lru_cache(maxsize=1 << 14)
def passage(doors: int, sizes: tuple[int, ...], through: tuple[bool, ...], pairs: Matching) -> Passage | None:
    """The wires of a matching; None where it closes a ring.

    Positions count the junction's own doors first, then those of each branch, of which there are one
    or two (`sizes`); `through` says which branches have one wire between their doors. At a junction
    without doors of its own, a wire that has everything counts as their owner.
    """
    mates = dict(pairs) | {j: i for i, j in pairs}
    owner = [-1] * doors + [branch for branch, size in enumerate(sizes) for _ in range(size)]
    beyond = [-1] * len(owner)  # where a wire comes back that leaves into a branch
    for i, branch in enumerate(owner):
        if branch >= 0 and through[branch]:
            beyond[i] = i + 1 if beyond[i - 1] != i else i - 1

    def followed(i: int) -> list[int]:
        way = [i]
        while (j := mates.get(way[-1], -1)) >= 0:
            way.append(j)
            if beyond[j] < 0:
                break
            way.append(beyond[j])
        return way

    def whole_in(way: list[int]) -> tuple[tuple[int, ...], bool]:
        met = [owner[i] for i in way if owner[i] >= 0]
        whole = tuple(branch for branch in sorted(set(met)) if met.count(branch) == sizes[branch])
        return whole, len(whole) == len(set(met))

    ways = [followed(i) for i in range(doors)]
    passes = doors == 2 and ways[0][-1] == 1
    owned = ways[0] if passes else [i for way in ways for i in way]
    seen = set(owned)
    closed = []
    for i in range(doors, len(owner)):
        if i not in seen and (beyond[i] < 0 or i not in mates):
            way = followed(i) if beyond[i] < 0 else [i, *followed(beyond[i])]
            seen.update(way)
            closed.append(way)
    if len(seen) < len(owner):
        return None
    if not doors and len(closed) == 1:
        owned, closed = closed[0], []
    whole, all_of_each = whole_in(owned)
    groups = (whole_in(way) for way in closed)
    return Passage(passes, not closed, not all_of_each, whole, tuple(group for group, full in groups if full))


@lru_cache(maxsize=1 << 10)
def passages(
    doors: int, sizes: tuple[int, ...], through: tuple[bool, ...]
) -> tuple[tuple[Passage, tuple[Matching, ...]], ...]:
    """All that the wires can do at a junction of few ends, each with the matchings that make it so."""
    ways: dict[Passage, list[Matching]] = {}
    for pairs in matchings_of(doors + sum(sizes)):
        wires = passage(doors, sizes, through, pairs)
        if wires is not None:
            ways.setdefault(wires, []).append(pairs)
    return tuple((wires, tuple(matchings)) for wires, matchings in ways.items())
