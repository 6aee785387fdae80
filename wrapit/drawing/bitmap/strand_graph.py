"""The working graph of tracing: nodes and strands of points, in pixels, y down.

It lives only inside `trace`; what leaves is a `Drawing`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from wrapit.drawing.changes import Change, Notice
from wrapit.errors import Level
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import total_length

# A strand's number, and 0 for its start or 1 for its end.
StrandEnd: TypeAlias = tuple[int, int]


@dataclass(eq=False)
class Strand:
    """A chain of points (n, 2) between two nodes, without the nodes' own places."""

    start: int
    end: int
    points: FloatArray


@dataclass(eq=False)
class StrandGraph:
    """Nodes (places) and strands by number; numbers are never used twice.

    `through` holds, for nodes where it is known, which strand ends continue each other; `corners` are
    nodes that stay although only two strand ends meet there, and `placed` those of them whose places are
    known better than by what points at them.
    """

    nodes: dict[int, FloatArray] = field(default_factory=dict)
    strands: dict[int, Strand] = field(default_factory=dict)
    changes: list[Change] = field(default_factory=list)
    notices: list[Notice] = field(default_factory=list)
    through: dict[int, tuple[tuple[StrandEnd, StrandEnd], ...]] = field(default_factory=dict)
    corners: set[int] = field(default_factory=set)
    placed: set[int] = field(default_factory=set)
    _next: int = 0
    _ends: dict[int, list[StrandEnd]] = field(default_factory=dict)

    def add_node(self, point: FloatArray) -> int:
        """Number of a new node."""
        node, self._next = self._next, self._next + 1
        self.nodes[node] = np.asarray(point, dtype=np.float64)
        self._ends[node] = []
        return node

    def add_strand(self, start: int, end: int, points: FloatArray) -> int:
        """Number of a new strand."""
        strand, self._next = self._next, self._next + 1
        self.strands[strand] = Strand(start, end, np.asarray(points, dtype=np.float64).reshape(-1, 2))
        self._ends[start].append((strand, 0))
        self._ends[end].append((strand, 1))
        return strand

    def ends_at(self, node: int) -> list[StrandEnd]:
        """The strand ends at a node: (strand, 0) where it starts, (strand, 1) where it ends."""
        return self._ends[node]

    def degree(self, node: int) -> int:
        """Number of strand ends at a node."""
        return len(self._ends[node])

    def is_seam(self, node: int) -> bool:
        """Whether a closed strand starts and ends at a node only because it must somewhere."""
        ends = self._ends[node]
        return len(ends) == 2 and ends[0][0] == ends[1][0] and node not in self.corners

    def other_node(self, strand: int, end: int) -> int:
        """The node at the other end of a strand."""
        return self.strands[strand].end if end == 0 else self.strands[strand].start

    def path(self, strand: int) -> FloatArray:
        """The strand's points with its nodes at both ends, (n + 2, 2)."""
        s = self.strands[strand]
        points = np.empty((len(s.points) + 2, 2))
        points[0], points[1:-1], points[-1] = self.nodes[s.start], s.points, self.nodes[s.end]
        return points

    def leaving(self, strand: int, end: int) -> FloatArray:
        """The strand's points walked away from one of its ends."""
        points = self.strands[strand].points
        return points if end == 0 else points[::-1]

    def length(self, strand: int) -> float:
        """Length of the path of a strand."""
        return total_length(self.path(strand))

    def drop_strand(self, strand: int) -> None:
        """Takes a strand away; its nodes stay."""
        s = self.strands.pop(strand)
        for node in {s.start, s.end}:
            self._ends[node] = [end for end in self._ends[node] if end[0] != strand]

    def drop_lonely(self) -> None:
        """Takes nodes without strands away."""
        for node in [node for node, ends in self._ends.items() if not ends]:
            del self.nodes[node], self._ends[node]

    def reroute(self, strand: int, end: int, node: int) -> None:
        """Moves one end of a strand to another node."""
        s = self.strands[strand]
        old = s.start if end == 0 else s.end
        self._ends[old].remove((strand, end))
        self._ends[node].append((strand, end))
        if end == 0:
            s.start = node
        else:
            s.end = node

    def merge(self, nodes: list[int], point: FloatArray, inner: list[int]) -> int:
        """One node in place of several; the strands `inner` between them vanish, others become loops."""
        for strand in inner:
            self.drop_strand(strand)
        kept = nodes[0]
        self.nodes[kept] = np.asarray(point, dtype=np.float64)
        for node in nodes[1:]:
            for strand, end in list(self._ends[node]):
                self.reroute(strand, end, kept)
            del self.nodes[node], self._ends[node]
        return kept

    def rejoin(self, node: int) -> int | None:
        """One strand in place of the two that meet at a node of degree two; its number."""
        ends = self._ends[node]
        if len(ends) != 2 or ends[0][0] == ends[1][0]:
            return None
        (first, first_end), (second, second_end) = ends
        a, b = self.strands[first], self.strands[second]
        before = self.leaving(first, first_end)[::-1]
        after = self.leaving(second, second_end)
        start = a.end if first_end == 0 else a.start
        end = b.end if second_end == 0 else b.start
        points = np.vstack([before, self.nodes[node][None], after])
        self.drop_strand(first)
        self.drop_strand(second)
        del self.nodes[node], self._ends[node]
        return self.add_strand(start, end, points)

    def rejoin_all(self) -> None:
        """Rejoins at every node of degree two but corners (a closed loop keeps its one node)."""
        for node in [node for node in self.nodes if self.degree(node) == 2 and node not in self.corners]:
            self.rejoin(node)

    def note(self, what: str, at_px: FloatArray, length_px: float, reason: str) -> None:
        """Remembers what clean-up did."""
        self.changes.append(Change(what, (float(at_px[0]), float(at_px[1])), float(length_px), reason))

    def tell(self, level: Level, code: str, at_px: FloatArray, message: str, remedy: str = "") -> None:
        """Remembers something to tell the maker."""
        self.notices.append(Notice(level, code, (float(at_px[0]), float(at_px[1])), message, remedy))
