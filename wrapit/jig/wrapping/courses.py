"""How each wire lies when it is laid under tension round the walls, and how far that is from the drawing."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.channel import Channels
from wrapit.jig.model import Course
from wrapit.jig.paired.between import metal_between
from wrapit.jig.taut.deviation import deviations
from wrapit.jig.taut.shortest import FreeGround
from wrapit.wires.model import Wire

# How finely a drawn wire is looked at: half a tolerance of 0.35 mm and less.
STEP_MM = 0.2
# What walls may lose of their corners' roundness before a wire is laid round them.
SIMPLER_MM = 5e-3
# How many wires are remembered with their places from one round of planning to the next.
_REMEMBERED = 200


def courses(channels: Channels, walls: Iterable[Any]) -> tuple[Course, ...]:
    """The course of each wire round these walls (shapely polygons), in the order of the wires.

    The shortest path that goes round the walls the same way as the drawn wire. Its ends are held in their
    holes, those of a wire that closes too; wires don't hinder one another, as they lie in layers. But two
    runs side by side do: none passes the other.
    """
    places = [_places(wire) for wire in channels.wires]
    obstacles = grown(walls, channels.diameter_mm)
    between = [metal_between(channels, index) for index in range(len(places))]
    alone = [points for (_, points), metal in zip(places, between, strict=True) if metal is None]
    ground = FreeGround.around(obstacles, alone) if alone else None
    laid = []
    for wire, (at_mm, points), metal in zip(channels.wires, places, between, strict=True):
        mine = ground if metal is None else FreeGround.around(obstacles.union(metal), [points])
        assert mine is not None, "whoever has nothing beside it lies on the common ground"
        laid.append(_course(wire.name, mine.pulled(points), at_mm, points))
    return tuple(laid)


def grown(walls: Iterable[Any], diameter_mm: float) -> Any:
    """Where the centre of a wire can't be that is laid round these walls (shapely)."""
    import shapely

    whole = shapely.union_all(shapely.buffer(list(walls), diameter_mm / 2, quad_segs=16))
    return whole.simplify(SIMPLER_MM)


def _course(name: str, taut: FloatArray, at_mm: FloatArray, points: FloatArray) -> Course:
    return Course(name, taut, at_mm, points, deviations(points, taut))


@lru_cache(_REMEMBERED)
def _places(wire: Wire) -> tuple[FloatArray, FloatArray]:
    """Places along a wire (n,) and their points (n, 2)."""
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    return at_mm, wire.centreline.at(lengths.parameter(at_mm))
