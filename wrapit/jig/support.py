"""What a jig really does for its wires, measured on its exact faces."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import UnheldError
from wrapit.geometry import Arc, Edge, FloatArray, Line, Region
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.channel import Channels
from wrapit.jig.model import SEEN_MM, Course, Pin, TurnSupport
from wrapit.jig.wall_ground import FACE_STEP_MM, TOUCH_MM, face_probes, inside
from wrapit.wires.model import Turn

# How deep behind the place of its face a wall must be met to count: ten times what exact faces may stray
# (1e-3 mm), so that only a wall at the right distance does. 30 % up or down moves support by 0.003 or less.
PROBE_DEPTH_MM = 0.01
# Between points of walls whose distance to the wires is measured: between two of them, a face of a turn of
# 0.5 mm radius comes 0.03²/(8 · 0.5) = 2e-4 mm nearer, less than CLEARANCE_TOLERANCE_MM.
DISTANCE_STEP_MM = 0.03
# How far a short wire may stray, as a share of its length: from 25 mm on half a millimetre counts.
KEPT = 0.02


def turn_support(channels: Channels, walls: Sequence[Region]) -> tuple[TurnSupport, ...]:
    """For each turn or long stretch the share of its length that has wall at the right distance inside."""
    return _support(channels, [polygon_of(wall, 1e-3) for wall in walls], PROBE_DEPTH_MM)


def rough_support(channels: Channels, walls: Sequence[Any]) -> tuple[TurnSupport, ...]:
    """The same from the walls' polygons, before they have exact faces."""
    return _support(channels, walls, TOUCH_MM)


def _support(channels: Channels, walls: Sequence[Any], depth_mm: float) -> tuple[TurnSupport, ...]:
    import shapely

    tree = shapely.STRtree(list(walls))
    shares = []
    for turn in channels.turns:
        probes = shapely.points(face_probes(channels, turn, FACE_STEP_MM, depth_mm))
        hit = np.zeros(len(probes))
        hit[inside(tree, probes)[0]] = 1.0
        ends = np.ones(len(hit))
        ends[[0, -1]] = 0.5
        shares.append(TurnSupport(turn, float((hit * ends).sum() / ends.sum())))
    return tuple(shares)


def total_support(support: Iterable[TurnSupport]) -> float:
    """The supported share of the length of all these turns; 1 where there is none.

    Long stretches are no turns: the hand doesn't bend the wire there. They are left out here, and
    `stretch_support` gives theirs. They are many times longer than the turns and would hide a bad one.
    """
    return held_share(one for one in support if not one.turn.stretch)


def stretch_support(support: Iterable[TurnSupport]) -> float:
    """The share of the length of all long stretches that has a wall; 1 where there is none."""
    return held_share(one for one in support if one.turn.stretch)


def really_held(
    support: Iterable[TurnSupport], pins: Iterable[Pin], laid: Iterable[Course]
) -> tuple[TurnSupport, ...]:
    """The support of each turn; what a pin holds is held, and where a taut wire keeps to the drawing.

    The rest of each wire counts as well, as stretches: two rings of one wire, round which walls stand
    wherever it needs them, are held though no wall fits into the one corner between them.
    """
    courses = {course.wire: course for course in laid}
    held = tuple(
        replace(one, share=max(one.share, kept(one.turn, courses))) for one in with_pins(support, pins)
    )
    rest = (
        each
        for wire, course in courses.items()
        for each in _between([one.turn for one in held if one.turn.wire == wire], course)
    )
    return (*held, *(TurnSupport(each, kept(each, courses)) for each in rest))


def _between(turns: Iterable[Turn], course: Course) -> Iterator[Turn]:
    """What is left of a wire between its turns, as stretches."""
    reached_mm = 0.0
    for turn in sorted(turns, key=lambda turn: turn.start_mm):
        if turn.start_mm > reached_mm:
            yield Turn(course.wire, reached_mm, turn.start_mm, turn.inside, 0.0, stretch=True)
        reached_mm = max(reached_mm, turn.end_mm)
    if course.at_mm[-1] > reached_mm:
        yield Turn(course.wire, reached_mm, float(course.at_mm[-1]), "left", 0.0, stretch=True)


def with_pins(support: Iterable[TurnSupport], pins: Iterable[Pin]) -> tuple[TurnSupport, ...]:
    """The support of each turn, where a pin in it holds it whole."""
    pinned = {pin.turn for pin in pins}
    return tuple(replace(one, share=1.0) if one.turn in pinned else one for one in support)


def kept(turn: Turn, course_of: Mapping[str, Course]) -> float:
    """The share of a turn along which its wire, laid under tension, keeps to the drawing.

    That is within SEEN_MM, and KEPT of a short wire's length: a tiny zigzag pulled straight lost its shape.
    """
    course = course_of[turn.wire]
    along = (course.at_mm >= turn.start_mm) & (course.at_mm <= turn.end_mm)
    near_mm = min(SEEN_MM, KEPT * float(course.at_mm[-1]))
    return float((course.off_mm[along] <= near_mm).mean()) if along.any() else 1.0


def refuse_unheld(support: Iterable[TurnSupport], config: JigConfig) -> None:
    """Raises UnheldError when too little of the wires is held (`jig.least_support`), by length.

    A large flower with three cusps that no wall fits into is held well.
    """
    held = held_share(support)
    if held < config.least_support:
        raise UnheldError(
            f"walls would hold {math.floor(100 * held)}% of the wires, "
            f"less than jig.least_support ({config.least_support:.0%})"
        )


def support_by_wire(support: Iterable[TurnSupport]) -> dict[str, float]:
    """The supported share of each wire's turns, long stretches left out; 1 for a wire that has no others."""
    grouped: dict[str, list[TurnSupport]] = {}
    for one in support:
        grouped.setdefault(one.turn.wire, []).append(one)
    return {wire: total_support(of_wire) for wire, of_wire in grouped.items()}


def held_share(support: Iterable[TurnSupport]) -> float:
    """The supported share of the length of all these turns and long stretches; 1 where there is none."""
    lengths = [(s.turn.end_mm - s.turn.start_mm, s.share) for s in support]
    total = sum(length for length, _ in lengths)
    return sum(length * share for length, share in lengths) / total if total > 0 else 1.0


def min_wall_to_wire_mm(channels: Channels, walls: Sequence[Region]) -> tuple[float | None, FloatArray]:
    """The smallest gap between any wall and any wire's surface, and the point of the wall where it is."""
    if not walls:
        return None, np.full(2, np.nan)
    loops = [loop for wall in walls for loop in (wall.outer, *wall.holes)]
    points = np.concatenate([edge_points(edge, DISTANCE_STEP_MM) for loop in loops for edge in loop.edges])
    near = channels.outliner.curves.nearest(points, channels.reach_mm + 1.0)
    closest = int(near.distance.argmin())
    return float(near.distance[closest]) - channels.diameter_mm / 2, points[closest]


def edge_points(edge: Edge, step_mm: float) -> FloatArray:
    """Points exactly on an edge, at most about a step apart, both ends included."""
    if isinstance(edge, Line):
        ends = np.array([edge.start, edge.end])
        count = max(1, int(np.ceil(np.linalg.norm(ends[1] - ends[0]) / step_mm)))
        return ends[0] + np.linspace(0, 1, count + 1)[:, None] * (ends[1] - ends[0])
    if isinstance(edge, Arc):
        count = max(2, int(np.ceil(abs(edge.sweep_rad) * edge.radius_mm / step_mm)))
        angles = edge.start_rad + edge.sweep_rad * np.linspace(0, 1, count + 1)
        return np.array(edge.centre) + edge.radius_mm * np.column_stack([np.cos(angles), np.sin(angles)])
    return edge.sampled(step_mm)
