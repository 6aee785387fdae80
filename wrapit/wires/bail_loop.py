"""A round eye that a wire's end goes on into: a neck, then a loop that closes against it."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, straight
from wrapit.geometry.bezier import joined
from wrapit.geometry.outlines.loops import Arc, as_chain

GAP_MM = 0.05  # between the loop's end and the neck, so that the wire needn't climb over itself
# Which eyes are tried, and which is best: straight necks of these lengths, bent by multiples of the step.
NECKS_DIAMETERS = (0.0, 1.0, 2.0, 3.0)
NECK_STEP_RAD = math.radians(5)
LEAST_SWEEP_RAD = math.radians(270)  # out of a wider gap a chain slips
MOST_ASIDE_RAD = math.radians(60)  # the loop lies outward of the wire's end, at most so far aside
NECK_COST_RAD = math.radians(3)  # a neck longer by a diameter counts like a loop so much farther aside
SAMPLE_MM = 0.005  # chords of this length lie within 3e-6 mm of an arc of 1 mm radius


@dataclass(frozen=True, eq=False)
class Eye:
    """The curve that a wire goes on along, and the middle of its loop."""

    chain: BezierChain
    centre: FloatArray


@dataclass(frozen=True, eq=False)
class EyeSize:
    """Centreline radii of loop and neck, and the wire's diameter."""

    loop_mm: float
    neck_mm: float
    wire_mm: float


def best_eye(stem: BezierChain, others: Any, outward: FloatArray, size: EyeSize) -> Eye | None:
    """The eye at the end of `stem` that lies most nearly in the direction `outward` and is free.

    `others` are all other centrelines as shapely geometry. None where no eye is free.
    """
    import shapely

    near = stem.end + np.zeros((1, 2))
    beyond = others.difference(shapely.Point(near[0]).buffer(2 * size.wire_mm))
    angles = np.arange(0.0, math.pi + 1e-9, NECK_STEP_RAD)
    choices: list[tuple[float, int, _Course]] = []
    for neck, side, bend in itertools.product(NECKS_DIAMETERS, (1.0, -1.0), angles):
        course = _Course.of(stem, neck * size.wire_mm, side, float(bend), size)
        away = course.centre - stem.end
        aside = math.acos(np.clip(float(away @ outward) / float(np.linalg.norm(away)), -1.0, 1.0))
        if aside <= MOST_ASIDE_RAD:
            choices.append((round(aside + neck * NECK_COST_RAD, 9), len(choices), course))
    for _, _, course in sorted(choices, key=lambda choice: choice[:2]):
        if course.is_free(others, beyond) and (eye := course.closed(stem)) is not None:
            return eye
    return None


@dataclass(frozen=True, eq=False)
class _Course:
    """A neck, straight and then bent to one side, and the middle of the loop to the other side after it."""

    neck: BezierChain | None
    start_rad: float
    side: float
    centre: FloatArray
    size: EyeSize

    @staticmethod
    def of(stem: BezierChain, straight_mm: float, side: float, bend_rad: float, size: EyeSize) -> _Course:
        heading = math.atan2(stem.end_tangent[1], stem.end_tangent[0])
        parts, at = [], stem.end
        if straight_mm > 0:
            parts.append(straight(at, at + straight_mm * stem.end_tangent))
            at = parts[-1].end
        if bend_rad > 0:
            centre = at - side * size.neck_mm * _left(heading)
            first = heading + side * math.pi / 2
            arc = as_chain(Arc((centre[0], centre[1]), size.neck_mm, first, -side * bend_rad))
            parts.append(_from(at, arc))
            at, heading = parts[-1].end, heading - side * bend_rad
        centre = at + side * size.loop_mm * _left(heading)
        return _Course(joined(parts) if parts else None, heading - side * math.pi / 2, side, centre, size)

    def is_free(self, others: Any, beyond: Any) -> bool:
        """Whether loop and neck keep clear of all other wires; `beyond` are those away from the end."""
        import shapely

        d = self.size.wire_mm
        if others.distance(shapely.Point(self.centre)) < self.size.loop_mm + d + GAP_MM:
            return False
        return self.neck is None or shapely.LineString(self.neck.sampled(0.05)).distance(beyond) > d + GAP_MM

    def closed(self, stem: BezierChain) -> Eye | None:
        """The eye, its loop as long as it keeps clear of stem and neck; None if that is hardly a loop."""
        import shapely

        before = stem if self.neck is None else joined([stem, self.neck])
        line = shapely.LineString(before.sampled(SAMPLE_MM))
        shapely.prepare(line)
        sweeps = np.linspace(0, math.tau, 721)
        free = shapely.distance(line, shapely.points(self._at(sweeps))) >= self.size.wire_mm + GAP_MM
        ends = np.flatnonzero(free)
        if not len(ends) or sweeps[ends[-1]] < LEAST_SWEEP_RAD or not free[ends[0] : ends[-1]].all():
            return None
        if sweeps[ends[0]] > math.pi / 2:
            return None
        low, high = float(sweeps[ends[-1]]), float(sweeps[ends[-1] + 1])
        for _ in range(30):
            middle = (low + high) / 2
            apart = line.distance(shapely.Point(self._at(np.array([middle]))[0]))
            low, high = (middle, high) if apart >= self.size.wire_mm + GAP_MM else (low, middle)
        x, y = (float(value) for value in self.centre)
        arc = as_chain(Arc((x, y), self.size.loop_mm, self.start_rad, self.side * low))
        loop = _from(before.end, arc)
        return Eye(loop if self.neck is None else joined([self.neck, loop]), self.centre)

    def _at(self, sweep_rad: FloatArray) -> FloatArray:
        angle = self.start_rad + self.side * sweep_rad
        return self.centre + self.size.loop_mm * np.column_stack([np.cos(angle), np.sin(angle)])


def _left(heading_rad: float) -> FloatArray:
    return np.array([-math.sin(heading_rad), math.cos(heading_rad)])


def _from(start: FloatArray, chain: BezierChain) -> BezierChain:
    """The chain from exactly there; it starts there but for rounding."""
    points = np.array(chain.points)
    points[1:, 0] = points[:-1, 3]
    points[0, 0] = start
    return BezierChain(points)
