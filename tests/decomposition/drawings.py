"""Small drawings for the tests, made of straight segments."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wrapit.drawing.model import Drawing, Junction, Segment
from wrapit.geometry import BezierChain, straight


def drawing_of(points: Sequence[tuple[float, float]], lines: Sequence[tuple[int, int]]) -> Drawing:
    """Straight segments between points; a line from a point to itself is a round loop of 4 mm."""
    junctions = tuple(Junction(index, np.array(point, dtype=float)) for index, point in enumerate(points))
    segments = []
    for index, (a, b) in enumerate(lines):
        start, end = junctions[a].point, junctions[b].point
        curve = straight(start, end)
        if a == b:
            curve = BezierChain(
                np.array([[start, start + np.array([4, 4]), start + np.array([-4, 4]), start]])
            )
        segments.append(Segment(index, a, b, curve))
    return Drawing(junctions, tuple(segments))


def cross() -> Drawing:
    """Two straight strokes that cross."""
    return drawing_of([(0, 0), (10, 0), (-10, 0), (0, 10), (0, -10)], [(0, 1), (0, 2), (0, 3), (0, 4)])


def theta() -> Drawing:
    """A square with a diagonal: two junctions of degree 3, two corners."""
    return drawing_of([(0, 0), (10, 0), (10, 10), (0, 10)], [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)])
