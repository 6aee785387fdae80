"""The ground that walls leave to wires: a little where they hold one, the clearance elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths
from wrapit.jig.channel import SIDES, Channels
from wrapit.wires.model import Turn

# Between points along a held side, in mm: from one to the next the side of a turn of 0.5 mm radius strays by
# 0.1²/(8 · 0.5) = 2.5e-3 mm, a fortieth of what a wire has on that side less than elsewhere.
STEP_MM = 0.1
# A held side reaches so far beyond the channel and, along the wire, beyond the wall's ends, in mm, that their
# sides are nowhere the same: polygons err by 1e-3.
OVER_MM = 0.01
BEYOND_MM = 0.3
# What of a channel is narrower than this beside a held side is no ground for a wire: strips leave slits
# (3e-18 mm²) and crumbs (0.1 by 3e-3 mm) between them round tight turns, which would be holes in a wall.
CRUMB_MM = OVER_MM
# How many spans are remembered from one round of planning to the next: those of the largest piece.
_REMEMBERED = 4000


def passage(channels: Channels, held: Sequence[Turn], config: JigConfig) -> Any:
    """What walls that hold these spans must leave free (shapely), CHANNEL_PAD_MM too wide."""
    import shapely

    if channels.face_mm == channels.reach_mm:
        return channels.area
    mine = [
        tuple((span, prolonged_mm(span, config)) for span in held if span.wire == wire.name)
        for wire in channels.wires
    ]
    return shapely.union_all([_of_wire(channels, i, spans) for i, spans in enumerate(mine)])


@lru_cache(_REMEMBERED)
def _of_wire(channels: Channels, index: int, held: tuple[tuple[Turn, float], ...]) -> Any:
    """What is left free for one wire, of which spans are held, each so much beyond its ends."""
    import shapely

    sides = {(span, beyond_mm): _held_side(channels, span, beyond_mm) for span, beyond_mm in held}
    whole = channels.around(index, channels.reach_mm).difference(shapely.union_all(list(sides.values())))
    parts = [_without_crumbs(whole) if sides else whole, channels.around(index, channels.face_mm)]
    for (span, beyond_mm), side in sides.items():
        rest = _rest(channels, index, span, beyond_mm)
        if rest is not None and rest.dwithin(side, channels.reach_mm):
            # Of a long wire only what is near: its ground is the same there.
            low_x, low_y, high_x, high_y = side.bounds
            far = 2 * channels.reach_mm
            near = shapely.clip_by_rect(rest, low_x - far, low_y - far, high_x + far, high_y + far)
            again = near.buffer(channels.reach_mm, quad_segs=32).intersection(side)
            parts.append(_without_crumbs(again))
    return shapely.union_all(parts)


def _without_crumbs(ground: Any) -> Any:
    """The ground (shapely) where it is wider than CRUMB_MM; corners stay sharp."""
    narrower = ground.buffer(-CRUMB_MM / 2, join_style="mitre")
    return narrower.buffer(CRUMB_MM / 2, join_style="mitre")


def prolonged_mm(span: Turn, config: JigConfig) -> float:
    """How far a wall goes on beyond the ends of a span: a turn's to where the wire is straight again."""
    return 0.0 if span.stretch or config.support == "taut" else config.min_wall_width


@lru_cache(_REMEMBERED)
def _held_side(channels: Channels, span: Turn, beyond_mm: float) -> Any:
    """The ground beside a span where the wall that holds it stands nearer than the clearance."""
    _, points, normals, _ = channels.stations(span, STEP_MM, beyond_mm + BEYOND_MM)
    return beside(points, normals, SIDES[span.inside], 0.0, channels.reach_mm + OVER_MM)


@lru_cache(_REMEMBERED)
def _rest(channels: Channels, index: int, span: Turn, beyond_mm: float) -> Any:
    """The rest of the wire, beyond what lies beside the span's own ends; None if that is nothing."""
    import shapely

    apart = beyond_mm + BEYOND_MM + 2 * channels.reach_mm
    parts = []
    line = channels.lines[index]
    for low, high in ((0.0, span.start_mm - apart), (span.end_mm + apart, line.length)):
        if high - low > STEP_MM:
            parts.append(_stretch(line, low, high))
    return shapely.union_all(parts) if parts else None


def _stretch(line: Any, low: float, high: float) -> Any:
    """A line (shapely) between two lengths along it; shapely's own goes from point to point."""
    import shapely

    points = shapely.get_coordinates(line)
    along = lengths(points)
    ends = shapely.get_coordinates(shapely.line_interpolate_point(line, [low, high]))
    between = points[(along > low) & (along < high)]
    return shapely.LineString(np.concatenate([ends[:1], between, ends[1:]]))


def beside(points: FloatArray, normals: FloatArray, side: float, near_mm: float, far_mm: float) -> Any:
    """The ground from `near_mm` to `far_mm` beside a line of points (m, 2): side 1 is left, -1 right."""
    import shapely

    near, far = points + side * near_mm * normals, points + side * far_mm * normals
    corners = np.stack([near[:-1], near[1:], far[1:], far[:-1]], axis=1)
    edges = np.roll(corners, -1, axis=1) - corners
    following = np.roll(edges, -1, axis=1)
    bends = edges[..., 0] * following[..., 1] - edges[..., 1] * following[..., 0]
    # Strips that all go round one way fold nowhere, and a rim that is simple shuts in each place once: then
    # the band is what the rim encloses.
    if (bends < 0).all() or (bends > 0).all():
        band = shapely.polygons(np.concatenate([near, far[::-1]]))
        if band.is_valid:
            return band
    return shapely.union_all(shapely.convex_hull(shapely.multipoints(corners)))
