"""Where lines run along one another with less room between them than wire needs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.fit.model import Limits
from wrapit.fit.sketch import Sketch
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.polyline import lengths

# How finely lines are compared (mm).
_STEP_MM: Final = 0.25
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
    sketch: Sketch, limits: Limits, density: Mapping[frozenset[int], float], keep: frozenset[int]
) -> list[Stretch]:
    """Where lines run along others, the longest stretch first; the line is the lesser of the two."""
    room_mm = limits.room_mm
    near: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
    for one, at, other, other_at, gap in near_places(sketch, room_mm):
        if one != other and not _part_there(sketch, one, at, other, other_at, PARTING * room_mm):
            near.setdefault((one, other), []).append((at, other_at, gap))
    found: list[tuple[tuple[float, ...], Stretch]] = []
    for (one, other), places in sorted(near.items()):
        table = np.array(places)
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


def near_places(sketch: Sketch, room_mm: float) -> Iterator[tuple[int, float, int, float, float]]:
    """Places where lines run too near to one another: line and mm along it, twice, and how far apart."""
    from scipy.spatial import cKDTree

    numbers = sorted(sketch.lines)
    points = [sketch.lines[n].curve.sampled(_STEP_MM) for n in numbers]
    every = np.concatenate(points)
    owner = np.repeat(numbers, [len(each) for each in points])
    at = np.concatenate(
        [_along(sketch.lines[n].curve, each) for n, each in zip(numbers, points, strict=True)]
    )
    pairs = cKDTree(every).query_pairs(_NEARER * room_mm, output_type="ndarray")
    far = np.abs(at[pairs[:, 0]] - at[pairs[:, 1]]) > PARTING * room_mm
    pairs = pairs[far | (owner[pairs[:, 0]] != owner[pairs[:, 1]])]
    along = np.concatenate([unit(np.gradient(each, axis=0)) for each in points])
    first, second = along[pairs[:, 0]], along[pairs[:, 1]]
    pairs = pairs[np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) < _PARALLEL]
    apart = np.hypot(*(every[pairs[:, 0]] - every[pairs[:, 1]]).T)
    for (i, j), gap in zip(pairs.tolist(), apart.tolist(), strict=True):
        yield int(owner[i]), float(at[i]), int(owner[j]), float(at[j]), gap


def _along(curve: BezierChain, points: FloatArray) -> FloatArray:
    """Where along a curve its points are: chords alone are shorter than its bends, by 0.05 mm in some."""
    chords = lengths(points)
    return chords * (curve.length / max(float(chords[-1]), 1e-12))


def _part_there(
    sketch: Sketch, one: int, at_mm: float, other: int, other_mm: float, parting_mm: float
) -> bool:
    """Whether two places lie on lines that have just parted at a node."""
    first, second = sketch.lines[one], sketch.lines[other]
    ways = ((first.start, at_mm), (first.end, first.curve.length - at_mm))
    others = ((second.start, other_mm), (second.end, second.curve.length - other_mm))
    return any(
        node == their and max(way_mm, their_mm) < parting_mm
        for node, way_mm in ways
        for their, their_mm in others
    )


def runs(places_mm: FloatArray, gap_mm: float) -> list[tuple[float, float]]:
    """Runs of places without a gap."""
    ordered = np.unique(places_mm)
    breaks = np.flatnonzero(np.diff(ordered) > gap_mm)
    starts, ends = np.r_[0, breaks + 1], np.r_[breaks, len(ordered) - 1]
    return [(float(ordered[a]), float(ordered[b])) for a, b in zip(starts, ends, strict=True)]
