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
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.arclength import piece
from wrapit.geometry.polyline import lengths

# How finely lines are compared (mm).
_STEP_MM: Final = 0.25
# They are too near at this share of the room that they need: what is made to have room isn't made again.
_NEARER: Final = 0.98
# Lines that leave one node at a small angle are near one another at first: for so many rooms along them they
# may be (three are 19 degrees).
_PARTING: Final = 3.0
# They run along one another where they are near for so many rooms; less is a meeting.
_ALONG: Final = 2.0
# An end so many rooms away from the stretch comes along.
_SNAP: Final = 2.0
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
    passed: set[tuple[frozenset[int], frozenset[int]]] = set()
    for _ in range(_MOST):
        found = _stretches(sketch, limits, density, keep)
        stretch = next((s for s in found if _names(sketch, s) not in passed), None)
        if stretch is None:
            break
        passed.add(_names(sketch, stretch))
        sketch = _as_one(sketch, stretch, limits) or sketch
    return sketch


def _folded(sketch: Sketch, limits: Limits) -> Sketch:
    """Lines that come near themselves get a node half way: they are two that run along one another."""
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
        line, at_mm, node = sketch.lines[number], float(np.median(places)), max(sketch.nodes) + 1
        points = {**sketch.nodes, node: piece(line.curve, 0.0, at_mm).end}
        names = {0.0: line.start, at_mm: node, line.curve.length: line.end}
        sketch = sketch.changed((number,), _cut(sketch, number, names, points), {node: points[node]})
    return sketch


def _near_places(sketch: Sketch, room_mm: float) -> Iterator[tuple[int, float, int, float, float]]:
    """Places on lines that are nearer than they have room: line and mm along it, twice, and how far apart."""
    from scipy.spatial import cKDTree

    numbers = sorted(sketch.lines)
    points = [sketch.lines[n].curve.sampled(_STEP_MM) for n in numbers]
    every = np.concatenate(points)
    owner = np.repeat(numbers, [len(each) for each in points])
    at = np.concatenate([lengths(each) for each in points])
    pairs = cKDTree(every).query_pairs(_NEARER * room_mm, output_type="ndarray")
    far = np.abs(at[pairs[:, 0]] - at[pairs[:, 1]]) > _PARTING * room_mm
    pairs = pairs[far | (owner[pairs[:, 0]] != owner[pairs[:, 1]])]
    apart = np.hypot(*(every[pairs[:, 0]] - every[pairs[:, 1]]).T)
    for (i, j), gap in zip(pairs.tolist(), apart.tolist(), strict=True):
        yield int(owner[i]), float(at[i]), int(owner[j]), float(at[j]), gap


def _names(sketch: Sketch, stretch: Stretch) -> tuple[frozenset[int], frozenset[int]]:
    return sketch.lines[stretch.line].origin, sketch.lines[stretch.other].origin


def _stretches(
    sketch: Sketch, limits: Limits, density: Mapping[frozenset[int], float], keep: frozenset[int]
) -> list[Stretch]:
    """Where lines run along others, the longest stretch first; the line is the lesser of the two."""
    room_mm = limits.room_mm
    near: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
    for one, at, other, other_at, gap in _near_places(sketch, room_mm):
        if one != other and not _part_there(sketch, one, at, other, other_at, _PARTING * room_mm):
            near.setdefault((one, other), []).append((at, other_at, gap))
    found = []
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
        low, high = _run(own, room_mm)
        ends = [table[np.flatnonzero(own == each)] for each in (low, high)]
        beside = [float(each[np.argmin(each[:, 2]), 1 - lesser]) for each in ends]
        if high - low >= _ALONG * room_mm and abs(beside[1] - beside[0]) >= room_mm:
            pair = (one, other)
            found.append(Stretch(pair[lesser], pair[1 - lesser], (low, high), (beside[0], beside[1])))
    return sorted(found, key=lambda s: (-round(s.span_mm[1] - s.span_mm[0], 6), s.line, s.other))


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


def _run(places_mm: FloatArray, gap_mm: float) -> tuple[float, float]:
    """The longest run of places without a gap."""
    ordered = np.unique(places_mm)
    breaks = np.flatnonzero(np.diff(ordered) > gap_mm)
    starts, ends = np.r_[0, breaks + 1], np.r_[breaks, len(ordered) - 1]
    best = int(np.argmax(ordered[ends] - ordered[starts]))
    return float(ordered[starts[best]]), float(ordered[ends[best]])


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
