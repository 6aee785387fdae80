"""How a picture without grey along its edges is known, and its edges made soft enough to be measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.ink import Ink

# When are the edges hard? A step from ink to paper takes more than this share of their contrast, at more than
# this share of all steps. Of the steps of 59 smooth, blurred, scanned and JPEG pictures at most 0.40 are that
# large (0.56 with a hard frame around), of those of thresholded ones all.
_FULL_STEP = 0.8
_HARD = 0.7
# Along how many rows and columns is that looked at? From 200 to 600 nothing changes on the corpus.
_LINES = 300
# How large are the blocks that nearest-neighbour enlarging makes of pixels? This share of all steps lies
# between blocks: all of them, but JPEG moves some. Larger ones than 12 are drawn as squares on purpose.
_LARGEST_BLOCK = 12
_BETWEEN_BLOCKS = 0.97
# Stairs higher than this, in pixels, are no uneven enlarging but a drawing of few level and upright lines.
_HIGHEST_STAIR = 4.0
# How far is a hard edge blurred before it is measured, in stairs (Gauss)? About the length of the stairs of
# a slanted edge; those of nearly level ones are longer, and left to `steady.py`.
_BLUR = 1.5
# Where are stairs so high that a side is no longer than a few of them, in stroke widths? In strokes of five
# stairs and less: without this limit a heart 100 px wide loses its graph. And where are they uneven, in
# pixels? Enlarged one and a half times, a wheel measured farther turns 1.26 times as much, and 1.2 without.
# With 1.65 instead of 1.25, 26 instead of 27 of 28 hard-edged pictures are good, with 0.85, which leaves none
# looked at for longer, 17.
_HIGHEST_OF_WIDTH = 0.2
_EVEN = 1.25
# How near to halfway may the blur bring a pixel, in grey levels? Ink stays ink, whatever surrounds it.
_LEAST_SIDE = 6


def is_hard(ink: Ink) -> bool:
    """Whether ink turns into paper from one pixel to the next, without grey between."""
    limit = _FULL_STEP * (ink.paper - ink.ink)
    steps = full = 0
    # Every third row and column tells enough; of large pictures, some hundreds.
    every = max(3, min(ink.mask.shape) // _LINES)
    for mask, grey in ((ink.mask[::every], ink.grey[::every]), (ink.mask.T[::every], ink.grey.T[::every])):
        changes = _changes(np.ascontiguousarray(mask), 1)
        before, after = grey[:, :-1][changes].astype(np.int16), grey[:, 1:][changes]
        steps += len(before)
        full += int(np.count_nonzero(np.abs(before - after) > limit))
    return full > _HARD * steps


def block_side(mask: NDArray[np.bool_]) -> int:
    """The side of the blocks that all ink is made of, in pixels: 1 unless the picture was enlarged."""
    # Rows count down and columns across; a step lies behind the pixel that is counted.
    places = [np.count_nonzero(_changes(mask, axis), axis=1 - axis) for axis in (0, 1)]
    for side in range(_LARGEST_BLOCK, 1, -1):
        between = sum(int(counts[side - 1 :: side].sum()) for counts in places)
        if between > _BETWEEN_BLOCKS * sum(int(counts.sum()) for counts in places):
            return side
    return 1


def stair_px(mask: NDArray[np.bool_]) -> float:
    """How high the stairs along the edges are, in pixels: more than 1 where enlarged unevenly."""
    gaps = np.concatenate(
        [np.diff(np.flatnonzero(_changes(mask, axis).any(axis=1 - axis))) for axis in (0, 1)]
    )
    if not len(gaps):
        return 1.0
    # Enlarging by 2.5 makes blocks of 2 and of 3 pixels; the larger gaps are what the drawing leaves empty.
    mean = float(gaps[gaps <= 2 * gaps.min()].mean())
    return mean if mean <= _HIGHEST_STAIR else 1.0


def needs_longer_look(ink: Ink, width_px: float) -> bool:
    """Whether sides of strokes must be looked at over more of their length, as stairs hide their course."""
    return 0 < ink.stair_px < min(_EVEN, _HIGHEST_OF_WIDTH * width_px)


def softened(ink: Ink, stair: float = 1.0) -> Ink:
    """The ink with grey along its edges, as far as pixels tell; what is ink and what paper stays."""
    from scipy.ndimage import gaussian_filter

    level = np.where(ink.mask, np.uint8(0), np.uint8(255))
    soft = gaussian_filter(level, _BLUR * stair, truncate=3.0)
    np.minimum(soft, 127 - _LEAST_SIDE, out=soft, where=ink.mask)
    np.maximum(soft, 128 + _LEAST_SIDE, out=soft, where=~ink.mask)
    return replace(ink, grey=soft, paper=255.0, ink=0.0)


def _changes(mask: NDArray[np.bool_], axis: int) -> NDArray[np.bool_]:
    """Where a pixel and the next one along an axis are ink and paper."""
    return mask[1:] != mask[:-1] if axis == 0 else mask[:, 1:] != mask[:, :-1]
