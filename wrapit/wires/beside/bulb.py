"""The hairpin at the end of a stretch that a wire runs out and back."""

from __future__ import annotations

import math

import numpy as np

from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.bezier import joined
from wrapit.geometry.outlines.loops import arc_cubics

# Cubics of at most 45° stray from their circle by 4e-6 of its radius (`geometry/outlines/loops.py`).
PIECE_RAD = math.pi / 4


def bulb_reach_mm(half_mm: float, radius_mm: float) -> float:
    """How far a bulb of this radius reaches ahead from between two runs `half_mm` to either side.

    >>> bulb_reach_mm(1.0, 0.5)
    1.0
    >>> round(bulb_reach_mm(0.5, 1.0), 6)   # cos α = 3/4
    2.322876
    """
    if radius_mm <= half_mm:
        return half_mm
    return radius_mm + 2 * radius_mm * math.sin(_swing_rad(half_mm, radius_mm))


def bulb(middle: FloatArray, along: FloatArray, shift_mm: float, radius_mm: float) -> BezierChain:
    """From `shift_mm` to the left of `middle`, running `along` (a unit vector), round to as far on the other.

    An arc outward, one back round, one inward again, all of the radius; half a circle where the runs are far
    enough from one another for it.
    """
    half_mm, away = abs(shift_mm), math.copysign(1.0, shift_mm)
    left = np.array([-along[1], along[0]])
    at, heading = middle + shift_mm * left, math.atan2(along[1], along[0])
    if radius_mm <= half_mm:
        sweeps, radius_mm = [-away * math.pi], half_mm
    else:
        swing = away * _swing_rad(half_mm, radius_mm)
        sweeps = [swing, -2 * swing - away * math.pi, swing]
    arcs = []
    for sweep in sweeps:
        arcs.append(arc(at, heading, radius_mm, sweep))
        at, heading = arcs[-1].end, heading + sweep
    return joined(arcs)


def arc(start: FloatArray, heading_rad: float, radius_mm: float, sweep_rad: float) -> BezierChain:
    """The arc from a point in a direction, to the left by a positive angle and to the right by a negative."""
    count = max(1, math.ceil(abs(sweep_rad) / PIECE_RAD))
    headings = heading_rad + np.linspace(0, sweep_rad, count + 1)
    tangents = np.column_stack([np.cos(headings), np.sin(headings)])
    outward = math.copysign(radius_mm, sweep_rad) * np.column_stack([tangents[:, 1], -tangents[:, 0]])
    points = start - outward[0] + outward
    points[0] = start
    return BezierChain(arc_cubics(points, tangents, radius_mm, abs(sweep_rad) / count))


def _swing_rad(half_mm: float, radius_mm: float) -> float:
    return math.acos((half_mm + radius_mm) / (2 * radius_mm))
