"""Junction refinement (paper, 4.4): a wire that hangs on one junction becomes part of its neighbour.

The neighbour leaves the junction along the hanging wire and comes back over it, so that part of the
metal is doubled and nothing can swing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from wrapit.decomposition.energy import bends_of, contacts_of, junctions_of, weak_trails
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Trail, Traversal
from wrapit.decomposition.trails import in_wire_order

Run = tuple[Traversal, ...]


def doubled_back(graph: Graph, trails: Sequence[Trail]) -> tuple[Trail, ...]:
    """Trails of which none hangs on one junction any more; for that they may run along segments twice.

    Every hanging trail is tried at every place where a neighbour could take it in; what leaves the
    fewest hanging ones is done, and of that what needs the least metal, then the least bends. Where
    a drawing hangs together like a tree, this goes on until one wire is left.
    """
    merged = list(trails)
    while weak := weak_trails(graph, merged):
        merged = min(
            (option for index in weak for option in _without(graph, merged, index)),
            key=lambda option: _cost(graph, option),
        )
    return in_wire_order(graph, merged)


def _without(graph: Graph, trails: Sequence[Trail], index: int) -> Iterator[list[Trail]]:
    """Every way to have a hanging trail taken in by another one."""
    hanging = trails[index]
    (junction,) = contacts_of(graph, trails)[index]
    others = [trail for trail in trails if trail is not hanging]
    for place, host in enumerate(others):
        if junction in junctions_of(graph, host):
            for run in _taken_in(graph, host, hanging, junction):
                closed = _start(graph, run[0]) == _start(graph, _turned(run)[0])
                yield [*others[:place], Trail(run, closed), *others[place + 1 :]]


def _cost(graph: Graph, trails: Sequence[Trail]) -> tuple[int, float, float]:
    runs = [traversal.segment for trail in trails for traversal in trail.traversals]
    length_mm = round(sum(graph.lengths_mm[segment] for segment in runs), 6)
    bends = round(sum(bend for trail in trails for bend in bends_of(graph, trail)), 9)
    return len(weak_trails(graph, trails)), length_mm, bends


def _taken_in(graph: Graph, host: Trail, hanging: Trail, junction: int) -> Iterator[Run]:
    """Every walk along the host with the hanging trail as a detour where it passes the junction."""
    run = host.traversals
    round_trip = _round_trip(graph, hanging, junction)
    stops = [_start(graph, t) for t in run] + [_start(graph, _turned(run)[0])]
    for index, stop in enumerate(stops):
        if stop == junction:
            for detour in (round_trip, _turned(round_trip)):
                yield run[:index] + detour + run[index:]
    for whole in (hanging.traversals, _turned(hanging.traversals)):
        if stops[-1] == junction == _start(graph, whole[0]):
            yield run + whole
        if stops[0] == junction == _start(graph, _turned(whole)[0]):
            yield whole + run


def _round_trip(graph: Graph, hanging: Trail, junction: int) -> Run:
    """A walk along the trail from the junction and back to it, the shorter way wherever it doubles."""
    parts: list[list[Traversal]] = [[]]
    for traversal in hanging.traversals:
        if _start(graph, traversal) == junction and parts[-1]:
            parts.append([])
        parts[-1].append(traversal)
    trip: Run = ()
    for part in map(tuple, parts):
        back = _turned(part)
        leaves, returns = _start(graph, part[0]) == junction, _start(graph, back[0]) == junction
        if leaves and returns:
            trip += part
        else:
            trip += part + _direct(graph, back) if leaves else _direct(graph, back) + part
    return trip


def _direct(graph: Graph, run: Run) -> Run:
    """The same way without its detours: what it passes again when it comes back to a junction is left out."""
    way: list[Traversal] = []
    for traversal in run:
        stops = [_start(graph, step) for step in way]
        if (start := _start(graph, traversal)) in stops:
            del way[stops.index(start) :]
        way.append(traversal)
    return tuple(way)


def _turned(run: Run) -> Run:
    return tuple(Traversal(t.segment, not t.reversed) for t in reversed(run))


def _start(graph: Graph, traversal: Traversal) -> int:
    return graph.junction_of[traversal.departure]
