"""A picture seen from afar: a few hundred cells a side, how bright the paper is in each, what is darker.

What surrounds a drawing is large, so it is looked for in cells; a picture of 61 million pixels takes no
longer than one of one million.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.image import GreyImage, bands_of

BoolCells = NDArray[np.bool_]
# How many cells has the longer side? A scan's dark edge of one per cent is then five cells broad.
_CELLS = 480
# Below this grey level there is no telling how much darker one place is than another.
_BLACK = np.uint8(8)
# What is ink, seen from afar? Darker than this share of the paper around it: thin lines are pale in cells
# broader than they are, and paper's own grain, averaged over a cell, keeps above .9.
_INK = 0.75
# How broad must the look be that sees past strokes? So many times their width, as at crossings ink is
# broader, and at least so many cells.
_PAST_STROKES = 2.5
_LEAST_LOOK = 9


@dataclass(frozen=True, eq=False)
class Cells:
    """Mean grey level (h, w) of square cells of `step` pixels, and the paper's level there.

    In cells: `stroke` is the ink's usual width, `look` how broad ink may be that paper is seen past.
    """

    level: NDArray[np.float32]
    paper: NDArray[np.float32]
    step: int
    stroke: float
    look: int

    @cached_property
    def ink(self) -> BoolCells:
        """Where something is clearly darker than what surrounds it."""
        return self.level < _INK * self.paper


def cells_of(grey: GreyImage) -> Cells:
    """The cells of a grey picture with dark ink on light paper."""
    from PIL import Image
    from scipy.ndimage import maximum_filter, minimum_filter

    step = max(1, -(-max(grey.shape) // _CELLS))
    small = np.maximum(np.asarray(Image.fromarray(np.ascontiguousarray(grey)).reduce(step)), _BLACK)
    level = small.astype(np.float32)
    stroke = _stroke(level)
    look = int(max(_LEAST_LOOK, np.ceil(_PAST_STROKES * stroke))) | 1
    # Filters take a quarter of the time on bytes.
    paper = minimum_filter(maximum_filter(small, look, mode="nearest"), look, mode="nearest")
    return Cells(level, paper.astype(np.float32), step, stroke, look)


def painted(grey: GreyImage, cells: Cells, where: BoolCells) -> GreyImage:
    """The picture with the cells `where` made paper, as bright as the nearest paper that stays."""
    from scipy.ndimage import distance_transform_edt

    _, (rows, columns) = distance_transform_edt(where | cells.ink, return_indices=True)
    level = (cells.paper[rows, columns] + 0.5).astype(np.uint8)
    step, clean = cells.step, grey.copy()
    height, width = grey.shape
    for band in bands_of((height, width), step):
        part = slice(band.start // step, -(-band.stop // step))
        mask = where[part].repeat(step, axis=0).repeat(step, axis=1)[: band.stop - band.start, :width]
        paint = level[part].repeat(step, axis=0).repeat(step, axis=1)[: band.stop - band.start, :width]
        np.copyto(clean[band], paint, where=mask)
    return clean


def rim_of(where: BoolCells) -> BoolCells:
    """The cells along the four sides of the picture, in one row."""
    return np.concatenate([where[0], where[-1], where[:, 0], where[:, -1]])


def depth(shape: tuple[int, ...]) -> NDArray[np.int64]:
    """How many cells each cell lies from the nearest side of the picture."""
    rows, columns = (np.minimum(np.arange(n), np.arange(n)[::-1]) for n in shape)
    return np.minimum(rows[:, None], columns[None])


def sides(where: BoolCells) -> str:
    """In words, on which sides of the picture these cells lie.

    >>> cells = np.zeros((9, 9), dtype=bool)
    >>> cells[:, 0] = True
    >>> sides(cells)
    'on the left'
    """
    named = {"at the top": where[0], "at the bottom": where[-1], "on the left": where[:, 0]}
    named["on the right"] = where[:, -1]
    most = max(row.mean() for row in named.values())
    words = [name for name, row in named.items() if row.any() and row.mean() > 0.3 * most]
    if len(words) == 4:
        return "all around"
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words) or "inside"


def _stroke(level: NDArray[np.float32]) -> float:
    """How many cells broad strokes are: the usual run of dark cells along rows and columns."""
    dark = level < _INK * np.median(level)
    runs = []
    for picture in (dark, dark.T):
        padded = np.pad(picture, ((0, 0), (1, 1)))
        changes = np.flatnonzero(np.diff(padded.ravel()))
        first, last = changes[::2], changes[1::2]
        # Runs that touch the picture's side are no strokes.
        width = padded.shape[1]
        free = (first % width > 0) & (last % width < width - 2)
        runs.append((last - first)[free])
    lengths = np.concatenate(runs)
    return float(np.median(lengths)) if len(lengths) else 1.0
