"""The postman's second runs: the least that has to be run along twice for so few wires, bends aside.

A wire ends at a junction where an odd number of half-edges is in use. N wires in one piece leave 2N of
those at most; all others are paired, and what lies on the shortest way between two of a pair is run along
once more: a minimum-weight matching (Edmonds and Johnson, *Matching, Euler tours and the Chinese postman*,
1973), here with bridges as further ways.
"""

from __future__ import annotations

from itertools import combinations, pairwise

from wrapit.decomposition.problem import Problem


def least_second_runs(problem: Problem, wires: int) -> tuple[frozenset[int], float]:
    """Optional segments whose use leaves at most so many wires, and the least price of any such choice.

    For one connected piece; the segments are found in time that grows with the cube of its odd junctions.
    """
    import networkx as nx

    graph = problem.graph
    ways = nx.Graph()
    odd = {j for j, ends in enumerate(graph.incident) if sum(h >> 1 not in graph.optional for h in ends) % 2}
    for e in sorted(graph.optional):
        a, b = graph.junction_of[2 * e], graph.junction_of[2 * e + 1]
        price = problem.price(e)
        if a != b and (not ways.has_edge(a, b) or price < ways.edges[a, b]["weight"]):
            ways.add_edge(a, b, weight=price, segment=e)
    pairs = nx.Graph()
    pairs.add_nodes_from(sorted(odd))
    courses: dict[tuple[int, int], list[int]] = {}
    for a in sorted(odd & ways.nodes):
        far, course = nx.single_source_dijkstra(ways, a)
        for b in sorted(odd & far.keys()):
            if a < b:
                pairs.add_edge(a, b, weight=far[b])
                courses[a, b] = course[b]
    free = [("free", n) for n in range(min(2 * wires, len(odd)))]
    pairs.add_edges_from((end, j, {"weight": 0.0}) for end in free for j in sorted(odd))
    pairs.add_edges_from((*two, {"weight": 0.0}) for two in combinations(free, 2))
    used: set[int] = set()
    for one, other in sorted(nx.min_weight_matching(pairs), key=str):
        course = [] if one in free or other in free else courses[min(one, other), max(one, other)]
        # What two pairs have in common is run along an even number of times more: not at all.
        used ^= {ways.edges[a, b]["segment"] for a, b in pairwise(course)}
    return frozenset(used), sum(map(problem.price, sorted(used)))
