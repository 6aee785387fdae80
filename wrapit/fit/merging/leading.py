"""Lines are led to other ends, and what is near those comes along."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from wrapit.fit.sketch import STEP_MM, Line
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.fitting.fit import Stroke, fit
from wrapit.geometry.polyline import lengths

if TYPE_CHECKING:
    import shapely

# A moved end draws its line along: all of a line so short (in shifts), so many shifts of a longer one.
_WHOLE, _REACH = 10.0, 6.0
# Moved lines are fitted within this (mm), a tenth of what a hand can bend to.
_TOLERANCE_MM: Final = 0.02


@dataclass(frozen=True, eq=False)
class Led:
    """A line whose ends are led elsewhere: the points that it goes through then, not yet a curve."""

    start: int
    end: int
    stroke: Stroke
    origin: frozenset[int]

    @cached_property
    def shape(self) -> shapely.LineString:
        """The line as a chain of points."""
        import shapely

        return shapely.LineString(self.stroke.points)

    def fitted(self) -> Line:
        """The line with its curve."""
        return Line(self.start, self.end, fit(self.stroke, _TOLERANCE_MM), self.origin)


def led(curve: BezierChain, start: FloatArray, end: FloatArray, blur_mm: float) -> tuple[BezierChain, float]:
    """The curve led to other ends, all between by less the farther away it is; straight lines stay straight.

    And how many mm of it have moved, as for `merged`.
    """
    stroke, moved_mm = led_points(curve, start, end, blur_mm)
    return fit(stroke, _TOLERANCE_MM), moved_mm


def led_points(
    curve: BezierChain, start: FloatArray, end: FloatArray, blur_mm: float
) -> tuple[Stroke, float]:
    """What `led` fits its curve to, and how many mm have moved."""
    first, last = start - curve.start, end - curve.end
    points = curve.sampled(STEP_MM)
    along = lengths(points)
    shift = _fading(along, first)[:, None] * first + _fading(along[-1] - along, last)[:, None] * last
    moved = points + shift
    moved[0], moved[-1] = start, end
    leaving = _direction(moved) if first.any() else curve.start_tangent
    arriving = -_direction(moved[::-1]) if last.any() else curve.end_tangent
    lost = np.minimum(1.0, (shift * shift).sum(axis=1) / blur_mm**2)
    return Stroke(moved, leaving, arriving), float(np.trapezoid(lost, along))


def _fading(along: FloatArray, shift: FloatArray) -> FloatArray:
    """What share of a shift at length 0 a place at some length follows: straight lines stay straight."""
    size, whole = float(np.hypot(*shift)), max(float(along.max()), 1e-12)
    if whole <= _WHOLE * size:
        return np.asarray(1 - along / whole)
    share = np.clip(1 - along / max(_REACH * size, 1e-9), 0, 1)
    return np.asarray(share * share * (3 - 2 * share))


def _direction(points: FloatArray) -> FloatArray:
    step = points[min(2, len(points) - 1)] - points[0]
    return np.asarray(step / max(float(np.hypot(*step)), 1e-12))
