"""Faces of a sketch: what lines enclose, how much room is inside, and what is seen from outside."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from wrapit.fit.sketch import STEP_MM, Sketch
from wrapit.geometry import FloatArray, locked

if TYPE_CHECKING:
    import shapely

# How exactly the largest circle inside is found.
_CIRCLE_MM = 0.01
# A place is on a boundary within rounding, and what is thinner than this is a crossing of chords, unless it
# is longer than chords of lines that part ever cross (mm): then two lines lie on one another.
_ON_MM = 1e-6
_SLIVER = 5e-3
_CROSSING_MM = 2.0


@dataclass(frozen=True, eq=False)
class Face:
    """What lines enclose; `inside_mm` is the diameter of the largest circle in it, about `centre` (2,)."""

    polygon: shapely.Polygon
    lines: frozenset[int]
    centre: FloatArray
    inside_mm: float


@dataclass(frozen=True, eq=False)
class Faces:
    """All faces of a sketch, and the lines that are seen from outside: those of no two faces."""

    faces: tuple[Face, ...]
    outline: frozenset[int]


def faces_of(sketch: Sketch) -> Faces:
    """Faces of a planar sketch, the least first."""
    import shapely

    numbers = sorted(sketch.lines)
    points = [sketch.lines[number].curve.sampled(STEP_MM) for number in numbers]
    # Cut where they cross: a line that touches itself by a micron would lose its whole face.
    cut = shapely.union_all([sketch.lines[number].shape for number in numbers])
    polygons = [
        each
        for each in shapely.polygonize([cut]).geoms
        if each.area > _SLIVER * each.length or each.length > 2 * _CROSSING_MM
    ]
    middles = shapely.points([_inner_place(each) for each in points])
    if not polygons:
        return Faces((), frozenset(numbers))
    tree = shapely.STRtree(polygons)
    near = tree.query(middles, predicate="dwithin", distance=_ON_MM)
    on_edge = shapely.dwithin(shapely.boundary(np.array(polygons))[near[1]], middles[near[0]], _ON_MM)
    bounding: list[set[int]] = [set() for _ in polygons]
    for at, polygon in near[:, on_edge].T.tolist():
        bounding[polygon].add(numbers[at])
    sides = np.bincount(near[0], minlength=len(numbers))
    edges = np.bincount(near[0][on_edge], minlength=len(numbers))
    # One face beside it: the other side is outside. None, and not within a face: a line by itself.
    outside = [n for n, of, on in zip(numbers, sides, edges, strict=True) if on == 1 or of == 0]
    faces = [
        Face(polygon, frozenset(lines), *_largest_circle(polygon.wkb))
        for polygon, lines in zip(polygons, bounding, strict=True)
    ]
    faces.sort(key=lambda face: (round(face.inside_mm, 6), *np.round(face.centre, 6)))
    return Faces(tuple(faces), frozenset(outside))


@lru_cache(maxsize=512)  # most faces of a drawing stay as they are from one change to the next
def _largest_circle(polygon: bytes) -> tuple[FloatArray, float]:
    """Centre (2,) and diameter of the largest circle inside a polygon, given as well-known binary."""
    import shapely

    radius = shapely.maximum_inscribed_circle(shapely.from_wkb(polygon), tolerance=_CIRCLE_MM)
    return locked(radius.coords[0]), 2 * float(radius.length)


def _inner_place(points: FloatArray) -> FloatArray:
    """A place of a chain of points away from its ends: the middle of its middle piece."""
    at = (len(points) - 1) // 2
    return (points[at] + points[at + 1]) / 2
