"""Planar curves: Béziers, exact B-splines, fitting, arc length, curvature."""

from wrapit.geometry.arrays import FloatArray, IntArray, locked, unit
from wrapit.geometry.bezier import BezierChain, joined, straight
from wrapit.geometry.bspline import BSpline, from_chain
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Loop, Region

__all__ = [
    "Arc",
    "BSpline",
    "BezierChain",
    "Edge",
    "FloatArray",
    "IntArray",
    "Line",
    "Loop",
    "Region",
    "from_chain",
    "joined",
    "locked",
    "straight",
    "unit",
]
