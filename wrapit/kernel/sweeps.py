"""Round wires along planar splines, with heights: exact centreline and solid.

The solid's skin is one spline surface for each smooth span: every pole of a circle (a rational quadratic
spline, exact) travels along its own cubic spline. No approximation by the kernel is involved.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.errors import KernelError
from wrapit.geometry import BSpline, FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.kernel.checks import is_valid, volume_mm3
from wrapit.kernel.guard import guarded

TURN_STEP_RAD = 0.25
LIFT_STEP_MM = 0.6
LIFT_ROUNDING = 0.6  # of the diameter
_LIFT_SAMPLES = 6  # in each rounding
VOLUME_TOLERANCE = 1e-3
FACE_SPANS = 4
SPAN_RATIO = 2.0
SMOOTH_MM = 1e-4  # knots inside a face are smoothed away within this, to leave surfaces with tangents
TIGHT = 0.98  # a wire bent to less than its own radius can't be a valid solid; the bend itself is reported
# Poles of a circle of radius 1 as four rational quadratic arcs.
_RING = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)], dtype=float)
_WEIGHTS = np.array([1, math.sqrt(0.5)] * 4 + [1])


def round_wire(
    centreline: BSpline, diameter_mm: float, lifts: Sequence[tuple[float, float]], name: str
) -> tuple[Any, Any]:
    """The solid round wire and its centreline as one exact B-spline edge.

    `lifts` are heights (at_mm, z_mm) along the planar length with straight ramps between, whose kinks are
    rounded upwards; x and y of the centreline are those of the spline, exactly. Raises KernelError
    naming the wire.
    """
    with guarded("making the round wire", name):
        spine = _Spine(centreline, tuple(lifts), diameter_mm)
        skins = [_skin(spine, index, diameter_mm / 2) for index in range(len(spine.spans))]
        solid = _capped(skins, centreline.breaks)
        if spine.sharpest_per_mm * diameter_mm / 2 < TIGHT:
            _check(solid, math.pi / 4 * diameter_mm**2 * spine.length_mm, name)
        return solid, spine.edge()


def _check(solid: Any, expected_mm3: float, name: str) -> None:
    got = volume_mm3(solid)
    if abs(got - expected_mm3) > VOLUME_TOLERANCE * expected_mm3:
        raise KernelError(f"the round wire has {got:.2f} mm³ instead of {expected_mm3:.2f} mm³", name)
    if not is_valid(solid):
        raise KernelError("the round wire is not a valid solid", name, "make its tightest bend wider")


@dataclass(frozen=True, eq=False)
class _Spine:
    """The centreline in space, and the parameters at which its frame is taken."""

    spline: BSpline
    lifts: tuple[tuple[float, float], ...]
    diameter_mm: float

    @cached_property
    def _lengths(self) -> ArcLength:
        return ArcLength(self.spline)

    @cached_property
    def _height(self) -> Any:
        """Height by planar length, nowhere below `lifts`, its kinks rounded over about a diameter."""
        from scipy.interpolate import PchipInterpolator
        from scipy.ndimage import maximum_filter1d, uniform_filter1d

        if not self.lifts:
            return None
        total, reach = self._lengths.total_mm, LIFT_ROUNDING * self.diameter_mm
        at = np.linspace(0.0, total, 1 + max(8, math.ceil(total / reach * _LIFT_SAMPLES)))
        sharp = np.interp(at, *np.array(self.lifts).T)
        # The mean over a window of the maximum over the same window is never below the value itself.
        smooth = maximum_filter1d(sharp, 2 * _LIFT_SAMPLES + 1, mode="nearest")
        for _ in range(2):
            smooth = uniform_filter1d(smooth, _LIFT_SAMPLES + 1, mode="nearest")
        every = np.arange(len(at)) % (_LIFT_SAMPLES // 2) == 0
        changing = np.abs(np.gradient(smooth)) > 1e-9
        near = maximum_filter1d(changing.astype(np.uint8), _LIFT_SAMPLES + 1) > 0
        keep = every & near
        keep[[0, -1]] = True
        return PchipInterpolator(at[keep], smooth[keep])

    @cached_property
    def spans(self) -> list[FloatArray]:
        """For each smooth span the parameters of its nodes; spans end at corners."""
        counts = np.unique(self.spline.knots, return_counts=True)
        corners = [float(u) for u, count in zip(*counts, strict=True) if count == self.spline.degree]
        return [
            np.array([u for u in self._nodes if a <= u <= b])
            for a, b in itertools.pairwise([self.spline.domain[0], *corners, self.spline.domain[1]])
        ]

    @cached_property
    def _nodes(self) -> list[float]:
        """Breaks of the spline and of the heights, with so many between that the wire turns little."""
        breaks = set(self.spline.breaks.tolist())
        if self._height is not None:
            breaks |= set(self._lengths.parameter(self._height.x[1:-1]).tolist())
        ordered = sorted(breaks)
        apart = [a for a, b in itertools.pairwise(ordered) if b - a > 1e-7]
        nodes = []
        for a, b in itertools.pairwise([*apart, ordered[-1]]):
            inner = a + (b - a) * np.linspace(0.02, 0.98, 9)
            speed = np.linalg.norm(self.spline.derivative(inner), axis=1) * (b - a)
            turning = float(np.abs(self.spline.curvature(inner) * speed).max())
            rising = 0.0
            if self._height is not None and np.ptp(self._height(self._lengths.length(inner))) > 1e-6:
                rising = float(speed.max()) / LIFT_STEP_MM
            count = max(1, math.ceil(turning / TURN_STEP_RAD), math.ceil(rising))
            nodes += (a + (b - a) * np.arange(count) / count).tolist()
        return [*nodes, ordered[-1]]

    @cached_property
    def sharpest_per_mm(self) -> float:
        """Largest curvature in the plane, at fine steps."""
        at = self._lengths.stations(0.02)
        return float(np.abs(self.spline.curvature(self._lengths.parameter(at))).max())

    @cached_property
    def length_mm(self) -> float:
        """Length in space."""
        if self._height is None:
            return self._lengths.total_mm
        at = np.linspace(0.0, self._lengths.total_mm, 1 + math.ceil(self._lengths.total_mm / 0.01))
        return float(np.hypot(np.diff(at), np.diff(self._height(at))).sum())

    def points(self, u: FloatArray) -> FloatArray:
        """Points in space (m, 3)."""
        z = np.zeros(len(u)) if self._height is None else self._height(self._lengths.length(u))
        return np.column_stack([self.spline.at(u), z])

    def slopes(self, u: FloatArray, *, before: bool = False) -> FloatArray:
        """Derivatives in space (m, 3); at a corner those after it, or before it."""
        shifted = self._nudged(u, before)
        flat = self.spline.derivative(shifted)
        if self._height is None:
            return np.column_stack([flat, np.zeros(len(u))])
        rise = self._height.derivative()(self._lengths.length(shifted))
        return np.column_stack([flat, rise * np.linalg.norm(flat, axis=1)])

    def frames(self, u: FloatArray, *, before: bool = False) -> tuple[FloatArray, FloatArray]:
        """Unit vectors across the wire, level and upright, (m, 3) each."""
        along = unit(self.slopes(u, before=before))
        level = unit(np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(u))]))
        return level, np.cross(along, level)

    def edge(self) -> Any:
        """The exact centreline as an edge; corners stay corners."""
        from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge

        from wrapit.kernel.edges import spline_curve

        if self._height is None:
            return BRepBuilderAPI_MakeEdge(spline_curve(self.spline)).Edge()
        poles, knots = [], []
        for index, nodes in enumerate(self.spans):
            curve = _hermite_poles(nodes, self.points(nodes), *self._ends(nodes))
            poles.append(curve if index == 0 else curve[1:])
            knots += [nodes[0]] * (4 if index == 0 else 3) + np.repeat(nodes[1:-1], 2).tolist()
        every = np.concatenate(poles)
        knots += [self.spline.domain[1]] * 4
        flat = BSpline(3, every[:, :2], np.array(knots))
        return BRepBuilderAPI_MakeEdge(spline_curve(flat, every[:, 2])).Edge()

    def _ends(self, nodes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Derivatives leaving and arriving at each node of a span."""
        leaving, arriving = self.slopes(nodes), self.slopes(nodes, before=True)
        leaving[-1], arriving[0] = arriving[-1], leaving[0]
        return leaving, leaving

    def _nudged(self, u: FloatArray, before: bool) -> FloatArray:
        low, high = self.spline.domain
        shift = 1e-9 * (high - low)
        return np.clip(u - shift if before else u + shift, low, high - shift)


def _hermite_poles(
    nodes: FloatArray, points: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> FloatArray:
    """Poles of the cubic spline, inner knots double, with these points and derivatives at the nodes."""
    third = (np.diff(nodes) / 3)[:, None]
    inner = np.stack([points[:-1] + third * leaving[:-1], points[1:] - third * arriving[1:]], axis=1)
    return np.concatenate([points[:1], inner.reshape(-1, 3), points[-1:]])


def _skin(spine: _Spine, span: int, radius: float) -> Any:
    """The round surface along one smooth span; where it meets the next at a corner, cut on the mitre."""
    nodes = spine.spans[span]
    points = spine.points(nodes)
    slopes, _ = spine._ends(nodes)
    level, upright = spine.frames(nodes)
    last_level, last_upright = spine.frames(nodes[-1:], before=True)
    level[-1], upright[-1] = last_level[0], last_upright[0]
    if span > 0:
        level[0] = _mitre(spine, nodes[:1])
    if span < len(spine.spans) - 1:
        level[-1] = _mitre(spine, nodes[-1:])
    # The frame's change on both sides of each node: at a break the curvature may jump, and with it the skin's speed.
    steps = np.diff(nodes) * 1e-3
    after = _changes(spine, nodes[:-1], nodes[:-1] + steps)
    earlier = _changes(spine, nodes[1:] - steps, nodes[1:])
    columns = []
    for a, b in _RING * radius:
        leaving, arriving = (
            slope + a * level_change + b * upright_change
            for slope, (level_change, upright_change) in ((slopes[:-1], after), (slopes[1:], earlier))
        )
        columns.append(_bezier_poles(nodes, points + a * level + b * upright, leaving, arriving))
    return _surface(np.stack(columns, axis=1), nodes)


def _changes(spine: _Spine, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean rate of change of the frame's vectors between two parameters, (m, 3) each."""
    first, last = spine.frames(low), spine.frames(high, before=True)
    width = (high - low)[:, None]
    return (last[0] - first[0]) / width, (last[1] - first[1]) / width


def _bezier_poles(
    nodes: FloatArray, points: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> FloatArray:
    """Poles of cubics between the nodes (inner knots triple): derivatives after each node, and before the next."""
    third = (np.diff(nodes) / 3)[:, None]
    cubics = np.stack([points[:-1], points[:-1] + third * leaving, points[1:] - third * arriving], axis=1)
    return np.concatenate([cubics.reshape(-1, 3), points[-1:]])


def _mitre(spine: _Spine, node: FloatArray) -> FloatArray:
    """The level vector common to both spans at a corner, longer by 1 / cos of half the bend."""
    before, after = spine.frames(node, before=True)[0][0], spine.frames(node)[0][0]
    middle = unit(before + after)
    return middle / max(float(middle @ after), 0.2)


def _surface(poles: FloatArray, nodes: FloatArray) -> Any:
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array2OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal, TColStd_Array2OfReal

    rows, ring = poles.shape[:2]
    points, weights = TColgp_Array2OfPnt(1, rows, 1, ring), TColStd_Array2OfReal(1, rows, 1, ring)
    for i in range(rows):
        for j in range(ring):
            points.SetValue(i + 1, j + 1, gp_Pnt(*poles[i, j].tolist()))
            weights.SetValue(i + 1, j + 1, float(_WEIGHTS[j]))
    along, along_counts = TColStd_Array1OfReal(1, len(nodes)), TColStd_Array1OfInteger(1, len(nodes))
    for index, u in enumerate(nodes.tolist(), start=1):
        along.SetValue(index, u)
        along_counts.SetValue(index, 4 if index in (1, len(nodes)) else 3)
    around, around_counts = TColStd_Array1OfReal(1, 5), TColStd_Array1OfInteger(1, 5)
    for index in range(1, 6):
        around.SetValue(index, float(index - 1))
        around_counts.SetValue(index, 3 if index in (1, 5) else 2)
    return Geom_BSplineSurface(
        points, weights, along, around, along_counts, around_counts, 3, 2, False, False
    )


def _face_cuts(knots: Sequence[float], breaks: FloatArray) -> list[float]:
    """Where faces end: at breaks of the centreline, after a few spans, where spans change much in length."""
    cuts, first = [knots[0]], 0
    for index in range(1, len(knots) - 1):
        widths = np.diff(knots[first : index + 2])
        breaking = np.abs(breaks - knots[index]).min() < 1e-9 * knots[-1]
        if breaking or index - first == FACE_SPANS or widths.max() > SPAN_RATIO * widths.min():
            cuts.append(knots[index])
            first = index
    return [*cuts, knots[-1]]


def _capped(skins: Sequence[Any], breaks: FloatArray) -> Any:
    """The solid inside the skins and two flat ends; the skins in quarters of a few spans.

    Programs integrate volumes over a face with few points: over one face, or over faces with long and short
    spans, the volume of a round wire came out wrong by 0.7 %, over these faces by 1e-5.
    """
    from OCP.BRepBuilderAPI import (
        BRepBuilderAPI_MakeEdge,
        BRepBuilderAPI_MakeFace,
        BRepBuilderAPI_MakeSolid,
        BRepBuilderAPI_MakeWire,
        BRepBuilderAPI_Sewing,
    )
    from OCP.BRepLib import BRepLib
    from OCP.TopAbs import TopAbs_SHELL
    from OCP.TopoDS import TopoDS

    sewing = BRepBuilderAPI_Sewing(1e-6)
    for skin in skins:
        knots = [skin.UKnot(i) for i in range(1, skin.NbUKnots() + 1)]
        cuts = _face_cuts(knots, breaks)
        for (low, high), quarter in itertools.product(itertools.pairwise(cuts), range(4)):
            patch = skin.Copy()
            patch.Segment(low, high, float(quarter), float(quarter + 1))
            for knot in range(patch.NbUKnots() - 1, 1, -1):
                patch.RemoveUKnot(knot, 2, SMOOTH_MM)
            sewing.Add(BRepBuilderAPI_MakeFace(patch, 1e-7).Face())
    for circle in (skins[0].UIso(skins[0].UKnot(1)), skins[-1].UIso(skins[-1].UKnot(skins[-1].NbUKnots()))):
        rim = BRepBuilderAPI_MakeWire()
        for quarter in range(4):
            rim.Add(BRepBuilderAPI_MakeEdge(circle, float(quarter), float(quarter + 1)).Edge())
        sewing.Add(BRepBuilderAPI_MakeFace(rim.Wire(), True).Face())
    sewing.Perform()
    shell = sewing.SewedShape()
    if shell.IsNull() or shell.ShapeType() != TopAbs_SHELL:
        raise KernelError("the wire's skin doesn't close")
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(shell)).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid
