"""The centreline of a wire in space: a planar spline with heights, and frames along it."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.geometry import BSpline, FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.kernel.round_wires.heights import smooth_heights

# How far may a wire turn between two circles of its skin? Over 37 wires the volume errs by 1.6e-4 at most at
# 0.25 and by 2.7e-4 at 0.5; less makes no difference.
TURN_STEP_RAD = 0.25
# How far may it rise along? Half as far makes 20 % more faces, twice as far errs by 6.6e-4 of the volume.
LIFT_STEP_MM = 0.6
# Where a break of the heights lies nearer than this to one of the spline, it is that one: patches are sewn
# within 1e-6 mm, and a lift that began 2e-7 mm beside a joint left every such wire without a solid. From 1e-6
# on all have one.
NODE_GAP_MM = 1e-5
# From where on is a corner a fold, which no mitre closes? Beyond, a mitre is 5 radii long.
FOLD_RAD = 2 * math.acos(0.2)


@dataclass(frozen=True, eq=False)
class Spine:
    """The centreline in space, and the parameters at which its frame is taken."""

    spline: BSpline
    lifts: tuple[tuple[float, float], ...]
    diameter_mm: float

    @cached_property
    def _lengths(self) -> ArcLength:
        return ArcLength(self.spline)

    @cached_property
    def _height(self) -> Any:
        """Height by planar length; None where the wire lies flat."""
        if not self.lifts:
            return None
        return smooth_heights(self.lifts, self._lengths.total_mm, self.diameter_mm)

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
    def arms(self) -> list[range]:
        """The spans between one fold and the next: there the wire is laid back over itself."""
        folds = [index for index in range(1, len(self.spans)) if self._folds(index)]
        return [range(a, b) for a, b in itertools.pairwise([0, *folds, len(self.spans)])]

    def _folds(self, span: int) -> bool:
        corner = self.spans[span][:1]
        before, after = unit(self.slopes(corner, before=True))[0], unit(self.slopes(corner))[0]
        return float(before @ after) < math.cos(FOLD_RAD)

    @cached_property
    def breaks(self) -> FloatArray:
        """Parameters where the curvature may jump: breaks of the spline and of the heights."""
        if self._height is None:
            return self.spline.breaks
        joints_mm = self._lengths.length(self.spline.breaks)
        lifts_mm = self._height.x[1:-1]
        after = np.searchsorted(joints_mm, lifts_mm).clip(1, len(joints_mm) - 1)
        gaps_mm = np.abs(lifts_mm - [joints_mm[after - 1], joints_mm[after]]).min(axis=0)
        return np.union1d(self.spline.breaks, self._lengths.parameter(lifts_mm[gaps_mm > NODE_GAP_MM]))

    @cached_property
    def _nodes(self) -> list[float]:
        """The breaks, with so many parameters between that the wire turns little."""
        ordered = self.breaks.tolist()
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
            curve = _hermite_poles(nodes, self.points(nodes), *self.slopes_along(nodes))
            poles.append(curve if index == 0 else curve[1:])
            knots += [nodes[0]] * (4 if index == 0 else 3) + np.repeat(nodes[1:-1], 2).tolist()
        every = np.concatenate(poles)
        knots += [self.spline.domain[1]] * 4
        flat = BSpline(3, every[:, :2], np.array(knots))
        return BRepBuilderAPI_MakeEdge(spline_curve(flat, every[:, 2])).Edge()

    def slopes_along(self, nodes: FloatArray) -> tuple[FloatArray, FloatArray]:
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
