"""What another answer has to differ from: wires, whatever the names of the two runs along one line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import compress, islice, product

from wrapit.decomposition.exact.cutting_planes import Cut, exclusion_cut
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, half_edges
from wrapit.decomposition.rules import in_use
from wrapit.decomposition.trails import walk

# Names under which an answer is excluded at once; under others when they turn up, a round each. The four
# best of nets of 30 segments with one wire take 0.6 to 1.6 s with 1 to 64 of them, and up to 5.7 with 256.
_NAMINGS = 64

Wire = tuple[int, ...]


class Others:
    """The answers that there are already."""

    def __init__(self, graph: Graph, mates: Sequence[Sequence[int]]) -> None:
        self._graph = graph
        self._wires = {_wires(graph, mate) for mate in mates}
        self.cuts = [cut for mate in mates for cut in exclusion_cuts(graph, mate)]

    def have(self, mate: Sequence[int]) -> bool:
        """Whether a matching without rings makes the wires of one of them."""
        return bool(self._wires) and _wires(self._graph, mate) in self._wires


def exclusion_cuts(graph: Graph, mate: Sequence[int]) -> Iterator[Cut]:
    """That a matching isn't this one, with the runs along each line either way round."""
    swaps = [
        (e, run.segment)
        for e, run in graph.second_runs.items()
        if in_use(graph, mate, e) and any(mate[h] != NO_MATE for h in half_edges(run.segment))
    ]
    named = (
        tuple(_renamed(mate, compress(swaps, some))) for some in product((False, True), repeat=len(swaps))
    )
    for other in dict.fromkeys(islice(named, _NAMINGS)):
        yield exclusion_cut(graph, other)


def _renamed(mate: Sequence[int], swaps: Iterator[tuple[int, int]]) -> list[int]:
    """The matching with each of these two segments in the place of the other."""
    name = list(range(len(mate)))
    for e, f in swaps:
        for h, other in zip(half_edges(e), half_edges(f), strict=True):
            name[h], name[other] = other, h
    renamed = [NO_MATE] * len(mate)
    for h, other in enumerate(mate):
        if other != NO_MATE:
            renamed[name[h]] = name[other]
    return renamed


def _wires(graph: Graph, mate: Sequence[int]) -> tuple[Wire, ...]:
    """Each wire as the departures along the lines of the drawing, the same from wherever it is looked at.

    From the end that makes the lesser name; a closed wire, which may be left open anywhere, from anywhere.
    """
    wires = []
    for h, other in enumerate(mate):
        if other != NO_MATE or not in_use(graph, mate, h >> 1):
            continue
        steps = walk(mate, h)
        far = steps[-1] ^ 1
        if far < h:
            continue
        there = tuple(_line(graph, step) for step in steps)
        back = tuple(step ^ 1 for step in reversed(there))
        starts = range(len(there)) if far in graph.bends_rad[h] else (0,)
        wires.append(min((*way[i:], *way[:i]) for way in (there, back) for i in starts))
    return tuple(sorted(wires))


def _line(graph: Graph, h: int) -> int:
    """A half-edge of a second run as that of the line that it runs along."""
    run = graph.second_runs.get(h >> 1)
    return h if run is None else 2 * run.segment + (h & 1)
