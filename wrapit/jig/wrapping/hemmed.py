"""Where a jig is a channel: walls on both sides of a wire, which the paper (section 5) tried and gave up."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from wrapit.jig.channel import SIDES, Channels
from wrapit.wires.model import Turn

# So near to the wire's surface a wall hems it in.
BESIDE_MM = 0.75
STEP_MM = 0.2


def hemmed_share(channels: Channels, walls: Iterable[Any]) -> float:
    """The share of the wires' length that has a wall (shapely polygon) close by on both sides."""
    import shapely

    standing = shapely.union_all(list(walls))
    shapely.prepare(standing)
    radius_mm = channels.diameter_mm / 2
    hemmed, stations = 0, 0
    for wire in channels.wires:
        whole = Turn(wire.name, 0.0, wire.length_mm, "left", 0.0)
        _, points, normals, _ = channels.stations(whole, STEP_MM)
        beside = np.ones(len(points), dtype=bool)
        for side in SIDES.values():
            ends = (points + side * radius_mm * normals, points + side * (radius_mm + BESIDE_MM) * normals)
            beside &= shapely.intersects(standing, shapely.linestrings(np.stack(ends, axis=1)))
        hemmed += int(beside.sum())
        stations += len(points)
    return hemmed / stations
