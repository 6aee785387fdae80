"""Start holes: where the wires' ends go through the plate."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import FloatArray, Line, Loop
from wrapit.geometry.outlines.exact import Outliner
from wrapit.geometry.outlines.loops import circle
from wrapit.jig.channel import CHANNEL_PAD_MM, CHANNEL_SLACK_MM, Channels
from wrapit.jig.model import Hole
from wrapit.jig.openings.room import FOOT_MM
from wrapit.jig.openings.tails import tail_slots

# Wider than the wire, so that a bent tail slips through.
HOLE_OVER_WIRE_MM = 0.5
# Holes with less plate between them become one: two lines of a nozzle of 0.4 mm, as `jig.min_wall_width`.
# 30 % up or down changes no hole of leaf and butterfly.
JOINED_MM = 0.8


def start_holes(channels: Channels, config: JigConfig) -> tuple[Hole, ...]:
    """A hole for each end of each wire, with a slot along the tail; ends that meet share one hole."""
    import shapely

    diameter = max(config.min_hole, channels.diameter_mm + HOLE_OVER_WIRE_MM)
    slots = tail_slots(channels, diameter, config)
    near = shapely.buffer([shapely.LineString(slot.line) for slot in slots], (diameter + JOINED_MM) / 2)
    clusters = shapely.get_parts(shapely.union_all(near))
    clusters = sorted(clusters, key=lambda part: tuple(np.round(part.bounds, 6)))
    holes = []
    for cluster in clusters:
        mine = [slot for slot in slots if cluster.contains(shapely.Point(slot.line[0]))]
        names = tuple(dict.fromkeys(slot.wire for slot in mine))
        outline = _outline([slot.line for slot in mine], diameter)
        first = mine[0].line[0]
        holes.append(Hole((float(first[0]), float(first[1])), diameter, names, outline))
    return tuple(holes)


def hole_rims(holes: tuple[Hole, ...]) -> Any:
    """The holes as shapely geometry."""
    import shapely

    return shapely.union_all([shapely.Polygon(hole.outline.sampled(0.002)) for hole in holes])


def hole_obstacles(holes: tuple[Hole, ...]) -> Any:
    """Where no wall may stand because of the holes."""
    return hole_rims(holes).buffer(FOOT_MM, quad_segs=16)


def _outline(tails: list[FloatArray], diameter: float) -> Loop:
    """The exact outline of holes and slots that overlap; holes that only nearly meet are joined."""
    import shapely

    starts = [ends[0] for ends in tails]
    lines = [ends for ends in tails if np.linalg.norm(ends[1] - ends[0]) > 1e-3]
    lines += [np.array([a, b]) for a, b in _spanning(starts) if np.linalg.norm(b - a) > 1e-3]
    if not lines:
        x, y = (float(value) for value in starts[0])
        return circle((x, y), diameter / 2)
    edges = [Line(_xy(a), _xy(b)) for a, b in lines]
    grown = shapely.buffer(
        [shapely.LineString(line) for line in lines], diameter / 2 + CHANNEL_PAD_MM, quad_segs=32
    )
    whole = shapely.union_all(grown)
    ring = shapely.Polygon(whole.exterior).exterior
    return Outliner.of(edges, (diameter / 2,), CHANNEL_SLACK_MM).loop(
        shapely.Polygon(ring).normalize().exterior
    )


def _spanning(points: list[FloatArray]) -> list[tuple[FloatArray, FloatArray]]:
    """Each point after the first with the nearest one before it."""
    pairs = []
    for index, point in enumerate(points[1:], start=1):
        near = min(range(index), key=lambda i: float(np.linalg.norm(points[i] - point)))
        pairs.append((points[near], point))
    return pairs


def _xy(point: FloatArray) -> tuple[float, float]:
    return float(point[0]), float(point[1])
