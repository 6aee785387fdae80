"""Polygons with smooth sides, for outlines that no wire touches: few long faces, not many short ones."""

from __future__ import annotations

import numpy as np
import shapely

from wrapit.geometry import FloatArray, Loop, Region
from wrapit.geometry.outlines.polygons import CORNER_RAD, fitted_edges, polygon_of, region_of

# How near the sides of what is engraved are to its polygon, and their faces to those: nobody sees either. The
# butterfly's grooves have 65 sides so, its numbers 38.
ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM = 0.02, 0.03


def smoothed(polygon: shapely.Polygon, within: shapely.Geometry, fit_mm: float, straight_mm: float) -> Region:
    """The polygon with sides fitted within `fit_mm`, where these don't cross and stay `within` (shapely).

    Else with straight ones within `straight_mm`.
    """
    smooth = Region(
        _fitted_loop(polygon.exterior, fit_mm),
        tuple(_fitted_loop(ring, fit_mm) for ring in polygon.interiors),
    )
    sampled = polygon_of(smooth, 1e-3)
    if sampled.is_valid and within.contains_properly(sampled):
        return smooth
    return region_of(polygon.simplify(straight_mm))


def bends_rad(points: FloatArray) -> FloatArray:
    """By how much a ring (n, 2), not closed, bends at each of its points (n,)."""
    along = np.roll(points, -1, axis=0) - points
    heading = np.arctan2(along[:, 1], along[:, 0])
    return np.abs((heading - np.roll(heading, 1) + np.pi) % (2 * np.pi) - np.pi)


def _fitted_loop(ring: shapely.LinearRing, fit_mm: float) -> Loop:
    """A smooth loop through the ring from corner to corner; one with fewer than two is halved.

    So no edge closes on itself, and none ends where the ring happens to start.
    """
    points = np.asarray(ring.coords)[:-1]
    corners = np.flatnonzero(bends_rad(points) > CORNER_RAD)
    points = np.roll(points, -int(corners[0]) if len(corners) else 0, axis=0)
    closed = np.concatenate([points, points[:1]])
    if len(corners) > 1:
        return Loop(tuple(fitted_edges(closed, fit_mm)))
    half = int(np.linalg.norm(points - points[0], axis=1).argmax())
    return Loop((*fitted_edges(closed[: half + 1], fit_mm), *fitted_edges(closed[half:], fit_mm)))
