"""Exact edges moved, turned by right angles, and travelled the other way."""

from __future__ import annotations

import math

import numpy as np

from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Loop, Point, Region

_QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


def moved(edge: Edge, quarters: int, shift: Point) -> Edge:
    """The edge turned about the origin by `quarters` right angles to the left, then shifted."""
    if isinstance(edge, Line):
        return Line(moved_point(edge.start, quarters, shift), moved_point(edge.end, quarters, shift))
    if isinstance(edge, Arc):
        start_rad = edge.start_rad + quarters * math.pi / 2
        return Arc(moved_point(edge.centre, quarters, shift), edge.radius_mm, start_rad, edge.sweep_rad)
    cos, sin = _QUARTERS[quarters % 4]
    return edge.mapped(np.array([[cos, -sin], [sin, cos]]), shift)


def moved_point(point: Point, quarters: int, shift: Point) -> Point:
    """A point turned and shifted like `moved` does it."""
    cos, sin = _QUARTERS[quarters % 4]
    return cos * point[0] - sin * point[1] + shift[0], sin * point[0] + cos * point[1] + shift[1]


def reversed_loop(loop: Loop) -> Loop:
    """The same outline travelled the other way."""
    return Loop(tuple(_reversed(edge) for edge in reversed(loop.edges)))


def turns_left(loop: Loop) -> bool:
    """Whether the outline runs counter-clockwise."""
    x, y = loop.sampled(0.02).T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) > 0


def oriented(region: Region) -> Region:
    """The same region, its outer loop counter-clockwise and its holes clockwise."""
    outer = region.outer if turns_left(region.outer) else reversed_loop(region.outer)
    holes = tuple(reversed_loop(hole) if turns_left(hole) else hole for hole in region.holes)
    return Region(outer, holes)


def circle(centre: Point, radius_mm: float) -> Loop:
    """A full circle, counter-clockwise."""
    return Loop((Arc(centre, radius_mm, 0.0, math.tau),))


def rounded_rectangle(left: float, bottom: float, right: float, top: float, radius_mm: float) -> Loop:
    """A rectangle with round corners (sharp ones if the radius is zero), counter-clockwise."""
    if radius_mm < 1e-6:
        corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
        return Loop(tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))
    radius = min(radius_mm, (right - left) / 2, (top - bottom) / 2)
    arcs = [
        Arc((right - radius, bottom + radius), radius, -math.pi / 2, math.pi / 2),
        Arc((right - radius, top - radius), radius, 0.0, math.pi / 2),
        Arc((left + radius, top - radius), radius, math.pi / 2, math.pi / 2),
        Arc((left + radius, bottom + radius), radius, math.pi, math.pi / 2),
    ]
    edges: list[Edge] = []
    for before, arc in zip(arcs[-1:] + arcs[:-1], arcs, strict=True):
        if math.dist(before.end, arc.start) > 1e-9:
            edges.append(Line(before.end, arc.start))
        edges.append(arc)
    return Loop(tuple(edges))


def _reversed(edge: Edge) -> Edge:
    if isinstance(edge, Line):
        return Line(edge.end, edge.start)
    if isinstance(edge, Arc):
        return Arc(edge.centre, edge.radius_mm, edge.start_rad + edge.sweep_rad, -edge.sweep_rad)
    return BezierChain(edge.points[::-1, ::-1])
