"""What lies between two runs side by side: metal that neither passes, and what one takes from the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.channel import SIDES, Channels
from wrapit.jig.model import Course
from wrapit.jig.paired.leaning import doubles_in
from wrapit.jig.wrapping.passage import beside
from wrapit.wires.model import DoubleRun, Turn, Wire

# Places along a run, and how near to both centrelines the metal between them reaches: a seventh of what a
# wire may stray by, so that the drawn runs never touch it, also where they aren't quite a diameter apart.
STEP_MM = 0.1
EDGE_MM = 0.05


def metal_between(channels: Channels, index: int) -> Any:
    """Where the middle of wire `index` can't be, as another run lies close beside it (shapely).

    Nothing, None, where there is no other. Where the wire itself passes over a pair, that doesn't stop it.
    """
    import shapely

    wire, d = channels.wires[index], channels.diameter_mm
    strips = []
    for run in doubles_in(wire, channels.wires):
        _, points, normals, _ = channels.stations(_span(wire, run), STEP_MM)
        strip = beside(points, normals, SIDES[run.side], EDGE_MM, d - EDGE_MM)
        passing = channels.lines[index].intersection(strip)
        strips.append(strip if passing.is_empty else strip.difference(passing.buffer(d)))
    return shapely.union_all(strips) if strips else None


def second_runs(channels: Channels, wire: Wire) -> Any:
    """The lines (shapely) along which a wire is laid beside a run that lies there already; None without."""
    import shapely

    lines = [
        shapely.LineString(channels.stations(_span(wire, run), STEP_MM)[1])
        for run in doubles_in(wire, channels.wires)
        if not run.first
    ]
    return shapely.union_all(lines) if lines else None


def carried(channels: Channels, laid: Sequence[Course]) -> tuple[Course, ...]:
    """The courses, each as far off as the run that it leans on: that one's straying is its own as well."""
    course_of = {course.wire: course for course in laid}
    return tuple(_carried(channels, course, course_of) for course in laid)


def _carried(channels: Channels, course: Course, course_of: dict[str, Course]) -> Course:
    wire = channels.wires[channels.index[course.wire]]
    runs = doubles_in(wire, channels.wires)
    if not runs:
        return course
    off_mm = course.off_mm.copy()
    bend = wire.centreline.curvature(ArcLength(wire.centreline).parameter(course.at_mm))
    for run in runs:
        leans = _within(course, run) & (bend * SIDES[run.side] > 0)
        other = course_of[run.other]
        there = _of_pair(channels, course.wire, run, other)
        if leans.any() and there.any():
            nearest = _nearest(course.drawn[leans], other.drawn[there])
            off_mm[leans] = np.maximum(off_mm[leans], other.off_mm[there][nearest])
    return replace(course, off_mm=off_mm)


def _of_pair(channels: Channels, wire: str, run: DoubleRun, other: Course) -> NDArray[np.bool_]:
    """Which places (n,) of the other run's wire lie along the same lines as this run."""
    doubles = channels.wires[channels.index[other.wire]].doubles
    mine = [_within(other, each) for each in doubles if each.other == wire]
    along = np.any(mine, axis=0) if mine else np.zeros(len(other.at_mm), dtype=bool)
    return along & ~_within(other, run) if other.wire == wire else along


def _span(wire: Wire, run: DoubleRun) -> Turn:
    return Turn(wire.name, run.start_mm, run.end_mm, run.side, 0.0, stretch=True)


def _within(course: Course, run: DoubleRun) -> NDArray[np.bool_]:
    return (course.at_mm >= run.start_mm) & (course.at_mm <= run.end_mm)


def _nearest(points: FloatArray, others: FloatArray) -> Any:
    """Of these points (n, 2) the index (n,) of the nearest one of others (m, 2)."""
    from scipy.spatial import cKDTree

    return cKDTree(others).query(points)[1]
