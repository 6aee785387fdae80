"""Where a drawing hangs together by one junction only."""

from __future__ import annotations

from wrapit.decomposition.graph import Graph, pieces


def smallest_branches(graph: Graph) -> list[int]:
    """For each segment, a lower bound on the number of segments of any weak wire that runs along it.

    A wire that touches the others at one junction v only is a union of branches at v: parts of the
    drawing that nothing but v joins to the rest. Most wires are shorter than any branch they could
    fill, which settles in no time that they are not weak. What is optional is taken as absent: using it
    only makes branches larger.
    """
    strokes = [e for e in range(graph.segments) if e not in graph.optional]
    alone = graph.subgraph(strokes)
    smallest = [0] * graph.segments
    for piece in pieces(alone):
        for e, size in enumerate(_of_piece(alone.subgraph(piece))):
            smallest[strokes[piece[e]]] = size
    return smallest


def _of_piece(graph: Graph) -> list[int]:
    """Tarjan's low points, without recursion, over one connected piece."""
    incident, junction_of = graph.incident, graph.junction_of
    root = max(range(len(incident)), key=lambda junction: len(incident[junction]))
    order, low = {root: 0}, {root: 0}
    below: dict[int, list[int]] = {root: []}  # segments first walked in the subtree of a junction
    hanging = [0] * len(incident)  # segments in the branches below a junction
    best: dict[int, int] = {}
    used: set[int] = set()
    stack = [(root, iter(incident[root]))]
    while stack:
        v, ends = stack[-1]
        for h in ends:
            e, w = h >> 1, junction_of[h ^ 1]
            if e in used:
                continue
            used.add(e)
            if w not in order:
                order[w] = low[w] = len(order)
                below[w] = [e]
                stack.append((w, iter(incident[w])))
                break
            low[v] = min(low[v], order[w])
            below[v].append(e)
            if v == w:
                hanging[v] += 1
                best[e] = 1
        else:
            stack.pop()
            if stack:
                parent = stack[-1][0]
                if low[v] >= order[parent]:
                    hanging[parent] += len(below[v])
                    for e in below[v]:
                        best.setdefault(e, len(below[v]))
                low[parent] = min(low[parent], low[v])
                below[parent] += below[v]
    cuts = [size for v, size in enumerate(hanging) if size and v != root]
    outside = graph.segments - max(cuts, default=0)
    return [min(best[e], outside) for e in range(graph.segments)]
