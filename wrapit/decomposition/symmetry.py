"""How far a decomposition keeps the mirror symmetry of its drawing."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE


def mirrored_junctions(graph: Graph, mirror: Sequence[int]) -> list[tuple[int, int]]:
    """Pairs of junctions all of whose half-edges are images of one another; (v, v) on the axis."""
    pairs = []
    for junction, ends in enumerate(graph.incident):
        images = {mirror[h] for h in ends} if mirror else {NO_MATE}
        if len(ends) < 2 or NO_MATE in images:
            continue
        other = graph.junction_of[min(images)]
        if junction <= other and images == set(graph.incident[other]):
            pairs.append((junction, other))
    return pairs


def asymmetry(graph: Graph, mirror: Sequence[int], mate: Sequence[int]) -> int:
    """Number of pairs of mirrored junctions that wires pass in unlike ways."""
    return sum(is_unlike(graph.incident[v], mirror, mate) for v, _ in mirrored_junctions(graph, mirror))


def is_unlike(ends: Sequence[int], mirror: Sequence[int], mate: Sequence[int]) -> bool:
    """Whether wires pass a junction, given by its half-edges, in another way than its mirror image."""
    return any((mirror[mate[h]] if mate[h] != NO_MATE else NO_MATE) != mate[mirror[h]] for h in ends)
