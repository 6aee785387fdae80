"""Chains of points: how long they are, and points at given lengths along them."""

from __future__ import annotations

import numpy as np

from wrapit.geometry.arrays import FloatArray


def steps(points: FloatArray) -> FloatArray:
    """Distances (…, n - 1) between neighbours of points (…, n, 2)."""
    apart = points[..., 1:, :] - points[..., :-1, :]
    apart *= apart
    # A sum over an axis of two takes several times as long.
    return np.asarray(np.sqrt(apart[..., 0] + apart[..., 1]))


def total_length(points: FloatArray) -> float:
    """Length of a chain of points (n, 2).

    >>> total_length(np.array([(0.0, 0.0), (3.0, 4.0), (3.0, 5.0)]))
    6.0
    """
    return float(steps(points).sum())


def lengths(points: FloatArray) -> FloatArray:
    """Length of a chain of points (n, 2) from its start to each of them, (n,)."""
    apart = steps(points)
    along = np.empty(len(apart) + 1)
    along[0] = 0.0
    apart.cumsum(out=along[1:])
    return along


def at_lengths(points: FloatArray, along: FloatArray, at: FloatArray) -> FloatArray:
    """Points (m, 2) at lengths (m,) along a chain (n, 2), whose own `lengths` are `along`.

    Beyond an end it is that end.
    """
    found = np.empty((len(at), 2))
    for axis in (0, 1):
        found[:, axis] = np.interp(at, along, points[:, axis])
    return found


def slopes(points: FloatArray) -> FloatArray:
    """How points (n, 2) change from one to the next, in the middle of both its neighbours (n, 2).

    >>> slopes(np.array([(0.0, 0.0), (1.0, 0.0), (4.0, 2.0)])).tolist()
    [[1.0, 0.0], [2.0, 1.0], [3.0, 2.0]]
    """
    found = np.empty_like(points)
    np.subtract(points[2:], points[:-2], out=found[1:-1])
    found[1:-1] /= 2.0
    found[0], found[-1] = points[1] - points[0], points[-1] - points[-2]
    return found


def evenly(points: FloatArray, count: int) -> FloatArray:
    """`count` points at even lengths from end to end of a chain (n, 2).

    >>> evenly(np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 1.0)]), 3).tolist()
    [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0]]
    """
    along = lengths(points)
    return at_lengths(points, along, np.linspace(0.0, along[-1], count))


def signed_area(points: FloatArray) -> float:
    """Area of a polygon (n, 2) that doesn't repeat its first point, positive counter-clockwise.

    >>> signed_area(np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 3.0)]))
    6.0
    """
    x, y = points.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum()) / 2
