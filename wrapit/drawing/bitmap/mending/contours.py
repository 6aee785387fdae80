"""The ink's edge around joints and corners, and how far the edges of what was traced lie from it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import BezierChain, FloatArray

# In stroke widths.
# How far off is a point that belongs to other ink? As in the edges of corners.
_OUTLIER = 0.25
# How finely are curves drawn? A twelfth leaves two thousandths between.
_FINE = 1 / 12


def contour(ink: Ink) -> FloatArray:
    """Points (n, 2) of the edge of all ink: where grey crosses the half between neighbouring pixels."""
    above = ink.framed.astype(np.float32) - np.float32(ink.half)
    found = []
    for x, y in ((1, 0), (0, 1)):
        first = above[: above.shape[0] - y, : above.shape[1] - x]
        second = above[y:, x:]
        row, column = np.nonzero((first <= 0) != (second <= 0))
        share = first[row, column] / (first[row, column] - second[row, column])
        found.append(np.column_stack([column - 1 + x * share, row - 1 + y * share]))
    return np.concatenate(found)


def off(points: FloatArray, curves: Iterable[BezierChain], width_px: float) -> FloatArray:
    """How far outside (n,) of the ink of curves points lie, in stroke widths: at its edge nothing."""
    from scipy.spatial import cKDTree

    drawn = np.concatenate([curve.sampled(_FINE * width_px) for curve in curves])
    return np.asarray(cKDTree(drawn).query(points)[0], dtype=np.float64) / width_px - 0.5


def rms(off_edge: FloatArray) -> float:
    """Root mean square, with outliers (other ink) bounded."""
    return float(np.sqrt(np.square(np.minimum(np.abs(off_edge), _OUTLIER)).mean()))
