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
from typing import NamedTuple

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.local import ENUMERATED_DEGREE, LocalCosts, Matching
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.spanning import GROUND, Link, Sets, by_share, cheapest_opening, spanning_tree


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
        weight, opening = cheapest_opening(links, rings)
        _apply_tree(graph, mate, [opening])
        nodes, rings = ring_of(mate)
        others = [link for link in _links(graph, costs, mate, nodes) if link.junction != opening.junction]
        _apply_tree(graph, mate, [branch.link for branch in spanning_tree(by_share(others), rings)[1]])
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
        cheapest: dict[tuple[tuple[int, ...], ...], tuple[float, Matching]] = {}
        for cost, pairs in costs.matchings(junction):
            groups = _linked(ends, mate, nodes, pairs)
            if groups and (groups not in cheapest or (cost, pairs) < cheapest[groups]):
                cheapest[groups] = (cost, pairs)
        for groups, (cost, pairs) in cheapest.items():
            yield Link(cost - here, junction, pairs, groups)


def _linked(
    ends: Sequence[int], mate: Sequence[int], nodes: Sequence[int], pairs: Matching
) -> tuple[tuple[int, ...], ...]:
    """Groups of nodes that a matching links: where it joins half-edges, or newly leaves one free."""
    sets = Sets()
    left = {h for h in ends if mate[h] != NO_MATE}
    for a, b in pairs:
        sets.merge(nodes[a], nodes[b])
        left -= {a, b}
    for h in left:
        sets.merge(nodes[h], GROUND)
    return sets.groups()


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
