"""Where lines run along one another with less room between them than wire needs."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from wrapit.fit.model import Limits
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import FloatArray, IntArray

# They are too near at this share of the room that they need: what is made to have room isn't made again.
_NEARER: Final = 0.98
# They run along one another where directions differ by less than 12 degrees (its sine); tips taper by more.
_PARALLEL: Final = 0.21
# Lines that leave one node at a small angle are near one another at first: for so many rooms along them they
# may be (three are 19 degrees).
PARTING: Final = 3.0
# They run along one another where they are near for so many rooms; less is a meeting.
_ALONG: Final = 2.0
# Places of a line that are as near as that (mm) to one another line's: which is nearer is chance.
_ALIKE_MM: Final = 1e-6


@dataclass(frozen=True)
class Stretch:
    """Where a line runs along another: from and to in mm along it, and the same places along the other."""

    line: int
    other: int
    span_mm: tuple[float, float]
    beside_mm: tuple[float, float]

    def turned(self) -> Stretch:
        """The same seen from the other line."""
        (low, first), (high, last) = sorted(zip(self.beside_mm, self.span_mm, strict=True))
        return Stretch(self.other, self.line, (low, high), (first, last))


def stretches(
    sketch: Sketch, near: Near, limits: Limits, density: Mapping[frozenset[int], float], keep: frozenset[int]
) -> list[Stretch]:
    """Where lines run along others, the longest stretch first; the line is the lesser of the two.

    `near` are the places of this sketch that are too near.
    """
    room_mm = limits.room_mm
    near = _parted(sketch, near, PARTING * room_mm)
    found: list[tuple[tuple[float, ...], Stretch]] = []
    for one, other, table in near.by_pair():
        if min(np.ptp(table[:, 0]), np.ptp(table[:, 1])) < _ALONG * room_mm:
            continue
        lines = [sketch.lines[one], sketch.lines[other]]
        weight = [density.get(frozenset(line.origin), 1.0) * line.curve.length for line in lines]
        kept = [bool(line.origin & keep) for line in lines]
        if all(kept):
            continue
        lesser = 0 if (kept[0], weight[0], one) < (kept[1], weight[1], other) else 1
        own = table[:, lesser]
        pair = (one, other)
        for low, high in runs(own, room_mm):
            beside = (_beside(table, lesser, low), _beside(table, lesser, high))
            if high - low >= _ALONG * room_mm and abs(beside[1] - beside[0]) >= room_mm:
                stretch = Stretch(pair[lesser], pair[1 - lesser], (low, high), beside)
                # Of some as long that with the least lines comes first, however they are numbered.
                rank = np.round((low - high, weight[lesser], weight[1 - lesser]), 3).tolist()
                found.append(((*rank, *pair, low), stretch))
    return [stretch for _, stretch in sorted(found, key=lambda each: each[0])]


def _beside(table: FloatArray, lesser: int, at_mm: float) -> float:
    """The place on the other line that is nearest to one on the lesser; the middle of those as near."""
    there = table[table[:, lesser] == at_mm]
    return float(there[there[:, 2] < there[:, 2].min() + _ALIKE_MM, 1 - lesser].mean())


@dataclass(frozen=True, eq=False)
class Near:
    """Places where lines run too near to one another, (k,) each: two lines, mm along either, mm between."""

    one: IntArray
    other: IntArray
    at: FloatArray
    other_at: FloatArray
    gap: FloatArray

    def where(self, chosen: NDArray[np.bool_]) -> Near:
        """Some of the places."""
        along = self.at[chosen], self.other_at[chosen], self.gap[chosen]
        return Near(self.one[chosen], self.other[chosen], *along)

    def with_(self, known: Near, same: NDArray[np.bool_]) -> Near:
        """These places, and those known of lines that are the same, (n,) by number."""
        still = known.where(same[known.one] & same[known.other])
        names = [field.name for field in fields(Near)]
        return Near(*(np.concatenate([getattr(self, name), getattr(still, name)]) for name in names))

    def by_pair(self) -> Iterator[tuple[int, int, FloatArray]]:
        """Each two lines that are near, and mm along the one, along the other and between, (k, 3)."""
        table = np.column_stack([self.at, self.other_at, self.gap])
        pairs, which = np.unique(np.column_stack([self.one, self.other]), axis=0, return_inverse=True)
        for index, (one, other) in enumerate(pairs.tolist()):
            yield one, other, table[which.ravel() == index]


def near_places(sketch: Sketch, room_mm: float, before: tuple[Sketch, Near] | None = None) -> Near:
    """Places where lines run too near to one another, or to themselves.

    What is known of the sketch as it was `before` holds for two lines that are both the same still.
    """
    from scipy.spatial import cKDTree

    old: Mapping[int, Line] = before[0].lines if before is not None else {}
    numbers = sorted(sketch.lines)
    trails = [sketch.lines[n].trail for n in numbers]
    points, at, along = (np.concatenate(each) for each in zip(*trails, strict=True))
    owner = np.repeat(numbers, [len(trail[0]) for trail in trails])
    same = np.zeros(max(*numbers, *old, 0) + 1, dtype=bool)
    same[[n for n in numbers if sketch.lines[n] is old.get(n)]] = True
    fresh = np.flatnonzero(~same[owner])
    reach_mm = _NEARER * room_mm
    pairs = cKDTree(points[fresh]).sparse_distance_matrix(cKDTree(points), reach_mm, output_type="ndarray")
    one, other, gap = fresh[pairs["i"]], pairs["j"], pairs["v"]
    first, second = along[one], along[other]
    # Two new places are found from either.
    chosen = (one < other) | same[owner[other]]
    chosen &= (np.abs(at[one] - at[other]) > PARTING * room_mm) | (owner[one] != owner[other])
    chosen &= np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) < _PARALLEL
    one, other = np.sort([one[chosen], other[chosen]], axis=0)
    found = Near(owner[one], owner[other], at[one], at[other], gap[chosen])
    return found if before is None else found.with_(before[1], same)


def _parted(sketch: Sketch, near: Near, parting_mm: float) -> Near:
    """Places of two lines that haven't just parted at a node."""
    size = max(sketch.lines) + 1
    nodes, length = np.full((size, 2), -1), np.zeros(size)
    for n, line in sketch.lines.items():
        nodes[n], length[n] = (line.start, line.end), line.curve.length
    ways = np.stack([near.at, length[near.one] - near.at])
    others = np.stack([near.other_at, length[near.other] - near.other_at])
    together = np.zeros(len(near.at), dtype=bool)
    for k, m in itertools.product((0, 1), repeat=2):
        shared = nodes[near.one, k] == nodes[near.other, m]
        together |= shared & (np.maximum(ways[k], others[m]) < parting_mm)
    return near.where(~together & (near.one != near.other))


def runs(places_mm: FloatArray, gap_mm: float) -> list[tuple[float, float]]:
    """Runs of places without a gap."""
    ordered = np.unique(places_mm)
    breaks = np.flatnonzero(np.diff(ordered) > gap_mm)
    starts, ends = np.r_[0, breaks + 1], np.r_[breaks, len(ordered) - 1]
    return [(float(ordered[a]), float(ordered[b])) for a, b in zip(starts, ends, strict=True)]
