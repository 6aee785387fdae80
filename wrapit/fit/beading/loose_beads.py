"""Beads that no wire runs through: dots of the drawing, rings that touch nothing; sewn to a wire nearby."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from wrapit.drawing.model import Dot, Removal
from wrapit.errors import Finding
from wrapit.fit.beading.beads import ALIKE_MM, SMALLEST_MM, STEP_OF_SIZES_MM, alike, size_of
from wrapit.fit.model import Bead, Limits
from wrapit.fit.sketch import STEP_MM, Sketch

# Between bead and wire at most, so that binding wire holds the one to the other and doesn't bridge a gap.
REACH_MM = 1.0
# Between bead and wire at least: the jig's seat is wider than the bead by its clearance, 0.2 mm as a rule.
_BESIDE_MM = 0.25
# A bead that is a millimetre smaller than it was drawn still is where it was drawn; a smaller one is another.
_SMALLER_MM = 1.0


_REMEDY = "draw it larger and up to half a millimetre beside a line, or as a ring on the line"


def loose_beads(
    dots: Iterable[Dot], sketch: Sketch, beads: Sequence[Bead], limits: Limits
) -> tuple[tuple[Bead, ...], tuple[Removal, ...], tuple[Finding, ...]]:
    """Beads for dots that have a bead's size and a line near enough, what is told of them, and of the others.

    A dot with too little room for its bead gets a smaller one; dots alike get beads alike. They keep clear of
    the `beads` that there are.
    """
    found: list[Bead] = []
    told, said = [], []
    for dot, size_mm, room_mm in _measured(dots, sketch, limits):
        problem = _taken(dot, size_mm, [*beads, *found])
        if problem is None:
            problem = _problem(size_mm, room_mm)
        if problem is None:
            bead = Bead(np.array(dot.at), min(size_mm, _fitting(room_mm)))
            found.append(bead)
            drawn = f"becomes a bead of {bead.diameter_mm:g} mm; drawn {dot.diameter_mm:.2f} mm"
            told.append(Removal("bead", dot.at, np.pi * dot.diameter_mm, drawn))
        elif problem:
            place = f"at ({dot.at[0]:.1f}, {dot.at[1]:.1f}) mm"
            message = f"this dot or ring becomes no bead: {problem}"
            said.append(Finding("note", "no-bead", place, message, _REMEDY))
    return tuple(found), tuple(told), tuple(said)


def _measured(dots: Iterable[Dot], sketch: Sketch, limits: Limits) -> list[tuple[Dot, float, float]]:
    """Dots of a bead's size, the largest first, each with that size and the diameter that has room there."""
    import shapely

    lines = shapely.union_all(
        [shapely.LineString(line.curve.sampled(STEP_MM)) for line in sketch.lines.values()]
    )
    each = sorted(dots, key=lambda dot: (-dot.diameter_mm, dot.at))
    rooms = [
        2 * (float(lines.distance(shapely.Point(dot.at))) - limits.diameter_mm / 2 - _BESIDE_MM)
        for dot in each
    ]
    pairs = [(dot.diameter_mm, room) for dot, room in zip(each, rooms, strict=True)]
    measured = []
    for group in alike(pairs, (ALIKE_MM, 2 * ALIKE_MM)):
        size_mm = size_of(float(np.mean([each[index].diameter_mm for index in group])))
        if size_mm is not None:
            room_mm = min(rooms[index] for index in group)
            measured += [(each[index], size_mm, room_mm) for index in group]
    return measured


def _fitting(room_mm: float) -> float:
    return STEP_OF_SIZES_MM * math.floor(room_mm / STEP_OF_SIZES_MM + 1e-6)


def _problem(size_mm: float, room_mm: float) -> str | None:
    """Why there is no bead of a size, or a little less, between the lines; None where there is."""
    fitting_mm = _fitting(room_mm)
    if fitting_mm < max(SMALLEST_MM, size_mm - _SMALLER_MM):
        return f"between the lines there is room for {max(room_mm, 0.0):.1f} mm"
    if room_mm - min(size_mm, fitting_mm) > 2 * (REACH_MM - _BESIDE_MM):
        return f"there is no wire within {REACH_MM:g} mm of it that it could be sewn to"
    return None


def _taken(dot: Dot, size_mm: float, others: Sequence[Bead]) -> str | None:
    """Whether other beads leave no place: a reason, but none to tell where it is a pupil in its iris."""
    for other in others:
        apart_mm = math.dist(other.at, dot.at)
        if apart_mm < (other.diameter_mm + size_mm) / 2 + 2 * _BESIDE_MM:
            return "" if apart_mm < other.diameter_mm / 2 else "another bead is in its place"
    return None
