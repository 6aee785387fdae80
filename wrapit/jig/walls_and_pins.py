"""Where walls and pins stand for wires that share a jig: what every kind with walls plans first."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.jig.channel import Channels
from wrapit.jig.model import Course, Hold, Hole, Pin, TurnSupport, Wall
from wrapit.jig.openings.bead_room import bead_obstacles
from wrapit.jig.openings.holes import hole_obstacles, hole_rims, start_holes
from wrapit.jig.openings.pins import pin_discs, pin_holes, pin_obstacles
from wrapit.jig.support import rough_support, support_by_wire, turn_support
from wrapit.jig.wall_face import Face, wall_face
from wrapit.jig.wrapping.needs import planned_walls
from wrapit.wires.model import Turn, Wire

# How many groups of wires are remembered with their walls, from one kind of jig to the next? A piece whose
# wires are parted tries the whole and each wire alone: 100 holds all of a piece of 99 wires. With 12, the 34
# groups of a piece of 200 segments were all planned again for sheet.
_REMEMBERED = 100


@dataclass(frozen=True, eq=False)
class WallPlan:
    """Polygons of walls with the spans that they hold, pins, start holes; shapely geometry for the rest.

    `rims` are the holes' outlines, `blocked` is where no wall may stand, `laid` how the wires lie when taut.
    """

    polygons: tuple[tuple[Any, tuple[Turn, ...]], ...]
    pins: tuple[Pin, ...]
    holes: tuple[Hole, ...]
    rims: Any
    blocked: Any
    laid: tuple[Course, ...]
    findings: tuple[Finding, ...]


def plan_walls(channels: Channels, config: JigConfig, pockets: Any) -> WallPlan:
    """The walls and pins of these wires; `pockets` (shapely) are kept free for something else.

    So is the room of the wires' beads.
    """
    import shapely

    pockets = pockets.union(bead_obstacles(channels.wires, config.clearance))
    holes = start_holes(channels, config)
    rims = hole_rims(holes)
    blocked = hole_obstacles(holes).union(pockets)
    walls = planned_walls(channels, config, blocked)
    standing = shapely.union_all([polygon for polygon, _ in walls.polygons])
    pins = pin_holes(channels, config, rims.union(pockets), standing)
    if pins:
        blocked = shapely.union_all([blocked, pin_obstacles(pins)])
        walls = planned_walls(channels, config, blocked, pin_discs(pins))
    return WallPlan(walls.polygons, tuple(pins), tuple(holes), rims, blocked, walls.laid, walls.findings)


@dataclass(frozen=True, eq=False)
class StandingWalls:
    """Walls with nothing but the wires to mind; their exact faces are made once they are asked for."""

    channels: Channels
    plan: WallPlan

    @cached_property
    def faces(self) -> tuple[Face, ...]:
        """The walls' exact faces."""
        return tuple(
            wall_face(self.channels, Wall(turns, polygon, 0.0)) for polygon, turns in self.plan.polygons
        )

    @cached_property
    def support(self) -> tuple[TurnSupport, ...]:
        """What the exact faces hold of each turn."""
        return turn_support(self.channels, [face.region for face in self.faces])

    @cached_property
    def how_well(self) -> dict[str, Hold]:
        """How well each wire is held, by the polygons."""
        shares = support_by_wire(rough_support(self.channels, [polygon for polygon, _ in self.plan.polygons]))
        return {
            course.wire: Hold(shares.get(course.wire, 1.0), course.share_off) for course in self.plan.laid
        }


@lru_cache(_REMEMBERED)
def standing_walls(wires: tuple[Wire, ...], config: JigConfig) -> StandingWalls:
    """The walls of these wires where no seats are in their way.

    Printed jigs are made of them, and sheet jigs share them out as these do: so they are remembered.
    """
    import shapely

    return walls_beside(wires, config, shapely.Polygon())


def walls_beside(wires: tuple[Wire, ...], config: JigConfig, pockets: Any) -> StandingWalls:
    """The walls of these wires; `pockets` (shapely) are kept free for something else.

    Raises ValueError without wires or for wires of different diameters.
    """
    channels = Channels.of(wires, config)
    return StandingWalls(channels, plan_walls(channels, config, pockets))
