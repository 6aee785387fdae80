"""Exact edges, loops and faces from planar geometry."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.errors import KernelError
from wrapit.geometry import Arc, BezierChain, BSpline, Edge, FloatArray, Line, Loop, Region
from wrapit.geometry.outlines.loops import point_of
from wrapit.geometry.outlines.polygons import loop_area_mm2
from wrapit.kernel.runs import RUN_TOLERANCE_MM, between_corners, smooth_runs, swept_area_mm2


def spline_curve(spline: BSpline, z: FloatArray | float = 0.0) -> Any:
    """The planar spline as a Geom_BSplineCurve with the same poles and knots; `z` are the poles' heights."""
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    heights = np.broadcast_to(z, len(spline.poles))
    poles = TColgp_Array1OfPnt(1, len(spline.poles))
    for index, ((x, y), height) in enumerate(zip(spline.poles, heights, strict=True), start=1):
        poles.SetValue(index, gp_Pnt(float(x), float(y), float(height)))
    values, counts = np.unique(spline.knots, return_counts=True)
    knots, multiplicities = TColStd_Array1OfReal(1, len(values)), TColStd_Array1OfInteger(1, len(values))
    for index, (value, count) in enumerate(zip(values, counts, strict=True), start=1):
        knots.SetValue(index, float(value))
        multiplicities.SetValue(index, int(count))
    return Geom_BSplineCurve(poles, knots, multiplicities, spline.degree)


@dataclass(frozen=True, eq=False)
class Followed:
    """A loop as the kernel gets it: its lines and arcs, and curves as few smooth runs."""

    loop: Loop
    parts: tuple[Line | Arc | BSpline, ...]

    @property
    def area_mm2(self) -> float:
        """Exact signed area inside, positive counter-clockwise."""
        runs = [part for part in self.parts if isinstance(part, BSpline)]
        straight = Loop(tuple(part for part in self.parts if not isinstance(part, BSpline)))
        return loop_area_mm2(straight) + sum(map(swept_area_mm2, runs))


def followed(loop: Loop, slack_mm: float = RUN_TOLERANCE_MM) -> Followed:
    """The loop with its curves as smooth runs within the slack, divided at corners."""
    return Followed(loop, tuple(part for edge in loop.edges for part in _parts(edge, slack_mm)))


def loop_edges(loop: Loop, z: float = 0.0, slack_mm: float = RUN_TOLERANCE_MM) -> list[Any]:
    """The loop's edges at height z, sharing their vertices, in its order; curves as few smooth runs.

    The runs are within the slack of the curves.
    """
    return edges_of(followed(loop, slack_mm), z)


def edges_of(loop: Followed, z: float = 0.0) -> list[Any]:
    """The edges of a followed loop at height z, sharing their vertices, in its order."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
    from OCP.gp import gp_Pnt

    edges = loop.parts
    starts = [_start(edge) for edge in edges]
    vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(x, y, z)).Vertex() for x, y in starts]
    return [
        _edge(edge, z, vertices[index], vertices[(index + 1) % len(vertices)])
        for index, edge in enumerate(edges)
    ]


def wire_of(edges: Sequence[Any]) -> Any:
    """A TopoDS_Wire of edges that share vertices, in order; KernelError where they don't close."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeWire

    maker = BRepBuilderAPI_MakeWire()
    for edge in edges:
        maker.Add(edge)
    if not maker.IsDone():
        raise KernelError("an outline doesn't close")
    return maker.Wire()


def plane_face(outer: Any, holes: Sequence[Any], z: float) -> Any:
    """The flat face, facing up, between a counter-clockwise and several clockwise wires at height z."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt

    maker = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), outer, True)
    for hole in holes:
        maker.Add(hole)
    if not maker.IsDone():
        raise KernelError("an outline bounds no face")
    return maker.Face()


def region_face(region: Region, z: float = 0.0, slack_mm: float = RUN_TOLERANCE_MM) -> Any:
    """The region as a flat face at height z, facing up; its edges within the slack of the region's."""
    outer, *holes = (wire_of(edges_of(loop, z)) for loop in followed_loops(region, slack_mm))
    return plane_face(outer, holes, z)


def followed_loops(region: Region, slack_mm: float) -> list[Followed]:
    """The region's outline, counter-clockwise, then its holes, clockwise, each followed within the slack."""
    outer = followed(turned(region.outer, counter_clockwise=True), slack_mm)
    return [outer, *(followed(turned(hole, counter_clockwise=False), slack_mm) for hole in region.holes)]


def turned(loop: Loop, *, counter_clockwise: bool) -> Loop:
    """The loop running the given way round."""
    if (loop_area_mm2(loop) > 0) == counter_clockwise:
        return loop
    return Loop(tuple(_backwards(edge) for edge in reversed(loop.edges)))


def edge_start(edge: Edge) -> tuple[float, float]:
    """First point of any edge."""
    return (float(edge.start[0]), float(edge.start[1]))


def _parts(edge: Edge, slack_mm: float) -> list[Line | Arc | BSpline]:
    """What becomes of an edge of an outline: curves as smooth runs, divided at corners."""
    if not isinstance(edge, BezierChain):
        return [edge]
    return [run for smooth in between_corners(edge.points) for run in smooth_runs(smooth, slack_mm)]


def _backwards(edge: Edge) -> Edge:
    if isinstance(edge, Line):
        return Line(edge.end, edge.start)
    if isinstance(edge, Arc):
        return Arc(edge.centre, edge.radius_mm, edge.start_rad + edge.sweep_rad, -edge.sweep_rad)
    return edge.reversed()


def _edge(edge: Line | Arc | BSpline, z: float, start: Any, end: Any) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge

    if isinstance(edge, Line):
        maker = BRepBuilderAPI_MakeEdge(start, end)
    elif isinstance(edge, Arc):
        maker = BRepBuilderAPI_MakeEdge(_circle(edge, z), start, end, 0.0, abs(edge.sweep_rad))
    else:
        curve = spline_curve(edge, z)
        maker = BRepBuilderAPI_MakeEdge(curve, start, end, curve.FirstParameter(), curve.LastParameter())
    if not maker.IsDone():
        raise KernelError("an edge of an outline can't be made", _place(edge))
    return maker.Edge()


def _circle(arc: Arc, z: float) -> Any:
    """The arc's circle, seen so that the arc starts at parameter 0 and runs forwards."""
    from OCP.Geom import Geom_Circle
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    up = math.copysign(1.0, arc.sweep_rad)
    axes = gp_Ax2(
        gp_Pnt(*arc.centre, z),
        gp_Dir(0, 0, up),
        gp_Dir(math.cos(arc.start_rad), math.sin(arc.start_rad), 0),
    )
    return Geom_Circle(axes, arc.radius_mm)


def _start(edge: Line | Arc | BSpline) -> tuple[float, float]:
    return point_of(edge.poles[0]) if isinstance(edge, BSpline) else edge.start


def _place(edge: Line | Arc | BSpline) -> str:
    x, y = _start(edge)
    return f"at ({x:.2f}, {y:.2f}) mm"
