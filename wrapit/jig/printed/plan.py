"""The plan of a jig: which walls, holes and plate these wires need, in the plane and without a kernel."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry import Region
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.channel import Channels
from wrapit.jig.model import Groove, JigPlan, Label, Plate, Wall
from wrapit.jig.openings.pins import pin_discs
from wrapit.jig.printed.course_groove import groove_of
from wrapit.jig.printed.labels import wire_labels
from wrapit.jig.printed.plate import SAMPLED_MM, plate_outline, polygon_within
from wrapit.jig.printed.seats import bead_seats, check_holes, seat_obstacles, seats_of
from wrapit.jig.wall_height import wall_heights
from wrapit.jig.walls_and_pins import StandingWalls, WallPlan, standing_walls, walls_beside
from wrapit.wires.model import Wire

# Plate between a number's frame (which has its own gap) and walls, holes and screws.
LABEL_GAP_MM = 0.3
# How many groups of wires are remembered with their walls: a jig asks twice for its own.
_REMEMBERED = 4


@lru_cache(_REMEMBERED)
def walls_of(wires: tuple[Wire, ...], config: JigConfig) -> StandingWalls:
    """The walls of these wires beside the seats.

    Raises ValueError without wires or for wires of different diameters.
    """
    if not config.seats:
        return standing_walls(wires, config)
    return walls_beside(wires, config, seat_obstacles(seats_of(config, wires[0].diameter_mm)))


def plan_jig(
    wires: tuple[Wire, ...], config: JigConfig, name: str = "jig"
) -> tuple[JigPlan, tuple[Finding, ...]]:
    """The plan of one jig that holds all these wires.

    Raises JigError where the plate doesn't fit the bed or a seat is in a start hole's way, ValueError
    without wires or for wires of different diameters.
    """
    import shapely

    standing = walls_of(wires, config)
    channels, planned = standing.channels, standing.plan
    seats = seats_of(config, channels.diameter_mm)
    holes, pins, rims, blocked = planned.holes, planned.pins, planned.rims, planned.blocked
    check_holes(seats, rims)
    beads, unseated = bead_seats(wires, config, rims.union(seat_obstacles(seats, 0.0)))
    seats = (*seats, *beads)
    pockets = seat_obstacles(seats)
    heights = wall_heights(channels, [polygon for polygon, _ in planned.polygons], config)
    walls = tuple(
        Wall(turns, polygon, height)
        for (polygon, turns), height in zip(planned.polygons, heights, strict=True)
    )
    covered = shapely.union_all([channels.area, rims, pockets, *(wall.outline for wall in walls)])
    outline, screws = plate_outline(covered, config, name)
    plate = Plate(Region(outline), config.base_thickness)
    labels: tuple[Label, ...] = ()
    unlabelled: tuple[Finding, ...] = ()
    if config.numbers:
        taken = shapely.union_all([blocked, rims, *(wall.outline for wall in walls)]).buffer(LABEL_GAP_MM)
        screwed = [polygon_within(screw).buffer(LABEL_GAP_MM) for screw in screws]
        labels, unlabelled = wire_labels(
            channels, shapely.union_all([taken, *screwed]), polygon_within(outline), config.base_thickness / 2
        )
    names = tuple(wire.name for wire in wires)
    groove = _groove(channels, planned, pockets, labels, config) if config.course else None
    plan = JigPlan(name, names, walls, holes, plate, pins, labels, screws, seats, planned.laid, groove)
    return plan, (*planned.findings, *unlabelled, *unseated)


def _groove(
    channels: Channels, planned: WallPlan, pockets: Any, labels: tuple[Label, ...], config: JigConfig
) -> Groove | None:
    """The wires' course where nothing else is: openings, numbers and walls have priority."""
    import shapely

    walls = shapely.union_all([polygon for polygon, _ in planned.polygons])
    numbers = [polygon_of(stroke, SAMPLED_MM) for label in labels for stroke in label.strokes]
    kept_free = shapely.union_all([planned.rims, pockets, *pin_discs(planned.pins), *numbers])
    return groove_of(channels, walls, kept_free, config.base_thickness / 2)
