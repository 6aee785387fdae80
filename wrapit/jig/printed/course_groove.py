"""Where wires run on the plate: a shallow groove under each, with an arrow head near its start."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from wrapit.geometry import FloatArray
from wrapit.geometry.outlines.polygons import CORNER_RAD
from wrapit.jig.channel import Channels
from wrapit.jig.contours import arrow_head
from wrapit.jig.model import Groove
from wrapit.jig.paired.between import second_runs
from wrapit.jig.printed.smoothed import ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM, bends_rad, smoothed

# A line that a nozzle of 0.4 mm leaves open, two layers of 0.2 mm deep, as numbers are. Wire lies over it and
# sinks in by a tenth of its diameter at most, as the groove is no wider than 0.6 of that; one that would be
# narrower than the nozzle's line is left out, which is so for wire under 0.67 mm.
WIDTH_MM, LEAST_WIDTH_MM, DEPTH_MM = 0.6, 0.4, 0.4
WIDTH_SHARE = 0.6
# Plate that stays between the groove and what else there is on it (walls: as much as the wire leaves, less
# RESERVE), and between two grooves: narrower webs don't print, so the grooves become one.
WEB_MM = 0.3
RESERVE_MM = 0.02
# Beside a wall the wall shows the way, up to this far beyond what a wire there takes up. Grooves there too
# cut the plate's inside into pieces that slicers fill solid: the butterfly prints in 62 instead of 64 min.
BESIDE_MM = 1.5
# A shorter piece of groove says nothing: twice as long as it is wide.
LEAST_MM2 = 0.72
# An arrow head is seen on both sides of the wire that lies on it: 2 mm long and wide for wire of 1 mm. It
# stands where the first MOST mm of the wire have room for all of it, else where most of it has room.
HEAD_MM = 2.0
FIRST_MM, MOST_MM, STEP_MM = 1.0, 12.0, 0.5
HALF_A_HEAD = 0.5
# Corners up to a right angle stay sharp; more pointed ones would reach into what is kept free.
BLUNT = 1.45
# Shorter sides between two corners are left out, as the nozzle rounds them away: the butterfly's grooves have
# 100 sides with them.
BEVEL_MM = 0.25


def groove_of(channels: Channels, walls: Any, kept_free: Any, most_depth_mm: float) -> Groove | None:
    """The grooves of these wires, clear of walls and all else `kept_free` (shapely); None for thin wire."""
    width = min(WIDTH_MM, WIDTH_SHARE * channels.diameter_mm)
    if width < LEAST_WIDTH_MM:
        return None
    web = min(WEB_MM, channels.face_mm - width / 2 - RESERVE_MM)
    free = shapely.union_all([walls.buffer(web), kept_free.buffer(WEB_MM)])
    heads = [_head(channels, index, free) for index in range(len(channels.wires))]
    beside = walls.buffer(channels.reach_mm + BESIDE_MM)
    lines = [line.difference(beside).buffer(width / 2, cap_style="flat") for line in _marked(channels)]
    marked = shapely.union_all([*lines, *(head for head in heads if head is not None)])
    whole = marked.buffer(WEB_MM / 2).buffer(-WEB_MM / 2, join_style="mitre", mitre_limit=BLUNT)
    whole = whole.difference(free)
    # What is narrower than most of the groove was cut by an opening or a wall, and is left out.
    thin = 0.4 * width
    whole = whole.buffer(-thin, join_style="mitre")
    whole = whole.buffer(thin, join_style="mitre", mitre_limit=BLUNT)
    parts = [_pointed(part) for part in shapely.get_parts(whole) if part.area > LEAST_MM2]
    parts = _apart(sorted(parts, key=lambda part: (-part.area, part.bounds)))
    if not parts:
        return None
    room = shapely.box(*whole.buffer(1.0).bounds).difference(shapely.union_all([walls, kept_free]))
    strokes = tuple(smoothed(part, room, ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM) for part in parts)
    return Groove(strokes, min(DEPTH_MM, most_depth_mm))


def _marked(channels: Channels) -> list[Any]:
    """The lines (shapely) that have a groove: of two runs side by side only the one that is laid first.

    Between two grooves there would be a web thinner than the nozzle's line; beside one the other lies flat.
    """
    return [
        line if second is None else line.difference(second.buffer(LEAST_WIDTH_MM, cap_style="flat"))
        for line, second in zip(
            channels.lines, (second_runs(channels, wire) for wire in channels.wires), strict=True
        )
    ]


def _apart(parts: list[shapely.Polygon]) -> list[shapely.Polygon]:
    """The parts without those that all but touch a larger one: their sides might cross."""
    kept: list[shapely.Polygon] = []
    for part in parts:
        if all(part.distance(other) > 4 * ENGRAVED_SLACK_MM for other in kept):
            kept.append(part)
    return kept


def _pointed(polygon: shapely.Polygon) -> shapely.Polygon:
    """The polygon with one corner in place of two that are nearer than BEVEL_MM."""
    rings = [_pointed_ring(np.asarray(ring.coords)[:-1]) for ring in (polygon.exterior, *polygon.interiors)]
    pointed = shapely.Polygon(rings[0], rings[1:])
    return pointed if pointed.is_valid else polygon


def _pointed_ring(points: FloatArray) -> FloatArray:
    """One ring (n, 2) of them, not closed."""
    along = np.roll(points, -1, axis=0) - points
    corner = bends_rad(points) > CORNER_RAD
    bevel = corner & np.roll(corner, -1) & (np.hypot(*along.T) < BEVEL_MM)
    bevel &= ~np.roll(bevel, 1)  # of two in a row the first
    middles = np.where(bevel[:, None], points + along / 2, points)
    return middles[~np.roll(bevel, 1)]


def _head(channels: Channels, index: int, blocked: Any) -> Any:
    """The triangle of a wire's arrow head, clear of what is blocked; None where there is no room for half."""
    line = channels.lines[index]
    best, most = None, HALF_A_HEAD * HEAD_MM**2 / 2
    for at in np.arange(FIRST_MM, min(MOST_MM, line.length - HEAD_MM), STEP_MM):
        back, tip = (line.interpolate(float(mm)).coords[0] for mm in (at, at + HEAD_MM))
        head = shapely.Polygon(arrow_head(back, tip, HEAD_MM))
        clear = head.difference(blocked)
        if clear.area > most + 1e-6:
            best, most = clear, clear.area
        if clear.area > head.area - 1e-6:
            break
    return best
