"""Handles: wall pieces too small for fingers grow at their backs, on ground that no wire needs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.errors import Finding
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.jig.sheet.model import LaserPart
from wrapit.jig.wall_ground import TOUCH_MM, printable, rounded

# How a piece grows: in all directions at once, a STEP at a time, until it is long enough. So it is at most
# two steps longer than asked: half of that takes twice the time, and no fingers tell the difference.
STEP_MM = 0.5
# What grows keeps this far off the wires' channels, half a millimetre more than its hollows are round
# (`wall_ground.BACK_MM`): faces stay as they were planned. At 0 mm seven of the leaf's outlines are no
# longer exact, at 1.5 mm one, as without handles.
FRONT_MM = 1.5


def length_mm(piece: Any) -> float:
    """How long a piece (shapely) is: the longer side of the narrowest box around it."""
    return _sides_mm(piece)[1]


def with_handles(
    walls: Sequence[Any], kept: Any, room: Any, width_mm: float, long_mm: float, apart_mm: float
) -> list[Any]:
    """The walls' polygons; those shorter than `long_mm` grow until they are as long, or as far as they can.

    They grow nowhere narrower than `width_mm`, not onto what is `kept` free (shapely), onto the `room`
    for fingers (shapely) with the rounding of hollows alone, and never nearer than `apart_mm` to another
    wall. No wall grows around anything. The smallest grow first.
    """
    import shapely

    grown = list(walls)
    for index in sorted(range(len(grown)), key=lambda index: (grown[index].area, index)):
        wall = grown[index]
        if length_mm(wall) >= long_mm:
            continue
        near = wall.buffer(2 * long_mm)
        others = [other for each, other in enumerate(grown) if each != index and other.intersects(near)]
        webs = shapely.union_all(others).buffer(apart_mm, quad_segs=16)
        barred = shapely.union_all([kept.intersection(near), webs.intersection(near)]).difference(wall)
        grown[index] = _grown(wall, barred, room.intersection(near).difference(wall), width_mm, long_mm)
    return grown


def _grown(wall: Any, barred: Any, room: Any, width_mm: float, long_mm: float) -> Any:
    """The wall grown no further than it takes; the longest that there is room for where that isn't enough."""
    import shapely

    best = wall
    for reach_mm in np.arange(STEP_MM, long_mm + STEP_MM, STEP_MM):
        around = shapely.get_parts(wall.buffer(reach_mm).difference(barred).difference(room))
        ground = shapely.union_all([wall, *(part for part in around if part.dwithin(wall, TOUCH_MM))])
        piece = _of_wall(printable(rounded(ground).difference(barred), width_mm), wall)
        if piece is not None and length_mm(piece) > length_mm(best):
            best = piece
        if length_mm(best) >= long_mm:
            break
    return best


def _of_wall(ground: Any, wall: Any) -> Any:
    """The part of the ground that the wall is in; None where it goes around what the wall doesn't."""
    import shapely

    whole = ground.union(wall)
    point = wall.representative_point()
    part = next(part for part in shapely.get_parts(whole) if part.intersects(point))
    return part if len(part.interiors) <= len(wall.interiors) else None


def small_pieces(jig: str, parts: Sequence[LaserPart], long_mm: float) -> tuple[Finding, ...]:
    """Says which wall pieces of a stack are too short for fingers all the same, and where the smallest is."""
    sizes = {part.label: _sides_mm(polygon_of(part.shape)) for part in parts if part.role == "wall"}
    small = [part for part in parts if part.label in sizes and sizes[part.label][1] < long_mm]
    if not small:
        return ()
    least = min(small, key=lambda part: (sizes[part.label][1], part.label))
    at = polygon_of(least.shape).representative_point()
    narrow_mm, longest_mm = sizes[least.label]
    others = ", ".join(part.label for part in small if part is not least)
    return (
        Finding(
            "note",
            "small-piece",
            f"{jig}, part {least.label} at ({at.x:.1f}, {at.y:.1f})",
            f"this wall piece is {narrow_mm:.1f} × {longest_mm:.1f} mm, and there is no more ground behind"
            f" it{f'; so it is with {others}' if others else ''}",
            "set it with tweezers, or make the piece larger",
        ),
    )


def _sides_mm(piece: Any) -> tuple[float, float]:
    """The sides of the narrowest box around a piece, the shorter first."""
    import shapely

    box = shapely.get_coordinates(shapely.minimum_rotated_rectangle(piece))
    short, long = sorted(np.linalg.norm(np.diff(box[:3], axis=0), axis=1))
    return float(short), float(long)
