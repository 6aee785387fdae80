"""Closed planar outlines made of exact curves: what is cut, drawn and extruded."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain

Point: TypeAlias = tuple[float, float]


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
