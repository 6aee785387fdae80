"""Edges put end to end: without any gap, and without edges and spans of all but no length."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.outlines.loops import Arc, Edge, Line, point_of
from wrapit.geometry.polyline import steps

# What is too short for an edge or a span? No machine follows a micrometre, and shorter ones broke meshes and
# solids of 12 of 60 generated drawings: near a cusp parallels are halved down to 1e-9 mm. Walls may come this
# much nearer to a wire before they count as wrong.
LEAST_MM = 1e-3
# What rounding leaves between ends that are one.
TOUCHING_MM = 1e-9


def closed_up(edges: Sequence[Edge]) -> list[Edge]:
    """The edges of a closed outline, each starting exactly where the one before ends, none too short.

    What is shorter than LEAST_MM is left out and its neighbours meet there; several in a row that are longer
    together become one. An outline that would have no two edges left stays as it is.
    """
    long = [kept for edge in edges if (kept := _lengthy(edge)) is not None]
    if len(long) < 2:
        return _snapped(edges)
    bridged: list[Edge] = []
    for index, edge in enumerate(long):
        before = long[index - 1]
        gap = math.dist(before.end, edge.start)
        fixed = isinstance(before, Arc) and isinstance(edge, Arc) and gap > TOUCHING_MM
        if gap >= LEAST_MM or fixed:
            bridged.append(Line(point_of(before.end), point_of(edge.start)))
        bridged.append(edge)
    return _snapped(bridged)


def without_short_spans(edge: BezierChain) -> BezierChain | None:
    """The chain with spans under LEAST_MM made one or given to a neighbour; None if all of it is shorter."""
    points = edge.points.copy()
    sizes = steps(points).sum(axis=1)
    if (sizes >= LEAST_MM).all():
        return edge
    kept: list[FloatArray] = []
    first = 0
    while first < len(points):
        last, total = first, 0.0
        while last < len(points) and sizes[last] < LEAST_MM and total < LEAST_MM:
            total += float(sizes[last])
            last += 1
        if last == first:
            kept.append(points[first])
            last += 1
        elif total >= LEAST_MM:
            kept.append(_spanning(points[first], points[last - 1]))
        elif last < len(points):
            points[last, :2] += points[first, 0] - points[last, 0]
        elif kept:
            kept[-1][2:] += points[-1, 3] - kept[-1][3]
        else:
            return None
        first = last
    return BezierChain(np.array(kept))


def _lengthy(edge: Edge) -> Edge | None:
    if isinstance(edge, BezierChain):
        return without_short_spans(edge)
    size = abs(edge.sweep_rad) * edge.radius_mm if isinstance(edge, Arc) else math.dist(edge.start, edge.end)
    return edge if size >= LEAST_MM else None


def _spanning(first: FloatArray, last: FloatArray) -> FloatArray:
    """One cubic from the start of one to the end of another, with their tangents there."""
    a, b = first[0], last[3]
    third = float(np.linalg.norm(b - a)) / 3
    leaving, arriving = BezierChain(first[None]).start_tangent, BezierChain(last[None]).end_tangent
    return np.array([a, a + third * leaving, b - third * arriving, b])


def _snapped(edges: Sequence[Edge]) -> list[Edge]:
    """The edges with each one's start put exactly on the end of the one before (they differ by rounding)."""
    snapped: list[Edge] = []
    for index, edge in enumerate(edges):
        before, after = edges[index - 1], edges[(index + 1) % len(edges)]
        start = _arc_point(before, last=True) or (edge.start if isinstance(edge, Arc) else _end(before))
        end = _arc_point(after, last=False)
        if isinstance(edge, Line):
            snapped.append(Line(start, end or edge.end))
        elif isinstance(edge, BezierChain):
            cubics = edge.points.copy()
            cubics[0, :2] += np.array(start) - cubics[0, 0]
            if end:
                cubics[-1, 2:] += np.array(end) - cubics[-1, 3]
            snapped.append(BezierChain(cubics))
        else:
            snapped.append(edge)
    return snapped


def _arc_point(edge: Edge, *, last: bool) -> tuple[float, float] | None:
    if not isinstance(edge, Arc):
        return None
    return edge.end if last else edge.start


def _end(edge: Edge) -> tuple[float, float]:
    return point_of(edge.end) if isinstance(edge, BezierChain) else edge.end
