"""The plan of a jig: which walls, holes and plate these wires need, in the plane and without a kernel."""

from __future__ import annotations

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.jig.blanks import wall_polygons
from wrapit.jig.course import Course
from wrapit.jig.holes import hole_obstacles, start_holes
from wrapit.jig.model import JigPlan, Plate, Wall
from wrapit.jig.plates import plate_outline
from wrapit.wires.model import Wire

LEAST_WALL_HEIGHT_MM = 4.0
HEADROOM_MM = 1.5


def plan_jig(
    wires: tuple[Wire, ...], config: JigConfig, name: str = "jig"
) -> tuple[JigPlan, tuple[Finding, ...]]:
    """The plan of one jig that holds all these wires.

    Raises JigError without wires, ValueError for wires of different diameters.
    """
    import shapely

    if not wires:
        raise JigError("there are no wires to make a jig for")
    course = Course.of(wires, config)
    holes = start_holes(course, config)
    polygons, findings = wall_polygons(course, config, hole_obstacles(holes))
    walls = tuple(Wall(turns, polygon, _height_mm(course)) for polygon, turns in polygons)
    rims = [shapely.Polygon(hole.outline.sampled(0.01)) for hole in holes]
    covered = shapely.union_all([course.channels, *rims, *(wall.outline for wall in walls)])
    outline = plate_outline(covered, config.margin, config.corner_radius)
    plate = Plate(Region(outline), config.base_thickness)
    return JigPlan(name, tuple(wire.name for wire in wires), walls, holes, plate), findings


def _height_mm(course: Course) -> float:
    layers = max(wire.layers for wire in course.wires)
    return max(LEAST_WALL_HEIGHT_MM, (layers + 1) * course.diameter_mm + HEADROOM_MM)
