"""Junction refinement (paper, 4.4): a wire that hangs on one junction becomes part of its neighbour.

The neighbour leaves the junction along the hanging wire and comes back over it, so that part of the
metal is doubled and nothing can swing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from wrapit.decomposition.energy import bends_of, contacts_of, weak_trails
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Trail, Traversal
from wrapit.decomposition.trails import in_wire_order

Run = tuple[Traversal, ...]


def doubled_back(graph: Graph, trails: Sequence[Trail]) -> tuple[tuple[Trail, ...], tuple[int, ...]]:
    """Trails of which none hangs on one junction any more, and the segments that are run along twice.

    The trail with the fewest segments goes first, so that a twig joins the branch that it hangs on.
    Of all places where it can be taken in, the one with the least doubling is chosen, then the one
    with the least bends.
    """
    merged = list(trails)
    while weak := weak_trails(graph, merged):
        index = min(weak, key=lambda i: (len(merged[i].traversals), min(merged[i].traversals)))
        (junction,) = contacts_of(graph, merged)[index]
        hanging = merged.pop(index)
        host, run = min(
            (
                (i, run)
                for i, trail in enumerate(merged)
                for run in _taken_in(graph, trail, hanging, junction)
            ),
            key=lambda choice: _cost(graph, choice[1], merged[choice[0]]),
        )
        closed = _start(graph, run[0]) == _start(graph, _turned(run)[0])
        merged[host] = Trail(run, closed)
    counts = Counter(traversal.segment for trail in merged for traversal in trail.traversals)
    return in_wire_order(graph, merged), tuple(sorted(e for e, count in counts.items() if count > 1))


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
    """A walk along the trail from the junction and back to it; parts that come back anyway run once."""
    parts: list[list[Traversal]] = [[]]
    for traversal in hanging.traversals:
        if _start(graph, traversal) == junction and parts[-1]:
            parts.append([])
        parts[-1].append(traversal)
    trip: Run = ()
    for part in map(tuple, parts):
        back = _turned(part)
        leaves, returns = _start(graph, part[0]) == junction, _start(graph, back[0]) == junction
        trip += part if leaves and returns else part + back if leaves else back + part
    return trip


def _cost(graph: Graph, run: Run, host: Trail) -> tuple[int, float, Run]:
    return len(run), sum(bends_of(graph, Trail(run, False))) - sum(bends_of(graph, host)), run


def _turned(run: Run) -> Run:
    return tuple(Traversal(t.segment, not t.reversed) for t in reversed(run))


def _start(graph: Graph, traversal: Traversal) -> int:
    return graph.junction_of[2 * traversal.segment + traversal.reversed]
