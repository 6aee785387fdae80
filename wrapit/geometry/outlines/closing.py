"""Edges put end to end: without any gap, and without edges and spans of all but no length."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry.arrays import FloatArray, unit
from wrapit.geometry.bezier import BezierChain, derivative, evaluate
from wrapit.geometry.outlines.loops import Arc, Edge, Line, point_of
from wrapit.geometry.polyline import steps

# What is too short for an edge or a span? No machine follows a micrometre, and shorter ones broke meshes and
# solids of 12 of 60 generated drawings: near a cusp parallels are halved down to 1e-9 mm. Walls may come this
# much nearer to a wire before they count as wrong.
LEAST_MM = 1e-3
# Which spans should not stay alone, and how near does one cubic follow two? Laser cutters slow down at each
# joint. With the parallel's own 2e-5 mm this is still finer than any machine.
SHORT_MM, MERGED_MM = 0.05, 2e-5
_PLACES = np.linspace(0, 1, 9)
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


def with_longer_spans(chain: BezierChain) -> BezierChain:
    """The chain with spans under SHORT_MM merged into a neighbour, where one cubic follows both.

    Both are followed within MERGED_MM, with their tangents at the ends.
    """
    spans = list(chain.points)
    index = 0
    while index < len(spans):
        if _size(spans[index]) < SHORT_MM and (at := _mergeable(spans, index)) is not None:
            first, cubic = at
            spans[first : first + 2] = [cubic]
            index = max(0, first - 1)
        else:
            index += 1
    return chain if len(spans) == len(chain) else BezierChain(np.array(spans))


def _mergeable(spans: list[FloatArray], index: int) -> tuple[int, FloatArray] | None:
    """Which two neighbours become one cubic: the span and its shorter neighbour, or its other one."""
    near = [first for first in (index - 1, index) if 0 <= first < len(spans) - 1]
    near.sort(key=lambda first: _size(spans[first]) + _size(spans[first + 1]))
    for first in near:
        cubic = _merged(spans[first], spans[first + 1])
        if cubic is not None:
            return first, cubic
    return None


def _merged(before: FloatArray, after: FloatArray) -> FloatArray | None:
    """One cubic in the place of two with one tangent between; None where it strays from them.

    Of two parts of one cubic it is that cubic: handles grow as the parameter's range does.
    """
    arriving, leaving = (float(np.linalg.norm(d)) for d in (before[3] - before[2], after[1] - after[0]))
    if min(arriving, leaving) < TOUCHING_MM:
        return None
    share = arriving / (arriving + leaving)
    cubic = np.array(
        [
            before[0],
            before[0] + (before[1] - before[0]) / share,
            after[3] + (after[2] - after[3]) / (1 - share),
            after[3],
        ]
    )
    own = evaluate(np.stack([before, after]), _PLACES)
    shares = np.concatenate([share * _PLACES, share + (1 - share) * _PLACES])
    got, along = evaluate(cubic[None], shares)[0], unit(derivative(cubic[None], shares)[0])
    apart = own.reshape(-1, 2) - got
    aside = np.abs(apart[:, 0] * along[:, 1] - apart[:, 1] * along[:, 0])
    ahead = np.abs((apart * along).sum(axis=1))
    return cubic if aside.max() <= MERGED_MM and ahead.max() <= SHORT_MM / 5 else None


def _size(cubic: FloatArray) -> float:
    return float(steps(cubic).sum())


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
        kept = without_short_spans(edge)
        return kept if kept is None else with_longer_spans(kept)
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
            cubics[0, 1] += np.array(start) - cubics[0, 0]
            cubics[0, 0] = start
            if end:
                cubics[-1, 2] += np.array(end) - cubics[-1, 3]
                cubics[-1, 3] = end
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
