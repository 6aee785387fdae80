"""What the solvers see of a drawing: which segment ends meet, and how sharply a wire would bend."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from wrapit.decomposition.model import Solution, half_edges
from wrapit.drawing.model import Drawing
from wrapit.geometry import FloatArray, locked
from wrapit.geometry.disjoint_sets import Sets

# Headings are whole multiples of this. Mirror images, and pairings of the same ends that cross or nest, then
# bend by exactly the same, and no choice between them hangs on the last bit that some machine computes.
# 1.2e-10 rad: far above the error of an arctangent, far below any bend that could be seen.
_GRAIN_RAD = 2.0**-33
_HALF_TURN = round(math.pi / _GRAIN_RAD)


class SecondRun(NamedTuple):
    """What an optional segment is the second run of, and its cost in mean segments."""

    segment: int
    cost: float


@dataclass(frozen=True, eq=False)
class Graph:
    """A multigraph of segments with directions at their ends, and no other geometry.

    Segment e has half-edges 2e (its start) and 2e + 1 (its end). `junction_of[h]` is the junction
    of half-edge h; `tangents` (2 · segments, 2) are unit directions pointing away from the
    junction. Segments that may stay unused are `bridges` and `second_runs`, which join the same junctions as
    some other segment does. Raises ValueError where sizes disagree.
    """

    junction_of: tuple[int, ...]
    tangents: FloatArray
    lengths_mm: tuple[float, ...]
    bridges: frozenset[int] = frozenset()
    second_runs: Mapping[int, SecondRun] = field(default_factory=dict)

    def __post_init__(self) -> None:
        tangents = locked(np.reshape(self.tangents, (-1, 2)))
        if not len(self.junction_of) == len(tangents) == 2 * len(self.lengths_mm):
            raise ValueError("a graph has two half-edges and two tangents per segment")
        object.__setattr__(self, "tangents", tangents)

    @property
    def segments(self) -> int:
        """Number of segments, bridges included."""
        return len(self.lengths_mm)

    @cached_property
    def optional(self) -> frozenset[int]:
        """The segments that may stay unused."""
        return self.bridges | self.second_runs.keys()

    @cached_property
    def incident(self) -> tuple[tuple[int, ...], ...]:
        """The half-edges at each junction, in rising order."""
        incident: list[list[int]] = [[] for _ in range(max(self.junction_of, default=-1) + 1)]
        for half_edge, junction in enumerate(self.junction_of):
            incident[junction].append(half_edge)
        return tuple(map(tuple, incident))

    @cached_property
    def piece_of(self) -> tuple[int, ...]:
        """For each segment, the number of the connected piece that it belongs to."""
        number = {e: index for index, piece in enumerate(pieces(self)) for e in piece}
        return tuple(number[e] for e in range(self.segments))

    @cached_property
    def directions(self) -> list[tuple[float, float]]:
        """The tangents as plain numbers, which are quicker to read one by one."""
        return [(x, y) for x, y in self.tangents.tolist()]

    @cached_property
    def bends_rad(self) -> tuple[dict[int, float], ...]:
        """For each half-edge, the bend angle in [0, π] towards each one that a wire may continue into.

        Paper, section 4.2, with the absolute value that makes left and right bends cost the same.
        The two ends of one loop are no transition: they would close a ring.
        """
        pairs = np.array(
            [
                (a, b)
                for ends in self.incident
                for i, a in enumerate(ends)
                for b in ends[i + 1 :]
                if a ^ 1 != b
            ],
            dtype=np.int64,
        ).reshape(-1, 2)
        headings = np.round(np.arctan2(self.tangents[:, 1], self.tangents[:, 0]) / _GRAIN_RAD)
        apart = np.abs(headings[pairs[:, 0]] - headings[pairs[:, 1]])
        angles = (_HALF_TURN - np.minimum(apart, 2 * _HALF_TURN - apart)) * _GRAIN_RAD
        bends: tuple[dict[int, float], ...] = tuple({} for _ in self.junction_of)
        for (a, b), angle in zip(pairs.tolist(), angles.tolist(), strict=True):
            bends[a][b] = bends[b][a] = angle
        return bends

    def subgraph(self, segments: Sequence[int]) -> Graph:
        """The graph of these segments alone, segments and junctions renumbered in order.

        Raises KeyError for a second run without the segment that it is one of.
        """
        place = {e: index for index, e in enumerate(segments)}
        ends = [h for e in segments for h in half_edges(e)]
        junctions = sorted({self.junction_of[h] for h in ends})
        number = {junction: index for index, junction in enumerate(junctions)}
        return Graph(
            tuple(number[self.junction_of[h]] for h in ends),
            self.tangents[ends],
            tuple(self.lengths_mm[e] for e in segments),
            frozenset(index for e, index in place.items() if e in self.bridges),
            {
                place[e]: SecondRun(place[run.segment], run.cost)
                for e, run in self.second_runs.items()
                if e in place
            },
        )


def graph_of(drawing: Drawing) -> Graph:
    """The graph of a drawing, same numbers of segments and junctions."""
    tangents = [
        tangent
        for segment in drawing.segments
        for tangent in (segment.curve.start_tangent, -segment.curve.end_tangent)
    ]
    return Graph(
        tuple(junction for segment in drawing.segments for junction in (segment.start, segment.end)),
        np.reshape(tangents, (-1, 2)),
        tuple(segment.curve.length for segment in drawing.segments),
        frozenset(segment.id for segment in drawing.segments if segment.kind == "bridge"),
    )


def pieces(graph: Graph, links: Iterable[tuple[int, int]] = ()) -> list[list[int]]:
    """Segments of each connected piece, in rising order; `links` tie further pairs of segments together."""
    sets = Sets(tuple(h >> 1 for h in ends) for ends in graph.incident)
    for e, f in links:
        sets.merge(e, f)
    groups: dict[int, list[int]] = {}
    for e in range(graph.segments):
        groups.setdefault(sets.find(e), []).append(e)
    return list(groups.values())


def fewest_possible_wires(graph: Graph) -> int:
    """Least number of wires that cover the strokes: half the odd junctions of each piece, at least one.

    Euler: each trail has two ends, and a wire ends at every junction where an odd number of
    segment ends meet.
    """
    strokes = graph.subgraph([e for e in range(graph.segments) if e not in graph.optional])
    odd = [len(ends) % 2 for ends in strokes.incident]
    return sum(
        max(1, sum(odd[j] for j in {strokes.junction_of[h] for e in piece for h in half_edges(e)}) // 2)
        for piece in pieces(strokes)
    )


def most_of_a_piece(solution: Solution) -> int:
    """Of the pieces that touch nothing else, the number of wires of the one that has most."""
    piece_of = graph_of(solution.decomposition.drawing).piece_of
    return max(Counter(piece_of[trail.traversals[0].segment] for trail in solution.trails).values())
