"""Where along a wire a wall stands close by on one side: what the hand wraps it round."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final

import numpy as np

from wrapit.geometry import FloatArray, Region, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import runs
from wrapit.geometry.outlines.loops import circle
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.bench.model import NO_WALL, Bench, Contact
from wrapit.jig.channel import SIDES
from wrapit.jig.model import Pin
from wrapit.jig.paired.leaning import leaning
from wrapit.wires.model import Wire

# How often a wire is looked at, and how deep behind the place of a wall's face: the wall is there or isn't.
STEP_MM: Final = 0.1
DEPTH_MM: Final = 0.1
# Shorter ones are corners of walls that a wire passes.
SHORTEST_MM: Final = 0.8


def bench_of(
    name: str,
    wires: Sequence[Wire],
    walls: Sequence[Region],
    plate: Region,
    pins: Sequence[Pin],
    reach_mm: float,
    *,
    unmarked: Iterable[str] = (),
    seats_mm: Sequence[float] = (),
) -> Bench:
    """A jig with walls and pins on the bench; see `contacts`."""
    standing = (*walls, *standing_pins(pins))
    numbered = tuple(enumerate(pins, start=len(walls)))
    return Bench(
        name,
        tuple(wires),
        standing,
        plate,
        {
            wire.name: in_order((*contacts(wire, walls, reach_mm, numbered), *round_runs(wire, wires)))
            for wire in wires
        },
        unmarked=frozenset(unmarked),
        seats_mm=tuple(seats_mm),
    )


def contacts(
    wire: Wire, walls: Sequence[Region], reach_mm: float, pins: Iterable[tuple[int, Pin]] = ()
) -> tuple[Contact, ...]:
    """In the order of the wire, each span with a wall within `reach_mm` of its centreline on one side.

    `pins` come with their places among the walls.
    """
    import shapely

    tree = shapely.STRtree([polygon_of(wall, 0.02) for wall in walls])
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    u = lengths.parameter(at_mm)
    points, tangents = wire.centreline.at(u), unit(wire.centreline.derivative(u))
    normals = np.column_stack([-tangents[:, 1], tangents[:, 0]])
    found = [
        Contact(float(at_mm[first]), float(at_mm[last]), side, "wall", index)
        for side, sign in SIDES.items()
        for index, first, last in _beside(tree, points + sign * (reach_mm + DEPTH_MM) * normals)
        if at_mm[last] - at_mm[first] >= SHORTEST_MM
    ]
    found += [
        Contact(pin.turn.start_mm, pin.turn.end_mm, pin.turn.inside, "pin", index, rod_mm=pin.diameter_mm)
        for index, pin in pins
        if pin.turn.wire == wire.name
    ]
    return in_order(found)


def in_order(found: Iterable[Contact]) -> tuple[Contact, ...]:
    """Contacts in the order of the wire."""
    return tuple(sorted(found, key=lambda contact: (contact.start_mm, contact.end_mm)))


def round_runs(wire: Wire, wires: Sequence[Wire]) -> tuple[Contact, ...]:
    """Where a wire is bent round another run of these wires that lies there already."""
    return tuple(
        Contact(turn.start_mm, turn.end_mm, turn.inside, "run", NO_WALL)
        for turn, run in leaning(wire, wires)
        if not run.first and not turn.stretch
    )


def standing_pins(pins: Iterable[Pin]) -> tuple[Region, ...]:
    """Pins as they stand in their holes, from above."""
    return tuple(Region(circle(pin.centre, pin.diameter_mm / 2)) for pin in pins)


def _beside(tree: Any, probes: FloatArray) -> Iterable[tuple[int, int, int]]:
    """(wall, first, last): runs of these points (n, 2) that lie in one wall."""
    import shapely

    hit, wall = tree.query(shapely.points(probes), predicate="intersects")
    for index in sorted(set(wall.tolist())):
        inside = np.zeros(len(probes), bool)
        inside[hit[wall == index]] = True
        yield from ((index, first, last) for first, last in runs(inside))
