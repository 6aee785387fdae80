"""From a matching of segment ends to the trails that it describes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Trail, Transition, Traversal


def trails_of(graph: Graph, mate: Sequence[int]) -> tuple[Trail, ...]:
    """The trails of a matching: longest first (in mm), of equal ones the one with the lowest segment first.

    Each runs from the end with the lower half-edge number, so the result depends on nothing but the
    matching. What is optional and joins nothing is left out. Raises ValueError where `mate` isn't a
    matching of half-edges that meet, or closes a ring.
    """
    check_matching(graph, mate)
    trails: list[Trail] = []
    seen: set[int] = set()
    for h in range(2 * graph.segments):
        if mate[h] != NO_MATE or h in seen or (h >> 1 in graph.optional and mate[h ^ 1] == NO_MATE):
            continue
        steps = walk(mate, h)
        seen.update((h, steps[-1] ^ 1))
        closed = graph.junction_of[h] == graph.junction_of[steps[-1] ^ 1]
        trails.append(Trail(tuple(Traversal(step >> 1, bool(step & 1)) for step in steps), closed))
    covered = {traversal.segment for trail in trails for traversal in trail.traversals}
    if rings := set(range(graph.segments)) - covered - graph.optional:
        raise ValueError(f"segment {min(rings)} is on a ring; a closed wire is left open somewhere")
    return in_wire_order(graph, trails)


def first_runs(graph: Graph, trails: Iterable[Trail]) -> tuple[Trail, ...]:
    """The trails over the segments of the drawing: a second run has the number of what it runs along."""
    firsts = {e: run.segment for e, run in graph.second_runs.items()}
    return tuple(
        Trail(
            tuple(Traversal(firsts.get(t.segment, t.segment), t.reversed) for t in trail.traversals),
            trail.closed,
        )
        for trail in trails
    )


def in_wire_order(graph: Graph, trails: Iterable[Trail]) -> tuple[Trail, ...]:
    """Trails longest first (in mm), of equal ones the one with the lowest segment first."""
    return tuple(sorted(trails, key=lambda trail: _order(graph, trail)))


def walk(mate: Sequence[int], start: int) -> list[int]:
    """Departing half-edges of the wire that starts at the free half-edge `start`."""
    steps = [start]
    while (following := mate[steps[-1] ^ 1]) != NO_MATE:
        steps.append(following)
    return steps


def transitions_of(graph: Graph, mate: Sequence[int]) -> tuple[Transition, ...]:
    """Every transition, by rising half-edge."""
    return tuple(
        Transition(graph.junction_of[a], a, b, graph.bends_rad[a][b]) for a, b in enumerate(mate) if a < b
    )


def check_matching(graph: Graph, mate: Sequence[int]) -> None:
    """Raises ValueError where `mate` doesn't pair half-edges that meet at a junction."""
    if len(mate) != 2 * graph.segments:
        raise ValueError(f"{2 * graph.segments} half-edges need as many mates, not {len(mate)}")
    for h, other in enumerate(mate):
        if other == NO_MATE:
            continue
        if not 0 <= other < len(mate) or mate[other] != h:
            raise ValueError(f"half-edge {h} continues into {other}, which doesn't continue into it")
        if graph.junction_of[h] != graph.junction_of[other] or h ^ 1 == other or h == other:
            raise ValueError(f"half-edges {h} and {other} can't continue into one another")


def _order(graph: Graph, trail: Trail) -> tuple[float, int]:
    length = sum(graph.lengths_mm[traversal.segment] for traversal in trail.traversals)
    return -round(length, 6), min(traversal.segment for traversal in trail.traversals)
