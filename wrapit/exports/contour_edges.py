"""Contours made ready for a file: joined exactly end to end, as one curve or as lines and arcs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry import Arc, BezierChain, Edge, FloatArray, Line, straight

# Ends that lie apart by more than this (mm) are a mistake of the caller, not rounding.
LARGEST_GAP_MM = 1e-3
# Arcs of at most this sweep differ from their cubic by less than 1e-7 of the radius.
ARC_STEP_RAD = math.radians(22.5)


def as_chain(edges: Sequence[Edge], *, closed: bool) -> BezierChain:
    """The edges as one chain of Béziers without any gap; arcs are within 1e-7 of their radius."""
    parts = [_beziers(edge).copy() for edge in edges]
    for before, after in itertools.pairwise(parts):
        _join(before, after)
    if closed:
        _join(parts[-1], parts[0])
    return BezierChain(np.concatenate(parts))


def as_bulges(edges: Sequence[Edge], *, closed: bool) -> list[tuple[float, float, float]]:
    """Vertices (x, y, bulge) of a polyline of lines and arcs; ValueError if there is another curve.

    A bulge is the tangent of a quarter of the arc's sweep; a full circle goes in two halves. Open
    polylines end with their last point.
    """
    vertices: list[tuple[float, float, float]] = []
    for edge in edges:
        if isinstance(edge, Line):
            vertices.append((*_xy(edge.start), 0.0))
        elif isinstance(edge, Arc):
            parts = max(1, math.ceil(abs(edge.sweep_rad) / math.pi - 1e-9))
            step = edge.sweep_rad / parts
            for index in range(parts):
                part = Arc(edge.centre, edge.radius_mm, edge.start_rad + index * step, step)
                vertices.append((*_xy(part.start), math.tan(step / 4)))
        else:
            raise ValueError("a polyline of lines and arcs has no Bézier")
    if not closed:
        vertices.append((*_xy(edges[-1].end), 0.0))
    return vertices


def is_circle(edges: Sequence[Edge]) -> bool:
    """Whether this is one full circle."""
    return len(edges) == 1 and isinstance(edges[0], Arc) and abs(abs(edges[0].sweep_rad) - math.tau) < 1e-9


def _xy(point: Sequence[float] | FloatArray) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def _beziers(edge: Edge) -> FloatArray:
    if isinstance(edge, BezierChain):
        return edge.points
    if isinstance(edge, Line):
        return straight(edge.start, edge.end).points
    parts = max(1, math.ceil(abs(edge.sweep_rad) / ARC_STEP_RAD - 1e-9))
    angles = edge.start_rad + edge.sweep_rad * np.arange(parts + 1) / parts
    on = np.array(edge.centre) + edge.radius_mm * np.column_stack([np.cos(angles), np.sin(angles)])
    handle = 4 / 3 * math.tan(edge.sweep_rad / parts / 4) * edge.radius_mm
    along = handle * np.column_stack([-np.sin(angles), np.cos(angles)])
    return np.stack([on[:-1], on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], axis=1)


def _join(before: FloatArray, after: FloatArray) -> None:
    gap = float(np.linalg.norm(before[-1, 3] - after[0, 0]))
    if gap > LARGEST_GAP_MM:
        raise ValueError(f"edges lie {gap:g} mm apart")
    after[0, 0] = before[-1, 3]
