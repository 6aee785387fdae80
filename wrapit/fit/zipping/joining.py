"""A stretch of a line goes; what it joined is led to the line beside it."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.drawing.reflection import Axis
from wrapit.fit.merging.leading import led
from wrapit.fit.merging.planarity import is_planar
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Line, Sketch
from wrapit.fit.zipping.stretches import PARTING, Stretch, near_places, runs
from wrapit.geometry import BezierChain, FloatArray, straight
from wrapit.geometry.arclength import piece

# An end so many rooms away from the stretch comes along.
_SNAP: Final = 2.0


def as_one(sketch: Sketch, stretch: Stretch, limits: Limits, axis: Axis | None) -> Sketch | None:
    """The sketch without a stretch, what it joined led to the line beside; None where lines would cross.

    With an axis the line beside is its mirror image, and both become one on the axis.
    """
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
    if axis is not None:
        result = _onto(axis, result, {names[places[0]], names[places[1]]}, limits)
    new = {n: line for n, line in result.lines.items() if line is not sketch.lines.get(n)}
    return result if is_planar(result, new, sketch) else None


def _onto(axis: Axis, sketch: Sketch, nodes: set[int], limits: Limits) -> Sketch:
    """The sketch with nodes on a mirror axis, straight lines between them, and all other lines led there."""
    points = {**sketch.nodes, **{node: axis.nearest(sketch.nodes[node]) for node in nodes}}
    lines = {}
    for n in sorted({arm[0] for node in nodes for arm in sketch.arms[node]}):
        old = sketch.lines[n]
        start, end = points[old.start], points[old.end]
        between = {old.start, old.end} == nodes
        curve = straight(start, end) if between else led(old.curve, start, end, limits.diameter_mm)[0]
        lines[n] = Line(old.start, old.end, curve, old.origin)
    return sketch.changed(lines=lines, nodes={node: points[node] for node in nodes})


def folded(sketch: Sketch, limits: Limits) -> Sketch:
    """Lines that come near themselves get a node half way of each bight: two that run along one another."""
    way_mm = 2 * PARTING * limits.room_mm
    near = near_places(sketch, limits.room_mm)
    near = near.where((near.one == near.other) & (np.abs(near.at - near.other_at) > way_mm))
    for number in np.unique(near.one).tolist():
        own = near.where(near.one == number)
        if sketch.lines[number].is_ring:
            own = own.where(sketch.lines[number].curve.length - np.abs(own.at - own.other_at) >= way_mm)
        places = (own.at + own.other_at) / 2
        line, free = sketch.lines[number], max(sketch.nodes) + 1
        names = {0.0: line.start, line.curve.length: line.end}
        nodes: dict[int, FloatArray] = {}
        for low, high in runs(places, limits.room_mm) if len(places) else ():
            at_mm = float(np.median(places[(low <= places) & (places <= high)]))
            names[at_mm] = free + len(nodes)
            nodes[names[at_mm]] = piece(line.curve, 0.0, at_mm).end
        sketch = sketch.changed((number,), _cut(sketch, number, names, {**sketch.nodes, **nodes}), nodes)
    return sketch


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
