"""How high each wall has to be: where wires lie on one another, higher."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from wrapit.config import JigConfig
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.channel import Channels

# Above the last wire that a wall has room for: the set-back top (`jig.lead_in`, 0.3 mm) holds nothing.
HEADROOM_MM = 1.5
# Where along the wires heights are looked up, and how far off a wall's face a wire still counts as beside it
# (it may be wound a little loosely). 30 % up raises one of the lotus's 19 walls, and none
# of butterfly, dolphin and leaf.
STEP_MM = 0.25
BESIDE_MM = 0.3


def wall_height_mm(layers: int, diameter_mm: float, config: JigConfig) -> float:
    """Height (mm) over the plate of a wall: room for the layers of wire beside it, one more, and headroom.

    >>> round(wall_height_mm(1, 1.0, JigConfig()), 6), round(wall_height_mm(3, 1.0, JigConfig()), 6)
    (4.0, 5.5)
    """
    return max(config.min_wall_height, (layers + 1) * diameter_mm + HEADROOM_MM)


def glued_height_mm(layers: int, diameter_mm: float) -> float:
    """Least height of a wall cut from sheet: its wires' layers, two at least, and no headroom.

    Another law than that of printed walls, on purpose: sheet comes in whole thicknesses. Of 6 mm, 3 mm stand
    above a plate of 3 mm; with the printed law (4 mm) every wall of every piece would be two pieces glued.

    >>> glued_height_mm(1, 1.0), glued_height_mm(3, 1.0)
    (2.0, 3.0)
    """
    return max(2, layers) * diameter_mm


def wall_heights(channels: Channels, polygons: Sequence[Any], config: JigConfig) -> list[float]:
    """Height (mm) of each wall over the plate, by the most layers beside it."""
    import shapely

    heights = [wall_height_mm(1, channels.diameter_mm, config)] * len(polygons)
    raised = [wire for wire in channels.wires if wire.lifts]
    if not raised or not polygons:
        return heights
    tree = shapely.STRtree(polygons)
    for wire in raised:
        lengths = ArcLength(wire.centreline)
        at_mm = lengths.stations(STEP_MM)
        z_mm = wire.heights_mm(at_mm)
        points = shapely.points(wire.centreline.at(lengths.parameter(at_mm)))
        reach = channels.reach_mm + BESIDE_MM
        for point, wall in zip(*tree.query(points, predicate="dwithin", distance=reach), strict=True):
            layers = 1 + math.ceil(float(z_mm[point]) / channels.diameter_mm - 1e-3)
            needed = wall_height_mm(layers, channels.diameter_mm, config)
            heights[int(wall)] = max(heights[int(wall)], needed)
    return heights
