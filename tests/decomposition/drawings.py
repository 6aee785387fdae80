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


def gap_drawing() -> Drawing:
    """A frame with two twigs inside whose tips nearly meet."""
    points = [(0, 0), (30, 0), (30, 20), (0, 20), (0, 10), (30, 10), (14, 10), (16, 10)]
    return drawing_of(points, [(0, 1), (1, 5), (5, 2), (2, 3), (3, 4), (4, 0), (4, 6), (5, 7)])


def twig_drawing() -> Drawing:
    """Two crossing diagonals in a frame, and a twig that hangs on a side."""
    points = [(0, 0), (20, 0), (20, 20), (0, 20), (10, 10), (10, 0), (10, -8)]
    lines = [(0, 5), (5, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 2), (1, 4), (4, 3), (5, 6)]
    return drawing_of(points, lines)


def lotus() -> Drawing:
    """Mirrored about x = 0: a stem, two petals that cross, two leaves; drawn a little unevenly."""
    points = [(0, 0), (0, 20), (12, 30), (-12.2, 30.1), (0, 34), (10, 8), (-10.1, 8), (16, 18), (-15.9, 18)]
    lines = [(0, 1), (1, 2), (1, 3), (2, 4), (3, 4), (0, 5), (0, 6), (5, 7), (6, 8), (7, 2), (8, 3), (1, 4)]
    return drawing_of(points, lines)
