"""The energy of a decomposition, from its trails and nothing else.

No solver is trusted: what is reported is always what these functions find.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Energy, Trail, Weights
from wrapit.decomposition.symmetry import asymmetry
from wrapit.decomposition.trails import trails_of


def energy_of(graph: Graph, mate: Sequence[int], weights: Weights, mirror: Sequence[int] = ()) -> Energy:
    """The energy of a matching. Raises ValueError where it is none.

    `mirror` gives the mirror image of each half-edge, for the weight of symmetry.
    """
    return energy_of_trails(graph, trails_of(graph, mate), weights, asymmetry(graph, mirror, mate))


def energy_of_trails(graph: Graph, trails: Sequence[Trail], weights: Weights, asymmetric: int = 0) -> Energy:
    """The energy (paper, equations 1 to 4) of trails; they may run along a segment twice."""
    complexity = len(trails)
    smoothness = math.fsum(bend for trail in trails for bend in bends_of(graph, trail))
    robustness = len(weak_trails(graph, trails))
    used = {t.segment for trail in trails for t in trail.traversals}
    bridges = len(used & graph.bridges)
    doubling = math.fsum(run.cost for e, run in graph.second_runs.items() if e in used)
    total = (
        complexity
        + weights.smoothness * smoothness
        + weights.robustness * robustness
        + weights.bridges * bridges
        + weights.symmetry * asymmetric
        + weights.doubling * doubling
    )
    return Energy(complexity, smoothness, robustness, bridges, total, asymmetric, doubling)


def bends_of(graph: Graph, trail: Trail) -> list[float]:
    """Bend angle in radians at each junction that the trail passes."""
    angles = []
    for before, after in pairwise(trail.traversals):
        (ax, ay), (bx, by) = graph.directions[before.arrival], graph.directions[after.departure]
        angles.append(math.pi - abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by)))
    return angles


def weak_trails(graph: Graph, trails: Sequence[Trail]) -> list[int]:
    """Indices of the trails that touch other trails at one junction only, and so can swing about it.

    A trail that touches none is a whole piece of the drawing in one wire, which is as robust as can
    be (the paper's exemption for designs of one wire, taken piece by piece).
    """
    return [index for index, contacts in enumerate(contacts_of(graph, trails)) if len(contacts) == 1]


def contacts_of(graph: Graph, trails: Sequence[Trail]) -> list[set[int]]:
    """For each trail the junctions at which it touches others."""
    touched = [junctions_of(graph, trail) for trail in trails]
    visitors: dict[int, int] = {}
    for junctions in touched:
        for junction in junctions:
            visitors[junction] = visitors.get(junction, 0) + 1
    return [{junction for junction in junctions if visitors[junction] > 1} for junctions in touched]


def junctions_of(graph: Graph, trail: Trail) -> set[int]:
    """The junctions that a trail visits, its ends included."""
    return {graph.junction_of[h] for t in trail.traversals for h in (t.departure, t.arrival)}
