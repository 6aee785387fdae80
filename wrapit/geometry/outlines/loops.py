"""Closed planar outlines made of exact curves, and what moves, turns round and makes them.

They are what is cut, drawn and extruded.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias, overload

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, straight
from wrapit.geometry.polyline import signed_area

Point: TypeAlias = tuple[float, float]

# How arcs become cubics: pieces of 7.5° lie within 1e-10 of the radius, far below what any file keeps.
ARC_PIECE_RAD = math.pi / 24
# A polygon of this tolerance tells left from right for outlines of a tenth of a millimetre and more.
ORIENTATION_MM = 0.02
# What counts as nothing: a radius below the first makes no arc, a gap below the second no edge.
SAME_MM, NOTHING_MM = 1e-6, 1e-9
_QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))  # cosine and sine of right angles


@dataclass(frozen=True)
class Line:
    """A straight edge."""

    start: Point
    end: Point

    def sampled(self, tolerance_mm: float) -> FloatArray:  # noqa: ARG002  a line is exact
        """Both ends, (2, 2)."""
        return np.array([self.start, self.end])


@dataclass(frozen=True)
class Arc:
    """A circular edge; `sweep_rad` is positive counter-clockwise, ±2π for a full circle."""

    centre: Point
    radius_mm: float
    start_rad: float
    sweep_rad: float

    @property
    def start(self) -> Point:
        """First point."""
        return self._at(self.start_rad)

    @property
    def end(self) -> Point:
        """Last point."""
        return self._at(self.start_rad + self.sweep_rad)

    def sampled(self, tolerance_mm: float) -> FloatArray:
        """Points (n, 2) no farther from the arc than the tolerance."""
        step = 2 * math.acos(max(0.0, 1 - min(1.0, tolerance_mm / self.radius_mm)))
        count = max(2, math.ceil(abs(self.sweep_rad) / max(step, 1e-3)))
        angles = self.start_rad + self.sweep_rad * np.linspace(0, 1, count + 1)
        return np.array(self.centre) + self.radius_mm * np.column_stack([np.cos(angles), np.sin(angles)])

    def _at(self, angle: float) -> Point:
        return (
            self.centre[0] + self.radius_mm * math.cos(angle),
            self.centre[1] + self.radius_mm * math.sin(angle),
        )


Edge: TypeAlias = Line | Arc | BezierChain


@dataclass(frozen=True)
class Loop:
    """A closed outline: each edge starts where the one before ends, the last where the first starts."""

    edges: tuple[Edge, ...]

    def sampled(self, tolerance_mm: float) -> FloatArray:
        """A polygon (n, 2), not repeating its first point, about `tolerance_mm` from the outline."""
        step = max(4 * tolerance_mm, 0.02)
        parts = [
            edge.sampled(step)[:-1] if isinstance(edge, BezierChain) else edge.sampled(tolerance_mm)[:-1]
            for edge in self.edges
        ]
        return np.concatenate(parts)


@dataclass(frozen=True)
class Region:
    """A flat piece: one outer loop and its holes."""

    outer: Loop
    holes: tuple[Loop, ...] = ()


def point_of(xy: Sequence[float] | FloatArray) -> Point:
    """The point in plain numbers."""
    return float(xy[0]), float(xy[1])


def as_chain(edge: Edge, piece_rad: float = ARC_PIECE_RAD) -> BezierChain:
    """The edge as cubics; an arc as equal pieces of at most `piece_rad`.

    A cubic strays outward from an arc of θ by 2/27 · sin⁶(θ/4) / cos²(θ/4) of its radius: 1e-10 for 7.5°,
    7e-8 for 22.5°, 2e-5 for 60°.
    """
    if isinstance(edge, BezierChain):
        return edge
    if isinstance(edge, Line):
        return straight(edge.start, edge.end)
    count = max(1, math.ceil(abs(edge.sweep_rad) / piece_rad - 1e-9))
    angles = edge.start_rad + edge.sweep_rad * np.linspace(0, 1, count + 1)
    radial = np.column_stack([np.cos(angles), np.sin(angles)])
    left = np.column_stack([-np.sin(angles), np.cos(angles)])
    unit_cubics = arc_cubics(radial, left, 1.0, edge.sweep_rad / count)
    return BezierChain(np.array(edge.centre) + edge.radius_mm * unit_cubics)


def arc_cubics(points: FloatArray, tangents: FloatArray, radius_mm: float, step_rad: float) -> FloatArray:
    """Cubics (n, 4, 2) between points (n + 1, 2) on a circle, each `step_rad` from the one before.

    Their handles are 4/3 · tan(step / 4) of the radius long, so that their middles lie on the circle;
    `tangents` (n + 1, 2) are unit vectors, to the left of the radius where `step_rad` keeps its sign.
    """
    handles = tangents * (4 / 3 * math.tan(step_rad / 4) * radius_mm)
    a, b = points[:-1], points[1:]
    return np.stack([a, a + handles[:-1], b - handles[1:], b], axis=1)


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
    return Loop(tuple(reversed_edge(edge) for edge in reversed(loop.edges)))


def turns_left(loop: Loop) -> bool:
    """Whether the outline runs counter-clockwise."""
    return signed_area(loop.sampled(ORIENTATION_MM)) > 0


def oriented(region: Region) -> Region:
    """The same region, its outer loop counter-clockwise and its holes clockwise."""
    outer = region.outer if turns_left(region.outer) else reversed_loop(region.outer)
    holes = tuple(reversed_loop(hole) if turns_left(hole) else hole for hole in region.holes)
    return Region(outer, holes)


def circle(centre: Point, radius_mm: float) -> Loop:
    """A full circle, counter-clockwise."""
    return Loop((Arc(centre, radius_mm, 0.0, math.tau),))


def is_circle(edges: Sequence[Edge]) -> bool:
    """Whether this is one full circle."""
    return len(edges) == 1 and isinstance(edges[0], Arc) and abs(abs(edges[0].sweep_rad) - math.tau) < 1e-9


def rounded_rectangle(left: float, bottom: float, right: float, top: float, radius_mm: float) -> Loop:
    """A rectangle with round corners, counter-clockwise from its lower left; sharp if the radius is zero.

    The radius is cut to half the shorter side.
    """
    radius = min(radius_mm, (right - left) / 2, (top - bottom) / 2)
    if radius < SAME_MM:
        corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
        return Loop(tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))
    arcs = [
        Arc((right - radius, bottom + radius), radius, -math.pi / 2, math.pi / 2),
        Arc((right - radius, top - radius), radius, 0.0, math.pi / 2),
        Arc((left + radius, top - radius), radius, math.pi / 2, math.pi / 2),
        Arc((left + radius, bottom + radius), radius, math.pi, math.pi / 2),
    ]
    edges: list[Edge] = []
    for before, arc in zip(arcs[-1:] + arcs[:-1], arcs, strict=True):
        if math.dist(before.end, arc.start) > NOTHING_MM:
            edges.append(Line(before.end, arc.start))
        edges.append(arc)
    return Loop(tuple(edges))


@overload
def reversed_edge(edge: Line | Arc) -> Line | Arc: ...


@overload
def reversed_edge(edge: Edge) -> Edge: ...


def reversed_edge(edge: Edge) -> Edge:
    """The same edge travelled the other way."""
    if isinstance(edge, Line):
        return Line(edge.end, edge.start)
    if isinstance(edge, Arc):
        return Arc(edge.centre, edge.radius_mm, edge.start_rad + edge.sweep_rad, -edge.sweep_rad)
    return edge.reversed()
