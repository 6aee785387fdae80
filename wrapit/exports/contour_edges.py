"""Contours made ready for a file: joined exactly end to end, as one curve or as lines and arcs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry import Arc, BezierChain, Edge, FloatArray, Line
from wrapit.geometry.outlines.loops import as_chain as cubics_of
from wrapit.geometry.outlines.loops import point_of

# Ends that lie apart by more than this (mm) are a mistake of the caller, not rounding.
LARGEST_GAP_MM = 1e-3
# Arcs of at most this sweep differ from their cubic by less than 1e-7 of the radius.
ARC_STEP_RAD = math.radians(22.5)
# Those about the corners that the kerf rounds, 0.1 mm in radius, get longer pieces: of the first angle they
# were 290 of the 305 spans under 0.05 mm of the butterfly's walls. At 60° they stray by 2.4e-6 mm.
LEAST_PIECE_MM = 0.1
LONGEST_STEP_RAD = math.radians(60)


def as_chain(edges: Sequence[Edge], *, closed: bool) -> BezierChain:
    """The edges as one chain of Béziers without any gap; arcs as cubics of `_step_rad`."""
    parts = [cubics_of(edge, _step_rad(edge)).points.copy() for edge in edges]
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
            vertices.append((*point_of(edge.start), 0.0))
        elif isinstance(edge, Arc):
            parts = max(1, math.ceil(abs(edge.sweep_rad) / math.pi - 1e-9))
            step = edge.sweep_rad / parts
            for index in range(parts):
                part = Arc(edge.centre, edge.radius_mm, edge.start_rad + index * step, step)
                vertices.append((*point_of(part.start), math.tan(step / 4)))
        else:
            raise ValueError("a polyline of lines and arcs has no Bézier")
    if not closed:
        vertices.append((*point_of(edges[-1].end), 0.0))
    return vertices


def _step_rad(edge: Edge) -> float:
    """How far the cubics of an edge may turn, if it is an arc."""
    if not isinstance(edge, Arc):
        return ARC_STEP_RAD
    return min(LONGEST_STEP_RAD, max(ARC_STEP_RAD, LEAST_PIECE_MM / edge.radius_mm))


def _join(before: FloatArray, after: FloatArray) -> None:
    gap = float(np.linalg.norm(before[-1, 3] - after[0, 0]))
    if gap > LARGEST_GAP_MM:
        raise ValueError(f"edges lie {gap:g} mm apart")
    after[0, 0] = before[-1, 3]
