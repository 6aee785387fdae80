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


def without_slits(ink: Ink) -> Ink:
    """The ink with the slits across its strokes closed; the same where it has none."""
    # Antialiased slits are grey, and only the middle of a stroke is all ink.
    full = ink.grey < ink.ink + _FULL_INK * (ink.paper - ink.ink)
    thin_px = _stroke_px(full)
    longest = max(2, int(np.ceil(_QUICK * thin_px)))
    if _short_runs(full, longest) < _FEWEST * max(_RUNS, _DEEP * thin_px):
        return ink
    fitting = _widest_that_fits(full)
    if fitting is None:
        return ink
    closed, width_px = fitting
    found = closed & ~full
    if np.count_nonzero(found & ~ink.mask) < _FEWEST:
        return ink
    inside = found & _shrunk(closed, 2 * int(_DEEP * width_px) + 1)
    if np.count_nonzero(inside & ~ink.mask) < _FEWEST:
        return ink
    slits = _across_one_stroke(closed, found, inside & ~ink.mask, width_px)
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


def _widest_that_fits(mask: Mask) -> tuple[Mask, float] | None:
    """The ink with the widest slits closed that its strokes, so closed, allow; and their width in pixels.

    Slits make strokes look thin, so closing them may allow wider ones.
    """
    fitting, width_px, closed_px = None, _stroke_px(mask), 0
    while closed_px < (widest := int(min(_WIDEST * width_px, _WIDEST_PX))):
        closed = _closed(mask, widest)
        width_px, closed_px = _stroke_px(closed), widest
        fitting = closed, width_px
    return fitting


def _across_one_stroke(closed: Mask, found: Mask, inside: Mask, width_px: float) -> Mask | None:
    """Those pieces of `found` where the closed ink is one stroke; nothing where too few reach inside."""
    from scipy.ndimage import distance_transform_edt, find_objects, label, maximum

    pieces, count = label(found, np.ones((3, 3)))
    numbers = np.arange(1, count + 1)
    depth = np.asarray(maximum(distance_transform_edt(closed), pieces, numbers))
    spans = [np.hypot(*(side.stop - side.start for side in box)) for box in find_objects(pieces)]
    slit = (depth <= _ONE_STROKE * width_px) & (np.array(spans) <= _LONGEST * width_px)
    if np.count_nonzero(slit[np.unique(pieces[inside]) - 1]) < _FEWEST:
        return None
    return np.concatenate([[False], slit])[pieces]


def _stroke_px(mask: Mask) -> float:
    """The width of the strokes, from the area of the ink and the length of its edge."""
    steps = np.count_nonzero(mask[1:] != mask[:-1]) + np.count_nonzero(mask[:, 1:] != mask[:, :-1])
    return float(2 * np.count_nonzero(mask) / max(steps * np.pi / 4, 1.0))


def _closed(mask: Mask, width: int) -> Mask:
    """The ink with all paper filled into which no square of `width` + 1 pixels fits."""
    padded = np.pad(mask, width + 1)
    grown = _run(_run(padded, width + 1, 0), width + 1, 1)
    closed = ~_run(_run(~grown, width + 1, 0, back=True), width + 1, 1, back=True)
    return closed[width + 1 : -width - 1, width + 1 : -width - 1]


def _shrunk(mask: Mask, side: int) -> Mask:
    """Where a square with an odd side around a pixel is all ink; beyond the picture is paper."""
    padded = np.pad(~mask, side, constant_values=True)
    first = side + side // 2
    grown = _run(_run(padded, side, 0), side, 1)
    return ~grown[first : first + mask.shape[0], first : first + mask.shape[1]]


def _run(mask: Mask, length: int, axis: int, back: bool = False) -> Mask:
    """Each pixel or any of the `length` - 1 before it (behind it with `back`), by doubling."""
    out = mask.copy()
    reached = 1
    while reached < length:
        step = min(reached, length - reached)
        ahead, behind = (slice(step, None), slice(None, -step))
        to, source = (behind, ahead) if back else (ahead, behind)
        if axis == 0:
            out[to] |= out[source]
        else:
            out[:, to] |= out[:, source]
        reached += step
    return out
