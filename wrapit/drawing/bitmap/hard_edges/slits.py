"""Slits across strokes: paper that shows between polygons painted end to end is closed.

A slit is much narrower than the stroke, and with it closed the ink is no broader than one stroke. That tells
it from a white line between two strokes, from the notch between strokes that part, and from a small ring.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.ink import Ink

# In stroke widths. How wide is a slit at most? A wider one may be a gap that was meant, for `gaps.py`.
_WIDEST = 0.22
# How deep in the closed ink does it reach at least? Shallower ones, stairs among them, don't disturb much.
_DEEP = 0.25
# How far from paper is the middle of one stroke at most? Half a width, and up to 0.71 where two cross; where
# two strokes lie side by side or part it is a whole one.
_ONE_STROKE = 0.75
# How many such slits make a picture one of polygons? A notch or a gap of its own may be meant: of 54 pictures
# of the corpus none has more than two.
_FEWEST = 4
# A slit is as long as the stroke is broad, and longer where it is slanted; a line between strokes is longer.
_LONGEST = 1.6
# How long are the white runs along rows and columns that a quick look counts, in widths? Slits make strokes
# look thinner by a third at most. And how many runs has the shortest slit that reaches deep enough?
_QUICK = 1.5 * _WIDEST
_RUNS = 3
# No slit is wider, in pixels: strokes broader than 50 px are few.
_WIDEST_PX = 11
# How dark is full ink, as a share of the contrast? JPEG and scans vary by less.
_FULL_INK = 0.3

Mask = NDArray[np.bool_]
Places = NDArray[np.intp]


def without_slits(ink: Ink) -> Ink:
    """The ink with the slits across its strokes closed; the same where it has none."""
    # Antialiased slits are grey, and only the middle of a stroke is all ink.
    full = ink.grey < np.uint8(np.ceil(ink.ink + _FULL_INK * (ink.paper - ink.ink)))
    thin_px = _stroke_px(full)
    longest = max(2, int(np.ceil(_QUICK * thin_px)))
    if _short_runs(full, longest) < _FEWEST * max(_RUNS, _DEEP * thin_px):
        return ink
    fitting = _widest_that_fits(full, thin_px)
    if fitting is None:
        return ink
    closed, width_px = fitting
    found = closed & ~full
    white = np.flatnonzero(found & ~ink.mask)
    inside = _surrounded(closed, white, 2 * int(_DEEP * width_px) + 1) if len(white) >= _FEWEST else white
    if len(inside) < _FEWEST:
        return ink
    slits = _across_one_stroke(closed, found, inside, width_px)
    if slits is None:
        return ink
    grey = ink.grey.copy()
    grey[slits] = round(ink.ink)
    return replace(ink, mask=ink.mask | slits, grey=grey)


def _short_runs(mask: Mask, longest: int) -> int:
    """How many runs of paper between ink are no longer than that, along rows and columns."""
    count = 0
    for picture in (mask, mask.T):
        edges = np.flatnonzero(np.diff(picture.ravel()))
        # Runs alternate; those round the end of a row are few.
        between = np.diff(edges)
        first = 0 if picture.flat[0] else 1
        count += int(np.count_nonzero(between[first::2] <= longest))
    return count


def _widest_that_fits(mask: Mask, width_px: float) -> tuple[Mask, float] | None:
    """The ink with the widest slits closed that its strokes, so closed, allow; and their width in pixels.

    `width_px` is how broad they look before. Slits make strokes look thin, so closing them may allow wider
    ones.
    """
    fitting, closed_px = None, 0
    while closed_px < (widest := int(min(_WIDEST * width_px, _WIDEST_PX))):
        closed = _closed(mask, widest)
        width_px, closed_px = _stroke_px(closed), widest
        fitting = closed, width_px
    return fitting


def _across_one_stroke(closed: Mask, found: Mask, inside: Places, width_px: float) -> Mask | None:
    """Those pieces of `found` where the closed ink is one stroke; nothing where too few reach inside.

    `inside` are places in the flat picture.
    """
    from scipy.ndimage import distance_transform_edt, find_objects, label, maximum

    pieces, count = label(found, np.ones((3, 3)))
    numbers = np.arange(1, count + 1)
    spans = [np.hypot(*(side.stop - side.start for side in box)) for box in find_objects(pieces)]
    short, deep = np.array(spans) <= _LONGEST * width_px, np.unique(pieces.flat[inside]) - 1
    # Distances take most of the time, and most pictures have too few short pieces.
    if np.count_nonzero(short[deep]) < _FEWEST:
        return None
    depth = np.asarray(maximum(distance_transform_edt(closed), pieces, numbers))
    slit = (depth <= _ONE_STROKE * width_px) & short
    if np.count_nonzero(slit[deep]) < _FEWEST:
        return None
    return np.concatenate([[False], slit])[pieces]


def _stroke_px(mask: Mask) -> float:
    """The width of the strokes, from the area of the ink and the length of its edge."""
    steps = np.count_nonzero(mask[1:] != mask[:-1]) + np.count_nonzero(mask[:, 1:] != mask[:, :-1])
    return float(2 * np.count_nonzero(mask) / max(steps * np.pi / 4, 1.0))


def _closed(mask: Mask, width: int) -> Mask:
    """The ink with all paper filled into which no square of `width` + 1 pixels fits."""
    squares = _runs(_runs(np.pad(mask, width), width + 1, 0, np.logical_or), width + 1, 1, np.logical_or)
    return _runs(_runs(squares, width + 1, 0, np.logical_and), width + 1, 1, np.logical_and)


def _surrounded(mask: Mask, places: Places, side: int) -> Places:
    """Those places in the flat picture around which a square with an odd side is all ink."""
    half, width = side // 2, mask.shape[1]
    padded = np.pad(mask, half)
    row, column = np.divmod(places, width)
    at = (row + half) * padded.shape[1] + column + half
    reach = range(-half, half + 1)
    # Corners first: most squares have paper there, and are looked at no more.
    steps = sorted(((y, x) for y in reach for x in reach), key=lambda step: -abs(step[0] * step[1]))
    for y, x in steps:
        ink = padded.ravel()[at + (y * padded.shape[1] + x)]
        places, at = places[ink], at[ink]
    return places


def _runs(mask: Mask, length: int, axis: int, together: np.ufunc) -> Mask:
    """Each run of `length` pixels along an axis put together, by doubling: `length` - 1 fewer."""
    reached = 1
    while reached < length:
        step = min(reached, length - reached)
        pair = (mask[:-step], mask[step:]) if axis == 0 else (mask[:, :-step], mask[:, step:])
        mask, reached = together(*pair), reached + step
    return mask
