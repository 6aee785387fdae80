"""How the ink of a stroke ends: round as a pen leaves it, or flat as programs and the picture's side do."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import edges, sample
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray

# In stroke widths.
# How far does one walk to the end of the ink? Clean points stop within a width of it.
_FARTHEST = 3.0
# Where is the cap's shape told? On lines up to 0.36 off the centre: a round cap ends 0.15 of the width
# earlier there, while the grey of a flat cap's corners is still farther out; at 0.42 hard edges misled.
_ASIDE = 0.36
_LINES = 9
_ACROSS = np.linspace(-_ASIDE, _ASIDE, _LINES)
# How much of a circle's bulge does a flat end have, at most? Half; of ends rendered at 4 to
# 30 px all round ones read as round, flat ones as flat but for a few of 4 px, and of hard ones up to 9 px.
_FLAT = 0.5


@dataclass(frozen=True)
class Cap:
    """How far ahead the ink ends, how broad the stroke is before, and whether it ends flat."""

    edge_px: float
    width_px: float
    flat: bool


def find_cap(start: FloatArray, ahead: FloatArray, width_px: float, ink: Ink) -> Cap | None:
    """The end of a stroke's ink before a point (2,) on its centre; nothing where there is none in reach."""
    across = np.array([-ahead[1], ahead[0]])
    steps = np.arange(0.0, _FARTHEST * width_px, 0.5)
    edge = _ends(start[None], ahead, steps, ink)[0]
    if not np.isfinite(edge):
        return None
    against, along = (float(side[0]) for side in edges(ink, start[None], across[None], width_px, 0.5))
    known = math.isfinite(against + along)
    broad = min(max(against + along if known else width_px, 0.6 * width_px), 1.5 * width_px)
    middle = start + (along - against) / 2 * across if known else start
    aside = _ACROSS * broad
    ends = _ends(middle + aside[:, None] * across, ahead, steps, ink)
    if not np.isfinite(ends).all():
        return Cap(float(edge), broad, False)
    drop = broad / 2 - np.sqrt(broad**2 / 4 - aside**2)
    (level, _, round_share), *_ = np.linalg.lstsq(
        np.column_stack([np.ones(_LINES), aside, -drop]), ends, rcond=None
    )
    flat = bool(round_share < _FLAT)
    return Cap(float(level if flat else edge), broad, flat)


def _ends(starts: FloatArray, ahead: FloatArray, steps: FloatArray, ink: Ink) -> NDArray[np.float64]:
    """How far ahead of each point (n, 2) the ink (or the picture) ends; nan where it doesn't."""
    levels = sample(ink, starts, np.repeat(ahead[None], len(starts), axis=0), steps) - ink.half
    light = levels > 0
    at = np.argmax(light, axis=1)
    rows = np.arange(len(starts))
    before, after = levels[rows, np.maximum(at - 1, 0)], levels[rows, at]
    share = np.divide(-before, after - before, out=np.zeros_like(before), where=after != before)
    return np.where(light[rows, at] & (at > 0), steps[np.maximum(at - 1, 0)] + share * steps[1], np.nan)
