"""Tells ink from paper: background, threshold, specks; refuses pictures that are no line drawings."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.image import GreyImage, bands_of, count_levels
from wrapit.errors import DrawingError

# When is paper shaded? Where its background varies by more than this share of the contrast: it is divided
# out, as under strong shading a plain threshold found only half the junctions (recall 0.52). 30 % change
# nothing.
_SHADED = 0.12
# In what blocks is the background seen? Of four by four samples four pixels apart: a stroke of a dozen pixels
# never covers all of them.
_BLOCK_PX = 16
# When is there ink and paper at all? Grey levels: paper's own noise spans less than 32, and 12 of contrast
# was measured on a page too faint to trace, 250 on good ones.
_LEAST_RANGE = 32
_LEAST_CONTRAST = 40
# When are there two kinds of ink, as of a pen and a ruling? This many levels apart, each at least this share
# of it. The pictures on which 30 % change nothing have one kind; the ruled pages of the tests have two.
_TWO_INKS = 50
_LEAST_SHARE = 0.08


@dataclass(frozen=True, eq=False)
class Ink:
    """The ink of a picture: `mask` (h, w) bool; `grey` (h, w) and its histogram.

    `stair_px` is how high the stairs along its edges are: 0 where grey smooths them.
    """

    mask: NDArray[np.bool_]
    grey: GreyImage
    paper: float
    ink: float
    shaded: bool
    histogram: NDArray[np.int64]
    stair_px: float = 0.0

    @property
    def half(self) -> float:
        """Grey level halfway between paper and ink: the edge of a stroke."""
        return (self.paper + self.ink) / 2

    @cached_property
    def framed(self) -> GreyImage:
        """The grey in a frame of paper, a pixel broad: the picture's side is an edge of the ink there."""
        return np.pad(self.grey, 1, constant_values=round(self.paper))


def find_ink(grey: GreyImage, where: str) -> Ink:
    """The ink of a grey picture with dark ink on light paper.

    Raises DrawingError where there is none, or too little contrast.
    """
    background, shaded = _background(grey)
    if shaded:
        grey = np.clip(grey * (255.0 / np.maximum(background, 1.0)), 0, 255).astype(np.uint8)
    histogram = count_levels(grey)
    used = np.flatnonzero(histogram)
    if used[-1] - used[0] < _LEAST_RANGE:
        raise DrawingError(
            "the picture is blank: no ink stands out from the paper", where, "scan it with more contrast"
        )
    threshold = _otsu(histogram)
    ink, paper = _medians(histogram, threshold)
    if paper - ink < _LEAST_CONTRAST:
        raise DrawingError(
            f"the ink hardly stands out from the paper (contrast {paper - ink:.0f} of 255)",
            where,
            "scan it with more contrast, or redraw it with a black pen",
        )
    half = (ink + paper) / 2
    # Whole levels are compared as bytes.
    return Ink(grey < np.uint8(np.ceil(half)), grey, float(paper), float(ink), shaded, histogram)


def darker_ink(ink: Ink) -> GreyImage | None:
    """The picture with the paler of two kinds of ink as paper; nothing where the ink is of one kind."""
    dark_side = ink.histogram.copy()
    dark_side[int(ink.half) :] = 0
    if np.count_nonzero(dark_side) < 2:
        return None
    limit = _otsu(dark_side)
    share = dark_side[:limit].sum() / dark_side.sum()
    if not _LEAST_SHARE < share < 1 - _LEAST_SHARE:
        return None
    dark, pale = _medians(dark_side, limit)
    if pale - dark < _TWO_INKS:
        return None
    levels = np.clip((np.arange(256) - dark) * (255.0 / (limit - dark)), 0, 255).astype(np.uint8)
    return levels[ink.grey]


def separability(ink: Ink) -> float:
    """Otsu's measure: the share of all grey variance that the two classes explain, 0…1."""
    histogram = ink.histogram.astype(np.float64)
    levels = np.arange(256)
    total = histogram.sum()
    mean = (histogram * levels).sum() / total
    variance = (histogram * (levels - mean) ** 2).sum() / total
    dark = levels < ink.half
    share = histogram[dark].sum() / total
    if variance <= 0 or not 0 < share < 1:
        return 0.0
    low = (histogram * levels)[dark].sum() / histogram[dark].sum()
    high = (histogram * levels)[~dark].sum() / histogram[~dark].sum()
    return float(share * (1 - share) * (high - low) ** 2 / variance)


def _otsu(histogram: NDArray[np.int64]) -> int:
    """Level that best divides the histogram (Otsu 1979); levels below it are ink."""
    counts = histogram.astype(np.float64)
    weight = np.cumsum(counts)[:-1]
    moment = np.cumsum(counts * np.arange(256))
    rest = counts.sum() - weight
    low = moment[:-1] / np.maximum(weight, 1)
    high = (moment[-1] - moment[:-1]) / np.maximum(rest, 1)
    between = weight * rest * (high - low) ** 2
    best = np.flatnonzero(between >= between.max() * (1 - 1e-9))
    return int(best.mean()) + 1


def _medians(histogram: NDArray[np.int64], threshold: int) -> tuple[int, int]:
    def median(counts: NDArray[np.int64], first: int) -> int:
        total = np.cumsum(counts)
        return first + int(np.searchsorted(total, total[-1] / 2))

    return median(histogram[:threshold], 0), median(histogram[threshold:], threshold)


def _background(grey: GreyImage) -> tuple[NDArray[np.float32], bool]:
    """The paper without the ink, and whether it is uneven (shadows, a fold, a lamp)."""
    from scipy.ndimage import gaussian_filter, maximum_filter

    height, width = grey.shape
    rows, columns = -(-height // _BLOCK_PX), -(-width // _BLOCK_PX)
    padded = np.pad(grey, ((0, rows * _BLOCK_PX - height), (0, columns * _BLOCK_PX - width)), mode="edge")
    # The fourth highest of sixteen pixels of each block: neither ink nor noise counts.
    small = padded[2::4, 2::4].reshape(rows, 4, columns, 4).transpose(0, 2, 1, 3).reshape(rows, columns, 16)
    bright = np.partition(small, -4)[..., -4].astype(np.float32)
    coarse = gaussian_filter(maximum_filter(bright, 5), 2.0, mode="nearest")
    spread = float(coarse.max() - coarse.min())
    if spread <= _SHADED * max(float(coarse.max()) - float(grey.min()), 1.0):
        return coarse, False
    return _enlarged(coarse, (height, width)), True


def _enlarged(blocks: NDArray[np.float32], shape: tuple[int, int]) -> NDArray[np.float32]:
    """Levels (h, w) between the middles of blocks, linear in both directions, and even beyond the last.

    In double precision all is exact but the last step, so that it doesn't matter in what order it is summed.
    """
    (above, down), (left, right) = (
        _between(count, side) for count, side in zip(blocks.shape, shape, strict=True)
    )
    exact = blocks.astype(np.float64)
    full = np.empty(shape, dtype=np.float32)
    for rows in bands_of(shape):
        share = down[rows, None]
        part = (1 - share) * exact[above[rows]] + share * exact[np.minimum(above[rows] + 1, len(blocks) - 1)]
        step = np.diff(part, axis=1, append=part[:, -1:])
        band = step.take(left, axis=1)
        band *= right
        band += part.take(left, axis=1)
        full[rows] = band
    return full


def _between(count: int, side: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """The block before each pixel of a side, and how far on it lies to the next one, in blocks."""
    at = np.clip((np.arange(side) + 0.5) / _BLOCK_PX - 0.5, 0, count - 1)
    before = at.astype(np.intp)
    return before, at - before
