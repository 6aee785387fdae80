"""A picture seen from afar: a few hundred cells a side, how bright the paper is in each, what is darker.

What surrounds a drawing is large, so it is looked for in cells; a picture of 61 million pixels takes no
longer than one of one million.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.image import GreyImage, bands_of, count_levels
from wrapit.drawing.bitmap.page.extremes import highest, lowest

BoolCells = NDArray[np.bool_]
# How many cells has the longer side? A scan's dark edge of one per cent is then five cells broad.
_CELLS = 480
# Below this grey level there is no telling how much darker one place is than another.
_BLACK = np.uint8(8)
# What is ink, seen from afar? Darker than this share of the paper around it: thin lines are pale in cells
# broader than they are, and paper's own grain, averaged over a cell, keeps above .9.
_INK = 0.75
# What is a step of the paper's level? A change by this ratio (as a logarithm) within three cells. A lamp's
# shadow that fades over 5 % of the picture changes by .08, the blurred edge of paper on a pale table by .2.
STEP = 0.14
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

    @cached_property
    def pieces(self) -> tuple[NDArray[np.int32], list[tuple[slice, slice]]]:
        """The number of the piece of ink that each cell belongs to, 0 where none; the box of each piece."""
        from scipy.ndimage import find_objects, label

        labels, _ = label(self.ink, np.ones((3, 3)))
        return labels, find_objects(labels)

    @cached_property
    def is_even(self) -> bool:
        """Whether the paper's level changes by less than a step (`STEP`) all over the picture."""
        return bool(np.log(self.paper.max() / self.paper.min()) < STEP)


def cells_of(grey: GreyImage) -> Cells:
    """The cells of a grey picture with dark ink on light paper."""
    from PIL import Image

    step = max(1, -(-max(grey.shape) // _CELLS))
    small = np.maximum(np.asarray(Image.fromarray(np.ascontiguousarray(grey)).reduce(step)), _BLACK)
    level = small.astype(np.float32)
    stroke = _stroke(level, _median(small))
    look = int(max(_LEAST_LOOK, np.ceil(_PAST_STROKES * stroke))) | 1
    paper = lowest(highest(small, look), look)
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


def depth(shape: tuple[int, ...]) -> NDArray[np.int16]:
    """How many cells each cell lies from the nearest side of the picture."""
    places = (np.arange(n, dtype=np.int16) for n in shape)
    rows, columns = (np.minimum(at, at[::-1]) for at in places)
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


def _median(levels: GreyImage) -> np.float32:
    """The median of bytes: counting them takes a fifth of the time of parting them."""
    total = np.cumsum(count_levels(levels))
    low, high = np.searchsorted(total, [(levels.size - 1) // 2, levels.size // 2], side="right")
    return np.float32((low + high) / 2)


def _stroke(level: NDArray[np.float32], usual: np.float32) -> float:
    """How many cells broad strokes are: the usual run of dark cells along rows and columns."""
    dark = level < _INK * usual
    runs = []
    for picture in (dark, dark.T):
        padded = np.zeros((picture.shape[0], picture.shape[1] + 2), dtype=np.bool_)
        padded[:, 1:-1] = picture
        flat = padded.ravel()
        changes = np.flatnonzero(flat[1:] != flat[:-1])
        first, last = changes[::2], changes[1::2]
        # Runs that touch the picture's side are no strokes.
        width = padded.shape[1]
        free = (first % width > 0) & (last % width < width - 2)
        runs.append((last - first)[free])
    lengths = np.concatenate(runs)
    return float(np.median(lengths)) if len(lengths) else 1.0
