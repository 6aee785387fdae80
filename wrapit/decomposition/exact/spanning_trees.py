"""Spanning trees over rings, where one change of matching may do the work of several branches."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from wrapit.decomposition.exact.junction_matching import Matching
from wrapit.geometry.disjoint_sets import Group, Sets

GROUND = 0
"""The node that stands for everything with wire ends; rings count from 1."""


@dataclass(frozen=True)
class Link:
    """Another matching at a junction: its loss, and the groups of nodes that it links.

    `pairs` is None where a junction has too many matchings to say which.
    """

    loss: float
    junction: int
    pairs: Matching | None
    groups: tuple[Group, ...]

    @cached_property
    def rank(self) -> int:
        """Number of branches of a tree that it does the work of."""
        return sum(len(group) - 1 for group in self.groups)

    @cached_property
    def share(self) -> float:
        """Loss for each of them."""
        return self.loss / self.rank


class TreeBranch(NamedTuple):
    """One branch of a spanning tree."""

    u: int
    w: int
    link: Link


def by_share(links: Iterable[Link]) -> list[Link]:
    """Links in the order in which Kruskal's algorithm takes them."""
    return sorted(links, key=lambda link: (link.share, link.junction, link.groups))


def spanning_tree(
    links: Iterable[Link], rings: int, opening: Link | None = None
) -> tuple[float, list[TreeBranch]]:
    """Kruskal: weight and branches of a minimum spanning tree; `links` come by share.

    What `opening` links is taken as done, and nothing else happens at its junction.
    """
    sets = Sets()
    missing = rings
    if opening:
        missing -= sum(sets.merge_all(group) for group in opening.groups)
    weight, tree = 0.0, []
    for link in links:
        if not missing:
            break
        if opening and link.junction == opening.junction:
            continue
        for group in link.groups:
            for node in group[1:]:
                if sets.merge(group[0], node):
                    weight += link.share
                    tree.append(TreeBranch(group[0], node, link))
                    missing -= 1
    return weight, tree


def cheapest_opening(links: Sequence[Link], rings: int) -> tuple[float, Link, list[TreeBranch]]:
    """A drawing of rings only has to be opened somewhere: the least bound over the places to do it.

    Returns the bound, the link that opens, and the tree that links the rest. The junction that opens
    pays its whole loss, not the share that the spanning tree counts.
    """
    plain, tree = spanning_tree(links, rings)
    dearest = max(branch.link.share for branch in tree)
    openings = [link for link in links if any(group[0] == GROUND for group in link.groups)]
    if not openings:
        raise ValueError("no junction of a drawing of rings can be opened")

    def at_least(link: Link) -> float:
        return link.loss + plain - dearest * link.rank

    def opened(link: Link) -> tuple[float, Link, list[TreeBranch]]:
        rest, rest_tree = spanning_tree(links, rings, link)
        return link.loss + rest, link, rest_tree

    # Two bounds, a rough and a fine one, leave few openings to be worked out.
    best = opened(min(openings, key=at_least))
    rooted = _Rooted(tree)
    hopeful = [
        (link.loss + plain - rooted.spared(link.groups), link.junction, link)
        for link in openings
        if at_least(link) < best[0]
    ]
    for bound, _, link in sorted(hopeful, key=lambda opening: opening[:2]):
        if bound > best[0] - 1e-12:
            break
        best = min(best, opened(link), key=lambda found: found[0])
    return best


class _Rooted:
    """A spanning tree hung up at the ground."""

    def __init__(self, tree: Iterable[TreeBranch]) -> None:
        beside: dict[int, list[tuple[int, float]]] = {}
        for u, w, link in tree:
            beside.setdefault(u, []).append((w, link.share))
            beside.setdefault(w, []).append((u, link.share))
        self._above: dict[int, tuple[int, float]] = {}
        frontier = [GROUND]
        while frontier:
            u = frontier.pop()
            for w, share in beside.get(u, ()):
                if w != GROUND and w not in self._above:
                    self._above[w] = (u, share)
                    frontier.append(w)

    def spared(self, groups: Iterable[Group]) -> float:
        """What the tree no longer has to pay once the nodes of each group are linked.

        Only branches between them and the ground can fall away.
        """
        branches: dict[int, tuple[float, int]] = {}
        for start in (node for group in groups for node in group):
            node = start
            while node != GROUND and node not in branches:
                above, share = self._above[node]
                branches[node] = (share, above)
                node = above
        sets = Sets(groups)
        return sum(
            share
            for share, node, above in sorted(
                (share, node, above) for node, (share, above) in branches.items()
            )
            if not sets.merge(node, above)
        )
