"""Frames: rectangles around the drawing that touch none of it, of any thickness, rounded or broken."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.page.cells import BoolCells, Cells

# How far from the sides of its box is a frame, in shares of the shorter side? With this much all of a frame
# is found that is a tenth thick, askew by two degrees or rounded with 40 % of its side; a ring reaches .146.
_BAND = 0.125
# How much of each side is there? Corners apart, a dash and a gap as long are half of it.
_CORNER = 0.15
_COVERED = 0.5
# How much does it surround, in shares of its own size? Less is a drawing of a rectangle with a dot in it.
_LEAST_INSIDE = 0.1
# How far may anti-aliasing and blur reach around it, in cells?
_BLUR = 2


def find_frame(cells: Cells) -> BoolCells | None:
    """The cells of the outermost frame; nothing where there is none."""
    from scipy.ndimage import binary_dilation

    ink, (labels, pieces) = cells.ink, cells.pieces
    count = len(pieces)
    if count < 2:
        return None
    boxes = np.array([[box[0].start, box[1].start, box[0].stop, box[1].stop] for box in pieces])
    low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    hugging = _hugging(labels, count, low, high)
    rest = ~hugging
    if (
        not hugging.any()
        or not rest.any()
        or not _covers(np.isin(labels, np.flatnonzero(hugging) + 1), low, high)
    ):
        return None
    inner_low, inner_high = boxes[rest, :2].min(axis=0), boxes[rest, 2:].max(axis=0)
    if not ((inner_low > low).all() and (inner_high < high).all()):
        return None
    if max(inner_high - inner_low) < _LEAST_INSIDE * max(high - low):
        return None
    frame = np.isin(labels, np.flatnonzero(hugging) + 1)
    grown: BoolCells = binary_dilation(frame, np.ones((3, 3)), iterations=_BLUR) & ~(ink & ~frame)
    return grown


def _hugging(
    labels: NDArray[np.int32], count: int, low: NDArray[np.int64], high: NDArray[np.int64]
) -> BoolCells:
    """Of each piece, whether all of it lies along the sides of the box."""
    rows, columns = (np.arange(n) for n in labels.shape)
    rows, columns = (np.minimum(at - low[k], high[k] - 1 - at) for k, at in enumerate((rows, columns)))
    band = np.minimum(rows[:, None], columns[None]) <= _BAND * min(high - low)
    beyond = np.bincount(labels[~band], minlength=count + 1)[1:]
    hugging: BoolCells = beyond == 0
    return hugging


def _covers(frame: BoolCells, low: NDArray[np.int64], high: NDArray[np.int64]) -> bool:
    """Whether ink lies along most of each of the four sides."""
    inside = frame[low[0] : high[0], low[1] : high[1]]
    band = int(_BAND * min(inside.shape)) + 1
    for turned in (inside, inside[::-1], inside.T, inside.T[::-1]):
        corner = int(_CORNER * turned.shape[1])
        if turned[:band, corner : turned.shape[1] - corner].any(axis=0).mean() < _COVERED:
            return False
    return True
