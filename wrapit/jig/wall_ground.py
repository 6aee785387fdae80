"""Wall polygons: solid ground on the inside of each turn, less the channels of all wires.

Everything here is right to about 1e-3 mm; `wrapit.jig.wall_face` makes the outlines exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.polyline import steps
from wrapit.jig.channel import SIDES, Channels
from wrapit.jig.wrapping.passage import beside, passage, prolonged_mm
from wrapit.wires.model import Turn

# How finely ground is laid beside a turn: a station each STEP, or each FAN radians where the turn is tighter
# than that, but no finer than LEAST_STEP. STEP 30 % up or down moves the walls' area by 0.02 %.
STEP_MM = 0.3
FAN_RAD = math.radians(6)
LEAST_STEP_MM = 0.03
# What the ground loses of its samples. SMOOTHING fills notches between strips of neighbouring turns up to
# twice its width; it decides whether walls that nearly meet are one: at 0.65 mm the butterfly's 15 walls are
# 11, at 0.35 mm they have 0.6 % less area. SIMPLER only saves corners (30 % up or down changes nothing).
SMOOTHING_MM = 0.5
SIMPLER_MM = 5e-4
# With free ground round the wires: how thick a wall that is needed stays where that ground would take it, and
# how round its back is.
CORE_MM = 1.2
BACK_MM = 1.0
# How many spans are remembered with their ground, from one round of planning to the next.
_REMEMBERED = 4000
# Where one looks for the wall beside a turn: TOUCH behind the place of its face, deeper than polygons err
# (1e-3 mm), far less than any wall is wide. Each FACE_STEP where support is measured or holes are placed
# (30 % up or down moves support by 0.001), each ROUGH_STEP where a wall is only told from none, or a loss is
# estimated (30 % up or down changes neither walls nor groups of leaf and butterfly).
TOUCH_MM = 0.02
FACE_STEP_MM = 0.1
ROUGH_STEP_MM = 0.2


def wall_polygons(
    channels: Channels, config: JigConfig, obstacles: Any, held: Sequence[Turn], free: Any = None
) -> tuple[list[tuple[Any, tuple[Turn, ...]]], tuple[Finding, ...]]:
    """Each wall's polygon with the spans that it holds, from lower left to upper right; what was dropped.

    Walls stand on the inside of the spans `held`. `free` (shapely) is ground that only their cores may take.
    Walls thinner than `min_wall_width` or smaller than `min_wall_area` are left out, and so are
    those that touch the inside of no span.
    """
    if not held:
        return [], ()
    ground = _ground(channels, held, config, config.wall_thickness)
    if free is not None:
        core = _ground(channels, held, config, max(CORE_MM, config.min_wall_width))
        ground = rounded(ground.difference(free).union(core)).union(core)
    # Notches between neighbouring strips are filled, convex corners stay as they are.
    with np.errstate(divide="ignore", invalid="ignore"):  # GEOS finds mitres of edges that turn back by it
        ground = ground.buffer(SMOOTHING_MM, join_style="mitre", mitre_limit=2.0).buffer(-SMOOTHING_MM)
    ground = ground.simplify(SIMPLER_MM)
    standing = ground.difference(passage(channels, held, config)).difference(obstacles)
    pieces = sorted(
        _polygons(printable(standing, config.min_wall_width)),
        key=lambda part: tuple(np.round(part.bounds, 6)),
    )
    touched = _held(channels, held, pieces)
    walls = [(piece, mine) for piece, mine in zip(pieces, touched, strict=True) if mine]
    kept = [wall for wall in walls if wall[0].area >= config.min_wall_area]
    small = [piece for piece, _ in walls if piece.area < config.min_wall_area]
    return kept, (_dropped(small, config),) if small else ()


def _ground(channels: Channels, held: Sequence[Turn], config: JigConfig, thickness_mm: float) -> Any:
    import shapely

    return shapely.union_all(
        [wall_ground(channels, span, prolonged_mm(span, config), thickness_mm) for span in held]
    )


def rounded(ground: Any) -> Any:
    """The ground without hollows and corners at its back that are narrower than a fingertip is round."""
    return ground.buffer(BACK_MM).buffer(-2 * BACK_MM).buffer(BACK_MM)


@lru_cache(_REMEMBERED)
def wall_ground(channels: Channels, turn: Turn, beyond_mm: float, thickness_mm: float) -> Any:
    """The ground within wall thickness of a turn on its inside: all points c + x n, 0 ≤ x ≤ depth.

    It goes on for `beyond_mm` past both ends of the turn.
    Where the turn is tighter than the depth, the rays cross at its centre and fill it: a solid post.
    """
    depth = channels.reach_mm + thickness_mm
    _, points, normals, curvature = channels.stations(turn, STEP_MM, beyond_mm)
    fan_rad = float((np.abs(curvature[:-1]) * steps(points)).max())
    if fan_rad > FAN_RAD:
        finer_mm = max(STEP_MM * FAN_RAD / fan_rad, LEAST_STEP_MM)
        _, points, normals, _ = channels.stations(turn, finer_mm, beyond_mm)
    return beside(points, normals, SIDES[turn.inside], 0.0, depth)


def _dropped(small: Sequence[Any], config: JigConfig) -> Finding:
    largest = max(small, key=lambda piece: piece.area)
    x, y = largest.representative_point().coords[0]
    return Finding(
        "note",
        "small-wall",
        f"({x:.1f}, {y:.1f}) mm",
        f"{len(small)} walls smaller than {config.min_wall_area:g} mm² are left out,"
        f" the largest of {largest.area:.1f} mm²",
        "make the piece larger, or lower jig.min_wall_area",
    )


def printable(free: Any, width_mm: float) -> Any:
    """What remains where a disc of the smallest width fits; corners up to a right angle stay sharp."""
    half = width_mm / 2
    core = free.buffer(-half, quad_segs=16)
    return core.buffer(half * math.sqrt(2) + 0.005, quad_segs=16).intersection(free)


def _held(channels: Channels, turns: Sequence[Turn], pieces: Sequence[Any]) -> list[tuple[Turn, ...]]:
    """For each piece the turns whose inside it touches."""
    import shapely

    held: list[list[Turn]] = [[] for _ in pieces]
    tree = shapely.STRtree(pieces)
    for turn in turns:
        probes = shapely.points(face_probes(channels, turn, ROUGH_STEP_MM, TOUCH_MM))
        for piece in sorted(set(inside(tree, probes)[1].tolist())):
            held[piece].append(turn)
    return [tuple(turns) for turns in held]


def face_probes(channels: Channels, turn: Turn, step_mm: float, depth_mm: float) -> FloatArray:
    """Points (m, 2) just inside where the wall's face along a turn should be."""
    _, points, normals, _ = channels.stations(turn, step_mm)
    away = channels.face_mm + depth_mm
    return np.asarray(points + SIDES[turn.inside] * away * normals)


def inside(tree: Any, probes: Any) -> tuple[IntArray, IntArray]:
    """Which probe is inside which polygon of shapely's tree: pairs of indices, (k,) each.

    The tree's own query would go round the whole polygon for each probe; a prepared polygon is searched.
    """
    import shapely

    shapely.prepare(tree.geometries)
    probe, polygon = tree.query(probes)
    held = shapely.contains(tree.geometries[polygon], probes[probe])
    return probe[held], polygon[held]


def _polygons(shape: Any) -> list[Any]:
    import shapely

    return [part for part in shapely.get_parts(shape) if part.geom_type == "Polygon"]
