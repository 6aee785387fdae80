"""Posts, wires and an elastic band, for tests of the taut wire."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from wrapit.geometry import FloatArray
from wrapit.jig.taut.shortest import FreeGround

RADIUS_MM = 0.5


def length(path: FloatArray) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def post(x: float, y: float, radius: float, quarter: int = 256) -> shapely.Polygon:
    """A round post, as a polygon of 4 x `quarter` sides."""
    return shapely.Point(x, y).buffer(radius, quarter)


def arc(x: float, y: float, radius: float, start: float, end: float) -> FloatArray:
    """Points on a circle from one angle to another, in degrees."""
    angles = np.radians(np.linspace(start, end, math.ceil(abs(end - start) / 4) + 2))
    return np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])


def joined(*parts: Sequence[Sequence[float]] | FloatArray) -> FloatArray:
    return np.concatenate([np.asarray(part, dtype=float).reshape(-1, 2) for part in parts])


def pulled(obstacles: BaseGeometry, path: FloatArray, closed: bool = False) -> FloatArray:
    return FreeGround.around(obstacles, [path], [closed]).pulled(path, closed)


def wandering(rng: np.random.Generator, knots: int, size: float = 40.0) -> FloatArray:
    """A smooth way over a square that crosses itself, points 0.5 mm apart or less."""
    corners = rng.uniform(0.1 * size, 0.9 * size, (knots, 2))
    # Chaikin's corner cutting, four times: a quadratic spline.
    for _ in range(4):
        a, b = corners[:-1], corners[1:]
        inner = np.stack([0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b], axis=1).reshape(-1, 2)
        corners = np.concatenate([corners[:1], inner, corners[-1:]])
    return shapely.get_coordinates(shapely.segmentize(shapely.LineString(corners), 0.5))


def field_beside(
    rng: np.random.Generator, path: FloatArray, count: int, size: float = 40.0
) -> shapely.MultiPolygon:
    """Walls of all sorts strewn over a square, 0 to 0.1 mm from a wire along `path`, grown by its radius."""
    made: list[BaseGeometry] = []
    for kind in rng.integers(0, 4, count):
        x, y = rng.uniform(0, size, 2)
        if kind == 0:
            made.append(post(x, y, rng.uniform(0.5, 3), 6))
        elif kind == 1:
            made.append(shapely.box(x, y, x + rng.uniform(1, 5), y + rng.uniform(1, 5)))
        elif kind == 2:
            made.append(shapely.MultiPoint(np.add(rng.uniform(-3, 3, (3, 2)), (x, y))).convex_hull)
        else:
            made.append(
                shapely.LineString([(x, y), tuple(np.add(rng.uniform(-8, 8, 2), (x, y)))]).buffer(0.4)
            )
    clear = shapely.LineString(path).buffer(RADIUS_MM + rng.uniform(0, 0.1))
    walls = shapely.union_all(made).difference(clear).buffer(-0.1).buffer(0.1)
    return shapely.MultiPolygon(
        [part for part in shapely.get_parts(walls.buffer(RADIUS_MM, quad_segs=8)) if part.area > 0]
    )


def elastic(obstacles: BaseGeometry, path: FloatArray, count: int, rounds: int) -> FloatArray:
    """The path as an elastic band of `count` points. It knows nothing of triangles.

    Each point is drawn to the middle of its neighbours, and pushed out of the obstacles to the nearest place.
    """
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    at = np.linspace(0, along[-1], count)
    band = np.column_stack([np.interp(at, along, path[:, axis]) for axis in (0, 1)])
    solid = shapely.union_all(shapely.get_parts(obstacles))
    shapely.prepare(solid)
    edge = solid.boundary
    for _ in range(rounds):
        # Odd points, then even ones: each moves between neighbours that stand still.
        for first in (1, 2):
            moving = np.arange(first, count - 1, 2)
            moved = (band[moving - 1] + band[moving + 1]) / 2
            within = np.flatnonzero(shapely.contains_xy(solid, moved))
            if len(within):
                points = shapely.points(moved[within])
                nearest = shapely.line_interpolate_point(edge, shapely.line_locate_point(edge, points))
                moved[within] = shapely.get_coordinates(nearest)
            band[moving] = moved
    return band
