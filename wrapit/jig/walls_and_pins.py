"""Where walls and pins stand for wires that share a jig: what every kind with walls plans first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.jig.channel import Channels
from wrapit.jig.model import Hole, Pin
from wrapit.jig.openings.holes import hole_obstacles, hole_rims, start_holes
from wrapit.jig.openings.pins import pin_holes, pin_obstacles
from wrapit.jig.wall_ground import wall_polygons
from wrapit.wires.model import Turn


@dataclass(frozen=True, eq=False)
class WallPlan:
    """Polygons of walls with the turns that they hold, pins, start holes; shapely geometry for the rest.

    `rims` are the holes' outlines, `blocked` is where no wall may stand.
    """

    polygons: tuple[tuple[Any, tuple[Turn, ...]], ...]
    pins: tuple[Pin, ...]
    holes: tuple[Hole, ...]
    rims: Any
    blocked: Any
    findings: tuple[Finding, ...]


def plan_walls(channels: Channels, config: JigConfig, pockets: Any) -> WallPlan:
    """The walls and pins of these wires; `pockets` (shapely) are kept free for something else."""
    import shapely

    holes = start_holes(channels, config)
    rims = hole_rims(holes)
    blocked = hole_obstacles(holes).union(pockets)
    polygons, dropped = wall_polygons(channels, config, blocked)
    pins = pin_holes(
        channels, config, rims.union(pockets), shapely.union_all([polygon for polygon, _ in polygons])
    )
    if pins:
        blocked = shapely.union_all([blocked, pin_obstacles(pins)])
        polygons, dropped = wall_polygons(channels, config, blocked)
    return WallPlan(tuple(polygons), tuple(pins), tuple(holes), rims, blocked, dropped)
