"""A decomposition: at each junction, which segment ends continue into one another."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import NamedTuple

from wrapit.config.decomposition import SolverName
from wrapit.drawing.model import Drawing

NO_MATE = -1
"""Stands in a matching for the mate of a half-edge at which a wire ends; no half-edge has this number."""

Pair = tuple[int, int]
"""Two half-edges (or two segments) in rising order, so that a transition has one name."""


def half_edges(segment: int) -> Pair:
    """The half-edges of a segment: at its start, and at its end.

    >>> half_edges(3)
    (6, 7)
    """
    return 2 * segment, 2 * segment + 1


def ordered(a: int, b: int) -> Pair:
    """Two numbers as the name of what is the same from both sides, such as a transition.

    >>> ordered(5, 2)
    (2, 5)
    """
    return (a, b) if a < b else (b, a)


class Traversal(NamedTuple):
    """One segment as a wire runs along it."""

    segment: int
    reversed: bool

    @property
    def departure(self) -> int:
        """The half-edge at which the wire enters the segment."""
        return 2 * self.segment + self.reversed

    @property
    def arrival(self) -> int:
        """The half-edge at which the wire leaves the segment."""
        return self.departure ^ 1


@dataclass(frozen=True)
class Trail:
    """A walk that repeats no segment (the paper's Eulerian path); one trail is one wire.

    `closed` trails end where they start; the wire is left open there.
    """

    traversals: tuple[Traversal, ...]
    closed: bool


@dataclass(frozen=True)
class Transition:
    """One trail crossing one junction between two half-edges."""

    junction: int
    arriving: int
    leaving: int
    bend_angle_rad: float


@dataclass(frozen=True, eq=False)
class Decomposition:
    """`mate[h]` is the half-edge that the wire on half-edge h continues into, or NO_MATE at a wire end.

    Segment e has `half_edges(e)`, 2e at its start and 2e + 1 at its end. Second runs on offer come after
    the drawing's segments (`second_runs.with_second_runs`).
    """

    drawing: Drawing
    mate: tuple[int, ...]


@dataclass(frozen=True)
class Weights:
    """The weights of the energy.

    `E = N + λs·bends + λr·weak wires + λb·bridges` (paper, equations 1 to 4) `+ λm·asymmetry + λd·doubling`.
    """

    smoothness: float = 0.1
    robustness: float = 0.9
    bridges: float = 0.1
    symmetry: float = 0.0
    doubling: float = 1.0


@dataclass(frozen=True)
class Energy:
    """The terms of the energy, unweighted, and the weighted total.

    `asymmetry` counts mirrored junctions that are treated unlike one another, where asked for; `doubling`
    is the length that is run along a second time, in mean segments.
    """

    complexity: int
    smoothness_rad: float
    robustness: int
    bridges: int
    total: float
    asymmetry: int = 0
    doubling: float = 0.0


@dataclass(frozen=True, eq=False)
class Solution:
    """A decomposition with its trails and what is known about its quality.

    `trails` are in wire order. `lower_bound` is proven (None when the solver proves none);
    `doubled` are segments that a wire runs along twice; `bridges_used` are bridge segments in use.
    """

    decomposition: Decomposition
    trails: tuple[Trail, ...]
    energy: Energy
    weights: Weights
    solver: SolverName
    seed: int
    iterations: int
    lower_bound: float | None = None
    optimal: bool = False
    bridges_used: tuple[int, ...] = ()
    doubled: tuple[int, ...] = ()

    @property
    def doubled_mm(self) -> float:
        """Length that wires run along once more, after they or others have run along it."""
        segments = self.decomposition.drawing.segments
        runs = Counter(each.segment for trail in self.trails for each in trail.traversals)
        return sum((count - 1) * segments[e].curve.length for e, count in runs.items())
