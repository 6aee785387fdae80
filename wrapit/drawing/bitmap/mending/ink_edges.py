"""The ink's edge around joints and corners, and how far the edges of what was traced lie from it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.arrays import median

# In stroke widths.
# How far off is a point that belongs to other ink? As in the edges of corners.
_OUTLIER = 0.25
# How finely are strokes drawn? A sixth leaves less than a hundredth between.
FINE = 1 / 6
# How much may the width of a stroke change that is as broad everywhere?
_EVEN = 0.12


def contour(ink: Ink) -> FloatArray:
    """Points (n, 2) of the ink's edge, from top to bottom: where grey crosses the half between pixels."""
    grey = ink.framed
    dark = grey <= ink.half
    found = []
    for x, y in ((1, 0), (0, 1)):
        row, column = np.nonzero(dark[: len(dark) - y, : dark.shape[1] - x] != dark[y:, x:])
        first, second = (level.astype(np.float64) for level in (grey[row, column], grey[row + y, column + x]))
        share = (ink.half - first) / (second - first)
        # The frame is a pixel broad.
        found.append(np.column_stack([column - 1 + x * share, row - 1 + y * share]))
    edge = np.concatenate(found)
    return edge[np.argsort(edge[:, 1], kind="stable")]


def near(places: FloatArray | IntArray, points: FloatArray, reach: float) -> NDArray[np.bool_]:
    """Which places (n, 2) are nearer than that to one of points (m, 2)."""
    from scipy.spatial import cKDTree

    return np.isfinite(cKDTree(points).query(places, distance_upper_bound=reach)[0])


def off(points: FloatArray, drawn: FloatArray, halves: FloatArray) -> FloatArray:
    """How far outside (n,) of the ink of strokes points lie, in pixels: at its edge nothing.

    `drawn` (m, 2) are points along the strokes, `halves` (m,) half their widths there.
    """
    from scipy.spatial import cKDTree

    far, nearest = cKDTree(drawn).query(points)
    return np.asarray(far - halves[nearest], dtype=np.float64)


def half_widths(line: Line, count: int, width_px: float) -> FloatArray:
    """Half the width (count,) of a strand's ink at even steps along it, from where it stands alone."""
    known = line.clean & np.isfinite(line.width)
    if not known.any():
        # A stroke that is broader than all others is nowhere clean, but as broad everywhere.
        inner = line.width[len(line.width) // 4 : -(len(line.width) // 4)]
        even = bool(np.isfinite(inner).all()) and np.ptp(inner) < _EVEN * width_px
        return np.full(count, (median(inner) if even else width_px) / 2)
    shares = line.along[known] / max(line.length, 1.0)
    return np.interp(np.linspace(0, 1, count), shares, line.width[known] / 2)


def rms(off_edge: FloatArray) -> float:
    """Root mean square of what edges are off by in stroke widths, with outliers (other ink) bounded."""
    return float(np.sqrt(np.square(np.minimum(np.abs(off_edge), _OUTLIER)).mean()))
