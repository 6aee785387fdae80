"""Second runs: every line offered once more, to be laid side by side with its first run."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from wrapit.decomposition.graph import Graph, SecondRun
from wrapit.decomposition.model import half_edges
from wrapit.drawing.model import Drawing
from wrapit.geometry import BezierChain, from_chain
from wrapit.geometry.arclength import ArcLength

# What a cramped second run costs besides, in mean segments: any other way of at most so much more is taken.
_CRAMPED = 1.0
# Steps (mm) at which bends are looked at: a quarter of the thinnest wire.
_STEP_MM = 0.1


@dataclass(frozen=True)
class SideBySide:
    """What two runs of a wire beside one another need: `apart_mm` between them, and bends of a radius.

    A line with less than `shortest_mm` has no room for both to part and meet again.
    """

    apart_mm: float
    radius_mm: float
    shortest_mm: float

    def is_cramped(self, curve: BezierChain) -> bool:
        """Whether a line is too short, or bends too tightly for its inner run."""
        if curve.length < self.shortest_mm:
            return True
        lengths = ArcLength(from_chain(curve))
        at_mm = lengths.stations(_STEP_MM)
        curvature = lengths.spline.curvature(lengths.parameter((at_mm[:-1] + at_mm[1:]) / 2))
        return bool(np.abs(curvature).max() * (self.radius_mm + self.apart_mm / 2) > 1)


def cramped(drawing: Drawing, room: SideBySide | None) -> frozenset[int]:
    """The segments along which two runs have too little room; none where nothing is known of the wire."""
    if room is None:
        return frozenset()
    return frozenset(segment.id for segment in drawing.segments if room.is_cramped(segment.curve))


def with_second_runs(graph: Graph, dearer: frozenset[int] = frozenset()) -> Graph:
    """The graph with a second run of every stroke appended, in their order.

    Its cost is its length in mean strokes, and _CRAMPED more for those that are `dearer`. Strokes that start
    and end at one junction are left out: running round once more changes neither parity nor connection.
    """
    strokes = [e for e in range(graph.segments) if e not in graph.optional]
    mean_mm = sum(graph.lengths_mm[e] for e in strokes) / len(strokes)
    twice = [e for e in strokes if graph.junction_of[2 * e] != graph.junction_of[2 * e + 1]]
    ends = [h for e in twice for h in half_edges(e)]
    costs = [graph.lengths_mm[e] / mean_mm + _CRAMPED * (e in dearer) for e in twice]
    return replace(
        graph,
        junction_of=(*graph.junction_of, *(graph.junction_of[h] for h in ends)),
        tangents=np.concatenate([graph.tangents, graph.tangents[ends]]),
        lengths_mm=(*graph.lengths_mm, *(graph.lengths_mm[e] for e in twice)),
        second_runs={
            graph.segments + index: SecondRun(e, cost)
            for index, (e, cost) in enumerate(zip(twice, costs, strict=True))
        },
    )
