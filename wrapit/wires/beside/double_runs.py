"""Where along a wire another run of the same lines lies beside it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np

from wrapit.decomposition.json_file import wire_name
from wrapit.geometry import BSpline, FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import IntArray, runs
from wrapit.wires.beside.sides import Strand, Stretch
from wrapit.wires.model import DoubleRun, Side

# How finely wires are compared; a run is beside the other between these shares of their distance.
STEP_MM, LEAST, MOST = 0.05, 0.7, 1.1
# Beside is square to the way, within this (sine): a place ahead on a hairpin's tip is not beside.
OBLIQUE = 0.3
# Shorter than so many diameters is a touch, not a run.
LEAST_DIAMETERS = 1.0


def double_runs(
    stretches: Sequence[Stretch],
    splines: Sequence[BSpline],
    spans_mm: Sequence[Sequence[tuple[float, float]]],
    apart_mm: float,
) -> list[tuple[DoubleRun, ...]]:
    """For each wire its double runs in their order along it: what truly lies so near to the other run.

    At the ends of a stretch, where the runs part, they part on it already.
    """
    courses = [ArcLength(spline) for spline in splines]
    found: list[list[DoubleRun]] = [[] for _ in splines]
    for stretch in stretches:
        for which in (0, 1):
            strand, other = stretch.strands[which], stretch.strands[1 - which]
            at_mm = _stations(spans_mm, strand)
            beside = _beside(courses, at_mm, strand, _stations(spans_mm, other), other, apart_mm)
            for side, sign in (("left", 1), ("right", -1)):
                found[strand.trail] += [
                    DoubleRun(
                        float(at_mm[a]),
                        float(at_mm[b]),
                        wire_name(other.trail),
                        cast(Side, side),
                        stretch.opposed,
                        which == 0,
                    )
                    for a, b in runs(beside == sign)
                    if at_mm[b] - at_mm[a] >= LEAST_DIAMETERS * apart_mm
                ]
    return [tuple(sorted(own, key=lambda run: run.start_mm)) for own in found]


def _beside(
    courses: Sequence[ArcLength],
    at_mm: FloatArray,
    strand: Strand,
    others_mm: FloatArray,
    other: Strand,
    apart_mm: float,
) -> IntArray:
    """For places (m,) along one run: 1 where the other lies to its left, -1 to its right, 0 elsewhere."""
    from scipy.spatial import cKDTree

    course, along = courses[strand.trail], courses[other.trail]
    u = course.parameter(at_mm)
    points, ahead = course.spline.at(u), unit(course.spline.derivative(u))
    cloud = along.spline.at(along.parameter(others_mm))
    distances, nearest = cKDTree(cloud).query(points)
    apart = cloud[nearest] - points
    forward, left = (ahead * apart).sum(axis=1), ahead[:, 0] * apart[:, 1] - ahead[:, 1] * apart[:, 0]
    near = (distances >= LEAST * apart_mm) & (distances <= MOST * apart_mm)
    square = np.abs(forward) <= OBLIQUE * distances
    return np.where(near & square, np.sign(left), 0).astype(np.int64)


def _stations(spans_mm: Sequence[Sequence[tuple[float, float]]], strand: Strand) -> FloatArray:
    start, end = spans_mm[strand.trail][strand.first][0], spans_mm[strand.trail][strand.last][1]
    return np.linspace(start, end, max(2, 1 + round((end - start) / STEP_MM)))
