"""Pieces that hands can hold: neighbours are joined, small walls grow, on ground that no wire needs."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Any, TypeVar

import numpy as np

from wrapit.errors import Finding
from wrapit.geometry import FloatArray
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.jig.sheet.model import LaserPart
from wrapit.jig.wall_ground import TOUCH_MM, printable, rounded

# How a piece grows: in all directions at once, a STEP at a time, until it is long enough. So it is at most
# two steps longer than asked: half of that takes twice the time, and no fingers tell the difference.
STEP_MM = 0.5
# What grows or joins keeps this far off the wires' channels, half a millimetre more than hollows are round
# (`wall_ground.BACK_MM`): faces stay as they were planned. Leaf, butterfly and lotus have as many pieces, and
# all outlines exact, at 0.75 and 0 mm too.
FRONT_MM = 1.5
# How far apart two walls may be that become one piece over a strip as wide as the narrowest wall: six times
# that width, so that the strip doesn't break while the piece is glued. The gallery's 91 walls are 76 pieces
# so, 79 at 8 mm, 73 at 16 mm. Strips are tried between places of both outlines, a SIDE_STEP apart.
STRIP_MM = 12.0
SIDE_STEP_MM = 1.0
# What a strip may lose of its width to outlines that are polygons.
ROUND_MM = 0.02
CRUMB_MM2 = 1e-6

_Held = TypeVar("_Held")


def length_mm(piece: Any) -> float:
    """How long a piece (shapely) is: the longer side of the narrowest box around it."""
    return _sides_mm(piece)[1]


def joined(
    walls: Sequence[tuple[Any, tuple[_Held, ...]]], barred: Any, width_mm: float, apart_mm: float
) -> list[tuple[Any, tuple[_Held, ...]]]:
    """Walls (polygon, what it holds) with neighbours made one piece where a strip can join them.

    Strips are `width_mm` wide and up to STRIP_MM long, the shortest first. None lies on what is `barred`
    (shapely; it is not the walls' own), comes nearer than `apart_mm` to a third wall, or closes a ring.
    """
    import shapely

    pieces: dict[tuple[int, ...], tuple[Any, tuple[_Held, ...]]]
    pieces = {(index,): wall for index, wall in enumerate(walls)}
    shapely.prepare(barred)
    strips = _strips([wall for wall, _ in walls], barred, width_mm, apart_mm)
    for _, first, second, strip in sorted(strips, key=lambda strip: strip[:3]):
        one, other = (next(key for key in pieces if index in key) for index in (first, second))
        if one == other:
            continue
        third = [piece for key, (piece, _) in pieces.items() if key not in (one, other)]
        piece = _joint(pieces[one][0], pieces[other][0], strip, width_mm)
        if piece is not None and not shapely.dwithin(strip, third, apart_mm).any():
            held = (*pieces.pop(one)[1], *pieces.pop(other)[1])
            pieces[(*one, *other)] = (piece, held)
    return [pieces[key] for key in sorted(pieces)]


def _strips(
    walls: Sequence[Any], barred: Any, width_mm: float, apart_mm: float
) -> Iterator[tuple[float, int, int, Any]]:
    """For each pair of neighbours the shortest strip that joins them: length, their places, polygon."""
    import shapely

    sides = [_places(wall) for wall in walls]
    for (first, one), (second, other) in itertools.combinations(enumerate(walls), 2):
        if not shapely.dwithin(one, other, STRIP_MM):
            continue
        between = np.linalg.norm(sides[first][:, None] - sides[second], axis=-1)
        at = np.argwhere((between > ROUND_MM) & (between <= STRIP_MM))
        at = at[np.argsort(between[tuple(at.T)], kind="stable")]
        ends = np.stack([sides[first][at[:, 0]], sides[second][at[:, 1]]], axis=1)
        clear = ~shapely.contains_xy(barred, ends.mean(axis=1))
        both = one.union(other)
        near = both.buffer(STRIP_MM)
        others = shapely.union_all([wall for index, wall in enumerate(walls) if index not in (first, second)])
        kept = barred.union(others.buffer(apart_mm)).intersection(near).difference(both)
        shapely.prepare(kept)
        for line in shapely.linestrings(ends[clear]):
            bare = line.buffer(width_mm / 2, cap_style="flat").difference(both)
            if bare.intersects(kept):
                continue
            strip = line.buffer(width_mm / 2, cap_style="square").difference(kept)
            if _joint(one, other, strip, width_mm) is not None:
                yield line.length, first, second, strip
                break


def _joint(one: Any, other: Any, strip: Any, width_mm: float) -> Any:
    """Two walls with the strip that makes them one, nowhere narrower than they are; None where it doesn't."""
    import shapely

    def cores(walls: Any) -> int:
        return len(shapely.get_parts(walls.buffer(ROUND_MM - width_mm / 2)))

    # What strip and wall share without area is no part of a piece.
    parts = [
        part for part in shapely.get_parts(shapely.union_all([one, other, strip])) if part.area > CRUMB_MM2
    ]
    whole = (
        len(parts) == 1
        and len(parts[0].interiors) == len(one.interiors) + len(other.interiors)
        and cores(parts[0]) < cores(one) + cores(other)
    )
    return parts[0] if whole else None


def _places(wall: Any) -> FloatArray:
    """Places (n, 2) along a wall's outline."""
    import shapely

    count = int(np.ceil(wall.exterior.length / SIDE_STEP_MM))
    at = np.arange(count) / count
    places = shapely.line_interpolate_point(wall.exterior, at, normalized=True)
    return np.asarray(shapely.get_coordinates(places))


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
