"""The mean of two strokes that draw one line, as smooth cubics."""

from __future__ import annotations

import numpy as np

from wrapit.geometry import FloatArray, unit
from wrapit.geometry.fitting.fit import Stroke, fit
from wrapit.geometry.polyline import evenly

# Points of a mean: the wobble of a hand has far fewer waves along a line.
_POINTS = 129
# How near the curve comes to the mean, in distances of the two strokes: far less than they differ.
_NEAR = 0.02
# Which share of a loop its closing is spread over, and where along it its end is looked for: programs
# overshoot by up to an eighth.
_CLOSING, _LATE = 0.15, 0.75


def mean_line(one: FloatArray, other: FloatArray, apart: float) -> FloatArray:
    """Cubics (n, 4, 2) halfway between two polylines of the same direction."""
    points = (evenly(one, _POINTS) + evenly(other, _POINTS)) / 2
    return fit(Stroke(points, points[2] - points[0], points[-1] - points[-3]), _NEAR * apart).points


def mean_loop(one: FloatArray, other: FloatArray, apart: float) -> FloatArray:
    """Closed cubics (n, 4, 2) halfway between two polylines that each go round once, from wherever."""
    from scipy.spatial import cKDTree

    base = _closed(one)
    beside = evenly(_closed(other), 8 * _POINTS)
    _, nearest = cKDTree(beside).query(base)
    points = (base + beside[nearest]) / 2
    # The feet on a wobbly stroke crowd; even steps and a running mean take that out.
    points[-1] = points[0]
    ring = evenly(points, _POINTS)[:-1]
    ring = (np.roll(ring, 1, axis=0) + 2 * ring + np.roll(ring, -1, axis=0)) / 4
    ring = np.concatenate([ring, ring[:1]])
    tangent = unit(ring[1] - ring[-2])
    return fit(Stroke(ring, tangent, tangent), _NEAR * apart).points


def _closed(points: FloatArray) -> FloatArray:
    """Points evenly round a loop: what overshoots is cut, and what is missing is spread over its end."""
    points = evenly(points, 8 * _POINTS)
    late = int(_LATE * len(points))
    last = late + int(np.argmin(np.linalg.norm(points[late:] - points[0], axis=1)))
    ring = points[: last + 1].copy()
    share = np.clip((np.arange(len(ring)) / (len(ring) - 1) - 1 + _CLOSING) / _CLOSING, 0, 1)[:, None]
    blend = share * share * (3 - 2 * share)
    ring += blend * (ring[0] - ring[-1])
    return evenly(ring, _POINTS)
