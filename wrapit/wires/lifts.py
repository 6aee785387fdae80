"""How high each wire lies where it passes over others that were laid before it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength

STEP_MM = 0.1
SLOPE = 0.5  # steepest rise of a wire over another, mm per mm
SELF_ROUNDS = 6
PROFILE_TOLERANCE_MM = 0.002
SELF_DIAMETERS = 3.0  # a wire meets itself only farther apart than this along its length


def lay_wires(splines: Sequence[BSpline], diameter_mm: float) -> list[tuple[tuple[float, float], ...]]:
    """For each wire, in the order in which they are laid, its height profile (at_mm, z_mm).

    A later wire rests on the earlier ones: wherever two centrelines are nearer than a diameter in the
    plane, the later is raised until they are one diameter apart in space. Flat wires have no points.
    """
    profiles: list[tuple[tuple[float, float], ...]] = []
    below, heights = np.empty((0, 2)), np.empty(0)
    for spline in splines:
        lengths = ArcLength(spline)
        at_mm = lengths.stations(STEP_MM)
        points = spline.at(lengths.parameter(at_mm))
        z_mm = _resting(points, at_mm, below, heights, diameter_mm)
        profiles.append(_simplified(at_mm, z_mm) if z_mm.max() > 1e-9 else ())
        below, heights = np.concatenate([below, points]), np.concatenate([heights, z_mm])
    return profiles


def _resting(
    points: FloatArray, at_mm: FloatArray, below: FloatArray, heights: FloatArray, d: float
) -> FloatArray:
    from scipy.spatial import cKDTree

    needed = np.zeros(len(points))
    if len(below):
        for index, near in enumerate(cKDTree(below).query_ball_point(points, d)):
            if near:
                needed[index] = _on_top(points[index], below[near], heights[near], d)
    meetings = [
        (index, earlier)
        for index, near in enumerate(cKDTree(points).query_ball_point(points, d))
        if (earlier := [i for i in near if at_mm[index] - at_mm[i] > SELF_DIAMETERS * d])
    ]
    profile = _ramped(at_mm, needed)
    for _ in range(SELF_ROUNDS):
        for index, earlier in meetings:
            needed[index] = max(needed[index], _on_top(points[index], points[earlier], profile[earlier], d))
        raised = _ramped(at_mm, needed)
        if np.array_equal(raised, profile):
            break
        profile = raised
    return profile


def _on_top(point: FloatArray, others: FloatArray, heights: FloatArray, d: float) -> float:
    apart2 = ((others - point) ** 2).sum(axis=1)
    return float((heights + np.sqrt(np.maximum(d**2 - apart2, 0.0))).max())


def _ramped(at_mm: FloatArray, needed: FloatArray) -> FloatArray:
    """The lowest profile above `needed` that rises and falls no steeper than SLOPE."""
    falling = np.maximum.accumulate(needed + SLOPE * at_mm) - SLOPE * at_mm
    rising = np.maximum.accumulate((needed - SLOPE * at_mm)[::-1])[::-1] + SLOPE * at_mm
    return np.maximum(np.maximum(rising, falling), 0.0)


def _simplified(at_mm: FloatArray, z_mm: FloatArray) -> tuple[tuple[float, float], ...]:
    """The bends of the profile (Douglas–Peucker, 2 µm)."""
    keep, todo = {0, len(at_mm) - 1}, [(0, len(at_mm) - 1)]
    while todo:
        a, b = todo.pop()
        chord = np.interp(at_mm[a : b + 1], at_mm[[a, b]], z_mm[[a, b]])
        off = np.abs(z_mm[a : b + 1] - chord)
        worst = a + int(off.argmax())
        if off.max() > PROFILE_TOLERANCE_MM:
            keep.add(worst)
            todo += [(a, worst), (worst, b)]
    return tuple((round(float(at_mm[i]), 6), round(float(z_mm[i]), 6)) for i in sorted(keep))
