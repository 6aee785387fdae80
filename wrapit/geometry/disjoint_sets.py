"""Disjoint sets of numbers."""

from __future__ import annotations

from collections.abc import Iterable

Group = tuple[int, ...]


class Sets:
    """Numbers in disjoint sets; each that has not been merged is one by itself."""

    def __init__(self, groups: Iterable[Group] = ()) -> None:
        self._parent: dict[int, int] = {}
        for group in groups:
            self.merge_all(group)

    def merge(self, x: int, y: int) -> bool:
        """Puts x and y into one set; says whether they were apart."""
        x, y = self.find(x), self.find(y)
        if x == y:
            return False
        self._parent[max(x, y)] = min(x, y)
        return True

    def merge_all(self, group: Group) -> int:
        """Puts a group into one set; says how many mergers that took."""
        return sum(self.merge(group[0], node) for node in group[1:])

    def groups(self) -> tuple[Group, ...]:
        """The sets with two members and more."""
        groups: dict[int, list[int]] = {}
        for x in sorted(self._parent):
            groups.setdefault(self.find(x), []).append(x)
        return tuple(tuple(group) for group in groups.values() if len(group) > 1)

    def find(self, x: int) -> int:
        """The least number of the set that x is in."""
        parent = self._parent
        while (above := parent.setdefault(x, x)) != x:
            parent[x] = parent[above]
            x = above
        return x
