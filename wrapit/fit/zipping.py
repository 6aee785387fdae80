"""Lines that run along one another with less room between them than wire needs: they become one."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.merging import is_planar, led
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.arclength import piece
from wrapit.geometry.polyline import lengths

# How finely lines are compared (mm).
_STEP_MM: Final = 0.25
# They are too near at this share of the room that they need: what is made to have room isn't made again.
_NEARER: Final = 0.98
# They run along one another where directions differ by less than 12 degrees (its sine); tips taper by more.
_PARALLEL: Final = 0.21
# Lines that leave one node at a small angle are near one another at first: for so many rooms along them they
# may be (three are 19 degrees).
_PARTING: Final = 3.0
# They run along one another where they are near for so many rooms; less is a meeting.
_ALONG: Final = 2.0
# An end so many rooms away from the stretch comes along.
_SNAP: Final = 2.0
# Places of a line that are as near as that (mm) to one another line's: which is nearer is chance.
_ALIKE_MM: Final = 1e-6
# So many pairs at most become one: each leaves fewer lines that are near.
_MOST: Final = 60


@dataclass(frozen=True)
class Stretch:
    """Where a line runs along another: from and to in mm along it, and the same places along the other."""

    line: int
    other: int
    span_mm: tuple[float, float]
    beside_mm: tuple[float, float]


def zipped(sketch: Sketch, limits: Limits, worth: Mapping[int, float], keep: frozenset[int]) -> Sketch:
    """The sketch with lines that are too near to one another made one, the lesser led into the other.

    `worth` is that of lines; `keep` are segments of the original that stay.
    """
    density = {frozenset(sketch.lines[n].origin): worth[n] / sketch.lines[n].curve.length for n in worth}
    sketch = _folded(sketch, limits)
    failed: set[tuple[object, ...]] = set()
    for _ in range(_MOST):
        found = _stretches(sketch, limits, density, keep)
        stretch = next((s for s in found if _name(sketch, s) not in failed), None)
        if stretch is None:
            break
        result = _as_one(sketch, stretch, limits)
        if result is None:
            failed.add(_name(sketch, stretch))
        else:
            sketch = result
    return sketch


def _folded(sketch: Sketch, limits: Limits) -> Sketch:
    """Lines that come near themselves get a node half way of each bight: two that run along one another."""
    way_mm = 2 * _PARTING * limits.room_mm
    half: dict[int, list[float]] = {}
    for one, at, other, other_at, _ in _near_places(sketch, limits.room_mm):
        around = sketch.lines[one].curve.length - abs(at - other_at)
        if (
            one == other
            and abs(at - other_at) > way_mm
            and not (sketch.lines[one].is_ring and around < way_mm)
        ):
            half.setdefault(one, []).append((at + other_at) / 2)
    for number, places in sorted(half.items()):
        line, free = sketch.lines[number], max(sketch.nodes) + 1
        names = {0.0: line.start, line.curve.length: line.end}
        nodes: dict[int, FloatArray] = {}
        for low, high in _runs(np.array(places), limits.room_mm):
            at_mm = float(np.median([place for place in places if low <= place <= high]))
            names[at_mm] = free + len(nodes)
            nodes[names[at_mm]] = piece(line.curve, 0.0, at_mm).end
        sketch = sketch.changed((number,), _cut(sketch, number, names, {**sketch.nodes, **nodes}), nodes)
    return sketch


def _near_places(sketch: Sketch, room_mm: float) -> Iterator[tuple[int, float, int, float, float]]:
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
    far = np.abs(at[pairs[:, 0]] - at[pairs[:, 1]]) > _PARTING * room_mm
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


def _name(sketch: Sketch, stretch: Stretch) -> tuple[object, ...]:
    """What a stretch is known by while numbers of lines change: the lines' origins, and where they begin."""
    line, other = sketch.lines[stretch.line], sketch.lines[stretch.other]
    return line.origin, other.origin, round(stretch.span_mm[0], 3), round(stretch.beside_mm[0], 3)


def _stretches(
    sketch: Sketch, limits: Limits, density: Mapping[frozenset[int], float], keep: frozenset[int]
) -> list[Stretch]:
    """Where lines run along others, the longest stretch first; the line is the lesser of the two."""
    room_mm = limits.room_mm
    near: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
    for one, at, other, other_at, gap in _near_places(sketch, room_mm):
        if one != other and not _part_there(sketch, one, at, other, other_at, _PARTING * room_mm):
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
        for low, high in _runs(own, room_mm):
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


def _runs(places_mm: FloatArray, gap_mm: float) -> list[tuple[float, float]]:
    """Runs of places without a gap."""
    ordered = np.unique(places_mm)
    breaks = np.flatnonzero(np.diff(ordered) > gap_mm)
    starts, ends = np.r_[0, breaks + 1], np.r_[breaks, len(ordered) - 1]
    return [(float(ordered[a]), float(ordered[b])) for a, b in zip(starts, ends, strict=True)]


def _as_one(sketch: Sketch, stretch: Stretch, limits: Limits) -> Sketch | None:
    """The sketch without a stretch, what it joined led to the line beside; None where lines would cross."""
    snap_mm = _SNAP * limits.room_mm
    line, other = sketch.lines[stretch.line], sketch.lines[stretch.other]
    (low, high), length = stretch.span_mm, line.curve.length
    places = [_place(other, at_mm, snap_mm) for at_mm in stretch.beside_mm]
    if line.is_ring or places[0] == places[1]:
        return None
    nodes: dict[int, FloatArray] = {}
    free = max(sketch.nodes) + 1
    names: dict[float, int] = {0.0: other.start, other.curve.length: other.end}
    for at_mm in places:
        if at_mm not in names:
            names[at_mm] = free
            nodes[free] = piece(other.curve, 0.0, at_mm).end
            free += 1
    points = {**sketch.nodes, **nodes}
    lines = _cut(sketch, stretch.other, names, points)
    moves: dict[int, int] = {}
    number = max(sketch.lines) + len(lines) + 1
    for end, node, rest, at_mm in (
        (low, line.start, (0.0, low), places[0]),
        (high, line.end, (high, length), places[1]),
    ):
        if (end if rest[0] == 0.0 else length - end) <= snap_mm:
            moves[node] = names[at_mm]
            continue
        part = piece(line.curve, *rest)
        target = points[names[at_mm]]
        if rest[0] == 0.0:
            curve, _ = led(part, line.curve.start, target, limits.diameter_mm)
            lines[number] = Line(node, names[at_mm], curve, line.origin)
        else:
            curve, _ = led(part, target, line.curve.end, limits.diameter_mm)
            lines[number] = Line(names[at_mm], node, curve, line.origin)
        number += 1
    moves = {node: to for node, to in moves.items() if node != to}
    if {other.start, other.end} & set(moves):
        return None  # the line beside would have to move with it
    _lead(sketch, stretch, moves, points, lines)
    x, y = piece(line.curve, 0.0, (low + high) / 2).end
    told = Removal(
        "merged",
        (float(x), float(y)),
        high - low,
        f"it ran along another line with less than {limits.room_mm:.1f} mm between them",
    )
    result = sketch.changed((stretch.line, stretch.other), lines, nodes, (told,))
    return result if is_planar(result, lines, sketch) else None


def _lead(
    sketch: Sketch,
    stretch: Stretch,
    moves: Mapping[int, int],
    points: Mapping[int, FloatArray],
    lines: dict[int, Line],
) -> None:
    """Lines at nodes that move come along; adds them to `lines`."""
    for n, old in sorted(sketch.lines.items()):
        if n in (stretch.line, stretch.other) or not {old.start, old.end} & set(moves):
            continue
        start, end = (moves.get(node, node) for node in (old.start, old.end))
        lines[n] = Line(start, end, led(old.curve, points[start], points[end], 1.0)[0], old.origin)


def _place(other: Line, at_mm: float, snap_mm: float) -> float:
    """The place on the other line, at its end where that is near."""
    length = other.curve.length
    if other.is_ring:
        return at_mm
    if at_mm <= snap_mm and at_mm <= length - at_mm:
        return 0.0
    return length if length - at_mm <= snap_mm else at_mm


def _cut(
    sketch: Sketch, number: int, names: Mapping[float, int], points: Mapping[int, FloatArray]
) -> dict[int, Line]:
    """The parts of a line between places along it, by new numbers; `names` are nodes by place."""
    line = sketch.lines[number]
    free = max(sketch.lines) + 1
    parts: dict[int, Line] = {}
    for k, (a, b) in enumerate(itertools.pairwise(sorted(names))):
        cubics = piece(line.curve, a, b).points.copy()
        cubics[0, 0], cubics[-1, 3] = points[names[a]], points[names[b]]
        parts[free + k] = Line(names[a], names[b], BezierChain(cubics), line.origin)
    return parts
