"""The skin of a round wire: exact circles carried along a spine, closed to a solid."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.errors import KernelError
from wrapit.geometry import FloatArray, unit
from wrapit.kernel.round_wires.spines import Spine

# Where do faces end? At a jump of curvature that no smooth surface follows, after so many spans, or where
# two spans differ so much in length: programs integrate volumes over a face with few points. Over 37 wires
# the volume errs by 1.0e-4 at most with 8 spans, 1.6e-4 with 12 and 5.0e-4 with 16; without the ratio eight
# of them come out wrong by more than 1e-3.
FACE_SPANS = 12
SPAN_RATIO = 5.0
# Within what are knots inside a face smoothed away? With 1e-5 there are 4 % more faces, with 1e-3 16 % fewer,
# and the volume of a wire errs by up to 6e-4; it is far below what is printed or drawn.
SMOOTH_MM = 1e-4
# Poles of a circle of radius 1 as two rational cubic halves.
_RING = np.array([(1, 0), (1, 2), (-1, 2), (-1, 0), (-1, -2), (1, -2), (1, 0)], dtype=float)
_WEIGHTS = np.array([1, 1 / 3, 1 / 3, 1, 1 / 3, 1 / 3, 1])
# A knot in the middle of each half changes no point of it, but makes programs integrate with twice the
# points: over 25 wires the median error of the volume is 1.9e-5 instead of 3.4e-5.
_MIDDLES = (0.5, 1.5)


def skin(spine: Spine, span: int, radius: float) -> Any:
    """The round surface along one smooth span; ends at corners are cut on the mitre, at folds square."""
    nodes = spine.spans[span]
    points = spine.points(nodes)
    slopes, _ = spine.slopes_along(nodes)
    level, upright = spine.frames(nodes)
    last_level, last_upright = spine.frames(nodes[-1:], before=True)
    level[-1], upright[-1] = last_level[0], last_upright[0]
    arm = next(arm for arm in spine.arms if span in arm)
    if span > arm[0]:
        level[0] = _mitre(spine, nodes[:1])
    if span < arm[-1]:
        level[-1] = _mitre(spine, nodes[-1:])
    # The frame's change on both sides of each node: where the curvature jumps, the skin's speed does.
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


def _changes(spine: Spine, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean rate of change of the frame's vectors between two parameters, (m, 3) each."""
    first, last = spine.frames(low), spine.frames(high, before=True)
    width = (high - low)[:, None]
    return (last[0] - first[0]) / width, (last[1] - first[1]) / width


def _bezier_poles(
    nodes: FloatArray, points: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> FloatArray:
    """Poles of cubics between nodes (inner knots triple): derivatives after each node and before the next."""
    third = (np.diff(nodes) / 3)[:, None]
    cubics = np.stack([points[:-1], points[:-1] + third * leaving, points[1:] - third * arriving], axis=1)
    return np.concatenate([cubics.reshape(-1, 3), points[-1:]])


def _mitre(spine: Spine, node: FloatArray) -> FloatArray:
    """The level vector common to both spans at a corner, longer by 1 / cos of half the bend."""
    before, after = spine.frames(node, before=True)[0][0], spine.frames(node)[0][0]
    middle = unit(before + after)
    return middle / float(middle @ after)


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
    around, around_counts = TColStd_Array1OfReal(1, 3), TColStd_Array1OfInteger(1, 3)
    for index, count in enumerate((4, 3, 4), start=1):
        around.SetValue(index, float(index - 1))
        around_counts.SetValue(index, count)
    surface = Geom_BSplineSurface(
        points, weights, along, around, along_counts, around_counts, 3, 3, False, False
    )
    for middle in _MIDDLES:
        surface.InsertVKnot(middle, 1, 1e-12)
    return surface


def _smooth(surface: Any) -> None:
    """Takes out the knots along that it doesn't need; what stays triple is a jump of curvature."""
    for knot in range(surface.NbUKnots() - 1, 1, -1):
        if not surface.RemoveUKnot(knot, 1, SMOOTH_MM):
            surface.RemoveUKnot(knot, 2, SMOOTH_MM)


def _face_cuts(skin: Any) -> list[float]:
    """Where faces end along a skin: see `FACE_SPANS`."""
    smooth = skin.Copy()
    _smooth(smooth)
    knots = [smooth.UKnot(i) for i in range(1, smooth.NbUKnots() + 1)]
    cuts, first = [knots[0]], 0
    for index in range(1, len(knots) - 1):
        widths = np.diff(knots[first : index + 2])
        jumps = smooth.UMultiplicity(index + 1) == smooth.UDegree()
        if jumps or index - first == FACE_SPANS or widths.max() > SPAN_RATIO * widths.min():
            cuts.append(knots[index])
            first = index
    return [*cuts, knots[-1]]


def capped(skins: Sequence[Any]) -> Any:
    """The solid inside the skins and two flat ends; each skin in upper and lower halves of few long faces."""
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
        for low, high in itertools.pairwise(_face_cuts(skin)):
            stretch = skin.Copy()
            stretch.Segment(low, high, 0.0, 2.0)
            # Smoothed as one, so that the edges of both halves stay the same.
            _smooth(stretch)
            for half in (0.0, 1.0):
                patch = stretch.Copy()
                patch.Segment(low, high, half, half + 1.0)
                sewing.Add(BRepBuilderAPI_MakeFace(patch, 1e-7).Face())
    for circle in (skins[0].UIso(skins[0].UKnot(1)), skins[-1].UIso(skins[-1].UKnot(skins[-1].NbUKnots()))):
        rim = BRepBuilderAPI_MakeWire()
        for half in (0.0, 1.0):
            rim.Add(BRepBuilderAPI_MakeEdge(circle, half, half + 1.0).Edge())
        sewing.Add(BRepBuilderAPI_MakeFace(rim.Wire(), True).Face())
    sewing.Perform()
    shell = sewing.SewedShape()
    if shell.IsNull() or shell.ShapeType() != TopAbs_SHELL:
        raise KernelError("the wire's skin doesn't close")
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(shell)).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid


def together(solids: Sequence[Any]) -> Any:
    """The one solid, or several as one shape, which lie in each other where they meet."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    if len(solids) == 1:
        return solids[0]
    builder, shape = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(shape)
    for solid in solids:
        builder.Add(shape, solid)
    return shape
