"""Stretches that are run along twice, and which of their two runs lies on which side."""

from __future__ import annotations

import dataclasses
import math
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.decomposition.model import Trail, Traversal
from wrapit.drawing.model import Drawing
from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import piece

# Lines that leave a junction nearer to one direction than this part on neither side.
SAME_WAY_RAD = 1e-3


@dataclass(frozen=True)
class Strand:
    """Traversals `first` to `last` (included) of a trail, as one of the two runs of a stretch."""

    trail: int
    first: int
    last: int


@dataclass(frozen=True)
class Stretch:
    """Segments that two runs pass together, as the first of them meets them.

    `opposed` says that the second runs the other way; `side` is 1 where the first lies to the left, seen in
    its own direction of travel, and -1 where it lies to the right.
    """

    segments: tuple[int, ...]
    strands: tuple[Strand, Strand]
    opposed: bool
    side: int = 1

    @property
    def folded(self) -> bool:
        """Whether the first run turns round at the end and becomes the second."""
        one, other = self.strands
        return self.opposed and one.trail == other.trail and other.first == one.last + 1

    @property
    def swapped(self) -> Stretch:
        """With its runs on the other sides of one another."""
        return dataclasses.replace(self, side=-self.side)

    def shifts(self, apart_mm: float) -> tuple[float, float]:
        """How far to the left of the line each run lies, seen in its own direction of travel."""
        first_mm = self.side * apart_mm / 2
        return first_mm, first_mm if self.opposed else -first_mm


def find_stretches(
    drawing: Drawing, trails: Sequence[Trail], apart_mm: float, left_out: Collection[int] = ()
) -> tuple[Stretch, ...]:
    """The longest stretches of segments with two runs, each with its side; segments left out have none.

    Where both runs pass from one segment to the next they are one stretch, and keep their sides.
    """
    places: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for trail, walk in enumerate(trails):
        for index, step in enumerate(walk.traversals):
            places[step.segment].append((trail, index))
    twice = {e: (at[0], at[1]) for e, at in places.items() if len(at) == 2 and e not in left_out}
    stretches, taken = [], set[int]()
    for segment, at in sorted(twice.items(), key=lambda item: item[1]):
        if segment not in taken:
            stretch = _longest(trails, twice, at, taken)
            taken |= set(stretch.segments)
            stretches.append(_sided(drawing, trails, stretch, apart_mm))
    return tuple(stretches)


def _longest(
    trails: Sequence[Trail],
    twice: dict[int, tuple[tuple[int, int], tuple[int, int]]],
    at: tuple[tuple[int, int], tuple[int, int]],
    taken: set[int],
) -> Stretch:
    """The stretch through one segment: it goes on as long as both runs pass to the same next one."""
    (trail, first), (other, place) = at
    opposed = _step(trails, trail, first).reversed != _step(trails, other, place).reversed
    way = -1 if opposed else 1
    used = {_step(trails, trail, first).segment} | taken

    def goes_on(one: int, two: int) -> bool:
        if not (0 <= one < len(trails[trail].traversals) and 0 <= two < len(trails[other].traversals)):
            return False
        ours, theirs = _step(trails, trail, one), _step(trails, other, two)
        same = ours.segment == theirs.segment and (ours.reversed != theirs.reversed) == opposed
        if not same or ours.segment in used or ours.segment not in twice:
            return False
        used.add(ours.segment)
        return True

    ahead = behind = 0
    while goes_on(first + ahead + 1, place + way * (ahead + 1)):
        ahead += 1
    while goes_on(first - behind - 1, place - way * (behind + 1)):
        behind += 1
    ends = sorted((place + way * ahead, place - way * behind))
    steps = trails[trail].traversals[first - behind : first + ahead + 1]
    return Stretch(
        tuple(step.segment for step in steps),
        (Strand(trail, first - behind, first + ahead), Strand(other, ends[0], ends[1])),
        opposed,
    )


def _sided(drawing: Drawing, trails: Sequence[Trail], stretch: Stretch, apart_mm: float) -> Stretch:
    """The stretch with the side on which its runs cross least where they part; the first to the left if even.

    At a junction, the run that goes on to the next line counter-clockwise from the stretch lies to the right
    of one who comes along the stretch.
    """
    one, other = stretch.strands
    wish = 0
    for at_end in (True, False):
        beyond = trails[one.trail].traversals
        own = _half_edge(beyond, one.last if at_end else one.first, arriving=at_end)
        ours = _half_edge(beyond, one.last + 1 if at_end else one.first - 1, arriving=not at_end)
        leaves = at_end != stretch.opposed
        theirs = _half_edge(
            trails[other.trail].traversals, other.last + 1 if leaves else other.first - 1, arriving=not leaves
        )
        if own is None or ours is None or theirs is None or own in (ours, theirs):
            continue
        zero, a, b = (_heading(drawing, half_edge, apart_mm) for half_edge in (own, ours, theirs))
        a, b = (a - zero) % math.tau, (b - zero) % math.tau
        if abs(a - b) > SAME_WAY_RAD:
            wish += 1 if (a < b) != at_end else -1
    return Stretch(stretch.segments, stretch.strands, stretch.opposed, -1 if wish < 0 else 1)


def _half_edge(steps: Sequence[Traversal], index: int, *, arriving: bool) -> int | None:
    if not 0 <= index < len(steps):
        return None
    return steps[index].arrival if arriving else steps[index].departure


def _heading(drawing: Drawing, half_edge: int, apart_mm: float) -> float:
    """Direction in which a segment leaves its junction, seen over the first two wires of its way.

    Its tangent would not tell which of two lines that leave together bends to which side.
    """
    curve = drawing.segments[half_edge // 2].curve
    if half_edge % 2:
        curve = curve.reversed()
    way: FloatArray = piece(curve, 0.0, min(2 * apart_mm, curve.length / 2)).end - curve.start
    return float(np.arctan2(way[1], way[0]))


def _step(trails: Sequence[Trail], trail: int, index: int) -> Traversal:
    return trails[trail].traversals[index]
