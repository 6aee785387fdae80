"""How high each wall has to be: where wires lie on one another, higher."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from wrapit.config import JigConfig
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.channel import Course

STEP_MM = 0.25
BESIDE_MM = 0.3
HEADROOM_MM = 1.5


def wall_heights(course: Course, polygons: Sequence[Any], config: JigConfig) -> list[float]:
    """Height of each wall over the plate: room for the layers beside it, one more, and 1.5 mm."""
    import shapely

    flat = max(config.min_wall_height, 2 * course.diameter_mm + HEADROOM_MM)
    heights = [flat] * len(polygons)
    raised = [wire for wire in course.wires if wire.lifts]
    if not raised or not polygons:
        return heights
    tree = shapely.STRtree(polygons)
    for wire in raised:
        lengths = ArcLength(wire.centreline)
        at_mm = lengths.stations(STEP_MM)
        z_mm = wire.heights_mm(at_mm)
        points = shapely.points(wire.centreline.at(lengths.parameter(at_mm)))
        reach = course.reach_mm + BESIDE_MM
        for point, wall in zip(*tree.query(points, predicate="dwithin", distance=reach), strict=True):
            layers = 1 + math.ceil(float(z_mm[point]) / course.diameter_mm - 1e-3)
            needed = (layers + 1) * course.diameter_mm + HEADROOM_MM
            heights[int(wall)] = max(heights[int(wall)], needed)
    return heights
