"""Rings in the locally best matchings: what it costs at least to open them all, and a way to do it.

The best matchings of all junctions together may close rings. A ring has to be linked to another ring
or to the ground, which stands for everything that has wire ends. Each other matching at a junction
costs some loss and links some rings; it does the work of as many links as its rank. So the minimum
spanning tree under loss / rank is a lower bound on what is lost, and where each link of the tree is a
matching of its own, applying them reaches that bound: the answer is proven best.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import cache
from typing import NamedTuple

from wrapit.decomposition.exact.junction_matching import ENUMERATED_DEGREE, LocalCosts, Matching, matchings_of
from wrapit.decomposition.exact.spanning_trees import GROUND, Link, by_share, cheapest_opening, spanning_tree
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE
from wrapit.geometry.disjoint_sets import Sets


class Certificate(NamedTuple):
    """A proven lower bound on the cost of all junctions, and a matching without rings."""

    bound: float
    mate: list[int]


def certify(graph: Graph, costs: LocalCosts) -> Certificate:
    """Bound and matching from local optima and spanning trees, for one connected piece."""
    junctions = range(len(graph.incident))
    total = math.fsum(costs.best(junction)[0] for junction in junctions)
    mate = [NO_MATE] * (2 * graph.segments)
    for junction in junctions:
        _apply(mate, graph.incident[junction], costs.best(junction)[1])
    nodes, rings = ring_of(mate)
    if not rings:
        return Certificate(total, mate)
    links = by_share(_links(graph, costs, mate, nodes))
    if any(node == GROUND for node in nodes):
        weight, tree = spanning_tree(links, rings)
        _apply_tree(graph, mate, [branch.link for branch in tree])
    else:
        weight, opening, tree = cheapest_opening(links, rings)
        _apply_tree(graph, mate, [opening, *(branch.link for branch in tree)])
    open_rings(graph, costs, mate)
    return Certificate(total + weight, mate)


def open_rings(graph: Graph, costs: LocalCosts, mate: list[int]) -> None:
    """Links what rings are left, cheapest first, until there is none."""
    nodes, rings = ring_of(mate)
    while rings:
        before = list(mate)
        links = by_share(_links(graph, costs, mate, nodes))
        tree = [branch.link for branch in spanning_tree(links, rings)[1]]
        _apply_tree(graph, mate, tree)
        nodes, left = ring_of(mate)
        if left >= rings:
            # Links at one junction got in each other's way: take the cheapest alone.
            mate[:] = before
            if not tree or not _apply_one(graph, mate, tree, rings):
                worst = max(
                    (h for h, node in enumerate(ring_of(mate)[0]) if node),
                    key=lambda h: costs.pair[h][mate[h]],
                )
                mate[mate[worst]], mate[worst] = NO_MATE, NO_MATE
            nodes, left = ring_of(mate)
        rings = left


def ring_of(mate: Sequence[int]) -> tuple[list[int], int]:
    """For each half-edge the number of its ring, counting from 1, or 0 on open trails; and how many."""
    nodes = [-1] * len(mate)
    for h, other in enumerate(mate):
        if other == NO_MATE and nodes[h] < 0:
            x = h
            while x != NO_MATE:
                nodes[x] = nodes[x ^ 1] = GROUND
                x = mate[x ^ 1]
    rings = 0
    for h in range(len(mate)):
        if nodes[h] < 0:
            rings += 1
            x = h
            while nodes[x] < 0:
                nodes[x] = nodes[x ^ 1] = rings
                x = mate[x ^ 1]
    return nodes, rings


def _links(graph: Graph, costs: LocalCosts, mate: Sequence[int], nodes: Sequence[int]) -> Iterable[Link]:
    """For each junction on a ring, the cheapest matching for each way of linking rings."""
    for junction, ends in enumerate(graph.incident):
        if not any(nodes[h] for h in ends):
            continue
        here = costs.cost(junction, mate)
        if len(ends) > ENUMERATED_DEGREE:
            # Too many matchings to list: any of them may link all that is here, at the least loss.
            everything = tuple(sorted({GROUND, *(nodes[h] for h in ends)}))
            yield Link(costs.second_loss(junction), junction, None, (everything,))
            continue
        back = sorted({GROUND, *(nodes[h] for h in ends)})
        labels = tuple(back.index(nodes[h]) for h in ends)
        listed = costs.listed(junction)
        for groups, indices in _ways(labels, tuple(mate[h] != NO_MATE for h in ends)):
            index = min(indices, key=listed.__getitem__)
            if listed[index] < math.inf:
                named = tuple(tuple(back[label] for label in group) for group in groups)
                yield Link(listed[index] - here, junction, costs.matching(junction, index), named)


@cache
def _ways(
    labels: tuple[int, ...], matched: tuple[bool, ...]
) -> tuple[tuple[tuple[tuple[int, ...], ...], tuple[int, ...]], ...]:
    """The ways to link nodes at a junction, each with the matchings that do it.

    `labels` are the nodes of its half-edges, `matched` says which have mates now. A matching links
    where it joins half-edges, and to the ground where it newly leaves one free.
    """
    ways: dict[tuple[tuple[int, ...], ...], list[int]] = {}
    for index, pairs in enumerate(matchings_of(len(labels))):
        sets = Sets((labels[i], labels[j]) for i, j in pairs)
        chosen = {i for pair in pairs for i in pair}
        for i, has_mate in enumerate(matched):
            if has_mate and i not in chosen:
                sets.merge(labels[i], GROUND)
        if groups := sets.groups():
            ways.setdefault(groups, []).append(index)
    return tuple((groups, tuple(indices)) for groups, indices in ways.items())


def _apply_tree(graph: Graph, mate: list[int], tree: Iterable[Link]) -> None:
    """Applies the links of a tree, at each junction the one that links most."""
    chosen: dict[int, tuple[tuple[tuple[int, ...], ...], Matching]] = {}
    for link in tree:
        if link.pairs is not None and (link.junction not in chosen or link.groups > chosen[link.junction][0]):
            chosen[link.junction] = (link.groups, link.pairs)
    for junction, (_, pairs) in chosen.items():
        _apply(mate, graph.incident[junction], pairs)


def _apply_one(graph: Graph, mate: list[int], tree: Iterable[Link], rings: int) -> bool:
    """Applies the first link that leaves fewer rings, if there is one."""
    before = list(mate)
    for link in tree:
        _apply_tree(graph, mate, [link])
        if ring_of(mate)[1] < rings:
            return True
        mate[:] = before
    return False


def _apply(mate: list[int], ends: Iterable[int], pairs: Matching) -> None:
    for h in ends:
        mate[h] = NO_MATE
    for a, b in pairs:
        mate[a], mate[b] = b, a
