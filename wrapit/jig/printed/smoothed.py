"""Polygons with smooth sides, for outlines that no wire touches: few long faces, not many short ones."""

from __future__ import annotations

import numpy as np
import shapely

from wrapit.geometry import Loop, Region
from wrapit.geometry.outlines.polygons import fitted_edges, polygon_of, region_of


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


def _fitted_loop(ring: shapely.LinearRing, fit_mm: float) -> Loop:
    """A smooth loop through the ring, in two halves so that neither closes on itself."""
    points = np.asarray(ring.coords)
    half = int(np.linalg.norm(points - points[0], axis=1).argmax())
    return Loop((*fitted_edges(points[: half + 1], fit_mm), *fitted_edges(points[half:], fit_mm)))
