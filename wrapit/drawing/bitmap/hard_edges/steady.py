"""Centre lines without the stairs of hard edges: the smoothest that a pixel's uncertainty allows.

Stairs are as long as the edge is level, so their errors hang together over many points: a mean over
neighbours keeps them, a looser fit only follows them later. A smoothing spline takes them out, and weights
that grow where it leaves the points keep it inside the band that the pixels leave open.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths

# What is a wave that the pixels made, in stroke widths? Shorter ones go, longer ones stay. On 30 thresholded
# drawings 3 leaves 1.40 times the Béziers of the smooth ones at the 95th percentile, 5 takes 1.31 but moves
# curves by 0.1 px more (in the median of the largest shifts).
_WAVE = 4.0
# And in stairs? In strokes up to 10 stairs thick, waves longer than 30 stairs stay: with 22 stairs one
# drawing takes 1.86 times the Béziers, with 45 stairs 7 instead of 11 of 26 are near their smooth twins. In
# thicker strokes (a wave drawn 22 px thick turns too much with 30, 45 and 66) only the width counts. With 8
# stairs two drawings fewer of 28 are near their twins; with 12 to 15 an oval is off by 0.52 instead of 0.47
# px, with 15 a tree turns 1.11 instead of 0.98 times as much, with 20 it takes 1.43 times the Béziers.
_WAVE_STAIRS = 30.0
_THICK_STAIRS = 10.0
# How far may the line leave the measured points, in stairs? The middle of two edges is off by 0.2 (standard
# deviation) and never by more than a half. From 0.3 to 0.8 the
# Béziers stay the same, but the largest shifts grow from 1.1 to 1.5 px (95th percentile of 28 drawings).
_BAND = 0.4
# How often are the weights of points outside the band raised? As they are squared each time, four times is a
# factor of thousands where a point stays outside.
_ROUNDS = 4
# What is a point worth where other ink disturbs the width? Enough to keep the line at hand, no more.
_UNCLEAN = 0.05
# The third difference of four points: what is smooth is a quadratic.
_DIFFERENCE = (-1.0, 3.0, -3.0, 1.0)


def all_steadied(
    graph: StrandGraph, lines: dict[int, Line], width_px: float, stair_px: float
) -> dict[int, Line]:
    """The lines of all strands, steadied; each keeps its number of points."""
    return {
        strand: steadied(lines[strand], s.start == s.end and graph.degree(s.start) == 2, width_px, stair_px)
        for strand, s in graph.strands.items()
    }


def steadied(line: Line, closed: bool, width_px: float, stair_px: float) -> Line:
    """The line without waves that stairs of `stair_px` pixels made; its gentle corners stay."""
    corners = np.flatnonzero(np.isnan(line.width) & line.clean).tolist()
    if closed and not corners:
        points = _ring(line, width_px, stair_px)
    else:
        bounds = sorted({0, *corners, *(at + 1 for at in corners), len(line.points)})
        points = np.concatenate(
            [
                _smoothest(line.points[first:last], line.clean[first:last], width_px, stair_px)
                for first, last in pairwise(bounds)
            ]
        )
    return Line(points, line.width, line.clean, lengths(points))


def _ring(line: Line, width_px: float, stair_px: float) -> FloatArray:
    """A closed line's points: it goes on over its seam for two waves, so that nothing shows there."""
    count = len(line.points) - 1
    beyond = min(count, int(2 * _wave(width_px, stair_px) / max(line.length / count, 1e-6)))
    around = np.arange(-beyond, count + beyond) % count
    ring = _smoothest(line.points[around], line.clean[around], width_px, stair_px)[beyond : beyond + count]
    return np.vstack([ring, ring[:1]])


def _wave(width_px: float, stair_px: float) -> float:
    """How long the longest waves are that pixels make, in pixels."""
    thick = width_px > _THICK_STAIRS * stair_px
    return _WAVE * width_px if thick else min(_WAVE * width_px, _WAVE_STAIRS * stair_px)


def _smoothest(points: FloatArray, clean: NDArray[np.bool_], width_px: float, stair_px: float) -> FloatArray:
    from scipy.linalg import solveh_banded

    order = len(_DIFFERENCE) - 1
    if len(points) <= 2 * order:
        return points
    step = max(float(lengths(points)[-1]) / (len(points) - 1), 1e-6)
    # A wave of this many points keeps half its height: its frequency to the sixth power is the stiffness.
    bands = (_wave(width_px, stair_px) / step / (2 * np.pi)) ** (2 * order) * _roughness(len(points))
    trust = np.where(clean, 1.0, _UNCLEAN)
    smooth = points
    for _ in range(_ROUNDS):
        matrix = bands.copy()
        matrix[order] += trust
        smooth = solveh_banded(matrix, trust[:, None] * points)
        off = np.linalg.norm(smooth - points, axis=1) / (_BAND * stair_px)
        trust = np.where(clean, trust * np.maximum(off, 1.0) ** 2, trust)
    return smooth


def _roughness(count: int) -> FloatArray:
    """The upper bands (4, count) of the sum of all squared third differences."""
    order = len(_DIFFERENCE) - 1
    bands = np.zeros((order + 1, count))
    for i, first in enumerate(_DIFFERENCE):
        for j, second in enumerate(_DIFFERENCE[i:], start=i):
            bands[order - (j - i), j : count - order + j] += first * second
    return bands
