"""Exact regions and polygons: sampling, exact areas, and smooth outlines through sampled points."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.bspline import BSpline, chain_of
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Loop, Region, point_of
from wrapit.geometry.polyline import lengths, steps, total_length

# What stays a corner, what is straight, and how close points stand on straight stretches before a curve is
# fitted: each a third more or less leaves all free sides of two of our drawings as they are.
CORNER_RAD = math.radians(20)
STRAIGHT_MM = 1e-4
FIT_STEP_MM = 0.25


def polygon_of(region: Region, tolerance_mm: float) -> Any:
    """The region as a shapely Polygon about `tolerance_mm` from it."""
    from shapely import Polygon

    return Polygon(region.outer.sampled(tolerance_mm), [hole.sampled(tolerance_mm) for hole in region.holes])


def loop_area_mm2(loop: Loop) -> float:
    """Exact signed area, positive counter-clockwise (Green's theorem)."""
    return sum(_edge_area(edge) for edge in loop.edges)


def region_area_mm2(region: Region) -> float:
    """Exact area of the region."""
    return abs(loop_area_mm2(region.outer)) - sum(abs(loop_area_mm2(hole)) for hole in region.holes)


def region_of(polygon: Any) -> Region:
    """The polygon itself as a region of straight lines; for outlines without curves."""
    return Region(_straight_loop(polygon.exterior), tuple(_straight_loop(ring) for ring in polygon.interiors))


def fitted_edges(points: FloatArray, tolerance_mm: float) -> list[Edge]:
    """Lines and smooth cubics through the points (n, 2), from the first exactly to the last.

    Corners sharper than 20° stay corners; between them the curve keeps within the tolerance of the points.
    """
    points = points[np.concatenate([[True], steps(points) > 1e-7])]
    if len(points) < 2:
        return []
    points = _with_points_between(points)
    headings = np.arctan2(*np.diff(points, axis=0).T[::-1])
    bends = np.abs((np.diff(headings) + math.pi) % (2 * math.pi) - math.pi)
    corners = [0, *(np.flatnonzero(bends > CORNER_RAD) + 1).tolist(), len(points) - 1]
    return [_smooth_edge(points[a : b + 1], tolerance_mm) for a, b in itertools.pairwise(corners)]


def _with_points_between(points: FloatArray) -> FloatArray:
    """The points, and more on long straight stretches, where a curve could otherwise swing out."""
    counts = np.ceil(steps(points) / FIT_STEP_MM).astype(int)
    parts = [
        a + (b - a) * (np.arange(count) / count)[:, None]
        for a, b, count in zip(points[:-1], points[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, points[-1:]])


def _edge_area(edge: Edge) -> float:
    if isinstance(edge, Line):
        return (edge.start[0] * edge.end[1] - edge.end[0] * edge.start[1]) / 2
    if isinstance(edge, Arc):
        (x, y), (ax, ay), (bx, by) = edge.centre, edge.start, edge.end
        return (edge.radius_mm**2 * edge.sweep_rad + x * (by - ay) - y * (bx - ax)) / 2
    # x dy - y dx of a cubic in its Bernstein coefficients (products of basis functions, integrated).
    p = edge.points
    total = 0.0
    for i, j, weight in ((0, 1, 6), (0, 2, 3), (0, 3, 1), (1, 2, 3), (1, 3, 3), (2, 3, 6)):
        total += weight * float((p[:, i, 0] * p[:, j, 1] - p[:, j, 0] * p[:, i, 1]).sum())
    return total / 20


def _straight_loop(ring: Any) -> Loop:
    points = [(float(x), float(y)) for x, y in np.asarray(ring.coords)[:-1]]
    return Loop(tuple(Line(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)))


def _smooth_edge(points: FloatArray, tolerance_mm: float) -> Edge:
    start, end = points[0], points[-1]
    chord = end - start
    length = float(np.hypot(*chord))
    away = np.abs(chord[0] * (points[:, 1] - start[1]) - chord[1] * (points[:, 0] - start[0]))
    travelled = total_length(points)
    if len(points) == 2 or (travelled - length <= STRAIGHT_MM and away.max() <= STRAIGHT_MM * length):
        return Line(point_of(start), point_of(end))
    return _through(points, tolerance_mm)


def _through(points: FloatArray, tolerance_mm: float) -> BezierChain:
    """A smooth cubic spline through ever more of the points, until all are within the tolerance."""
    from scipy.interpolate import make_interp_spline

    u = lengths(points)
    chosen = np.unique(np.linspace(0, len(points) - 1, 5).round().astype(int))
    while True:
        degree = min(3, len(chosen) - 1)
        spline = make_interp_spline(u[chosen], points[chosen], k=degree)
        error = np.linalg.norm(spline(u) - points, axis=1)
        if error.max() <= tolerance_mm or len(chosen) == len(points):
            break
        worst = [
            a + int(error[a : b + 1].argmax())
            for a, b in itertools.pairwise(chosen)
            if error[a : b + 1].max() > tolerance_mm
        ]
        chosen = np.unique(np.concatenate([chosen, worst]))
    if degree < 3:
        return _raised(spline, points)
    chain = chain_of(BSpline(3, spline.c, spline.t)).points.copy()
    chain[0, 0], chain[-1, 3] = points[0], points[-1]
    return BezierChain(chain)


def _raised(spline: Any, points: FloatArray) -> BezierChain:
    """A parabola through three points as a cubic."""
    a, b, c = spline.c
    cubic = np.array([a, a / 3 + 2 * b / 3, 2 * b / 3 + c / 3, c])
    cubic[0], cubic[-1] = points[0], points[-1]
    return BezierChain(cubic[None])
