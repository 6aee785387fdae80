"""How round a bend is: the radius of its centre line, from the outer edge of its ink."""

from __future__ import annotations

import math

import numpy as np

from wrapit.drawing.bitmap.centre_lines import sample
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, unit

_ASIDE = 0.5
_RAYS = 25
_MOST = 1.2


def bend_radius(
    ink: Ink, apex: FloatArray, arriving: FloatArray, leaving: FloatArray, turn_rad: float, width_px: float
) -> float | None:
    """Radius in stroke widths of the centre line in a bend whose straight sides would meet at `apex`.

    0 where the pen turned on the spot, whichever way its join is drawn; None where the outer edge
    can't be seen.
    """
    outwards, across = unit(arriving - leaving), unit(arriving + leaving)
    cosine, slope = math.cos(turn_rad / 2), math.tan(turn_rad / 2)
    aside = _ASIDE * math.sin(turn_rad / 2) * np.linspace(-1, 1, _RAYS)
    heights = _outer_edge(ink, apex, outwards, across, aside, 0.5 / cosine, width_px)
    seen = np.isfinite(heights)
    if seen.mean() < 0.8:
        return None
    aside, heights = np.abs(aside[seen]), heights[seen]
    sides = 0.5 / cosine - aside * slope
    bevel = np.minimum(sides, 0.5 * cosine)
    radii = np.linspace(0, _MOST, 61)
    outer = (radii + 0.5)[:, None]
    arcs = np.sqrt(np.maximum(outer**2 - aside**2, 0)) - radii[:, None] / cosine
    round_ = np.where(aside < outer * math.sin(turn_rad / 2), arcs, sides)

    def misses(model):
        return ((model - heights) ** 2).mean(axis=-1)

    missed = misses(round_)
    best = int(np.argmin(missed))
    if min(misses(bevel), misses(sides)) < missed[best]:
        return 0.0
    return float(radii[best])


def _outer_edge(
    ink: Ink,
    apex: FloatArray,
    outwards: FloatArray,
    across: FloatArray,
    aside: FloatArray,
    tip: float,
    width_px: float,
) -> FloatArray:
    """Heights of the ink's edge over the apex, in stroke widths, seen from outside."""
    start = tip + 0.3
    step = max(0.25, width_px / 24)
    offsets = np.arange(0, (start + tip + 1.5) * width_px, step)
    from_ = apex + width_px * (aside[:, None] * across + start * outwards)
    levels = sample(ink.grey, from_, np.broadcast_to(-outwards, from_.shape), offsets) - ink.half
    dark = levels < 0
    at = np.argmax(dark, axis=1)
    rows = np.arange(len(aside))
    found = (at > 0) & dark[rows, at]
    before, after = levels[rows, np.maximum(at - 1, 0)], levels[rows, at]
    share = np.divide(before, before - after, out=np.zeros_like(before), where=after != before)
    return np.where(found, start - (np.maximum(at - 1, 0) + share) * step / width_px, np.nan)
