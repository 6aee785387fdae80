"""How round a bend is: the radius of its centre line, told by the outer edge of its ink.

The inner edge is sharp up to a radius of half a width, so the middle between both edges can't tell a small
rounded corner from a true one. The outer edge can: it is an arc of half a width more than the radius.
"""

from __future__ import annotations

import math

import numpy as np

from wrapit.drawing.bitmap.centre_lines import sample
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, unit

# All in stroke widths; measured on 1478 zigzags with bends of known radius, 4 to 20 px wide, a third of them
# with hard edges, where radii are off by 0.10 and 0.17 (root mean square).
# Over how much of the edge is it looked at? As far as the ends of a bevel; 0.3, 0.7 and 0.9 tell as much.
_ASIDE = 0.5
_RAYS = 25
# Which radii are tried? Bends above 0.7 are no corners by their middle line already.
_MOST = 1.2
_STEP = 0.02
# When is it an arc? Where that misses the edge by half as much (squared) as each way to draw a true corner.
# With 1 instead of 2, 49 instead of 40 of the 606 round and mitred corners are lost, with 3 it is 33, but 25
# instead of 21 of the 683 arcs of 0.4 and more.
_CLEARLY = 2.0
# And on hard edges? Neither way is told to miss by less than an edge is uncertain by, in stairs: those of a
# thin stroke's mitre look like an arc. From 0.17 to 0.33 the corners of 28 pictures are the same; without
# it a bee's corner of 47 degrees reads as a bend of 0.7, with 0.45 a poodle's bend as a corner.
_NOISE = 0.25
# Where does the walk to the edge begin? So far outside of the tip of a mitre; a stroke nearer than that hides
# it. A fifth of the edge may be hidden without harm: it is the same on both sides of the apex.
_OUTSIDE = 0.3
_SEEN = 0.8


def bend_radius(
    ink: Ink, apex: FloatArray, arriving: FloatArray, leaving: FloatArray, turn_rad: float, width_px: float
) -> float | None:
    """Radius, in stroke widths, of the centre line in a bend whose sides meet at `apex` if carried on.

    0 where the pen turned on the spot, whether the join is a mitre, a bevel or round; None where other ink
    hides the outer edge. `arriving` and `leaving` are unit directions, `turn_rad` is the angle between them.
    """
    outwards, across = unit(arriving - leaving), unit(arriving + leaving)
    half_turn = turn_rad / 2
    tip = 0.5 / math.cos(half_turn)
    aside = _ASIDE * math.sin(half_turn) * np.linspace(-1, 1, _RAYS)
    heights = _outer_edge(ink, apex, outwards, across, aside, tip, width_px)
    seen = np.isfinite(heights)
    if seen.mean() < _SEEN:
        return None
    aside, heights = np.abs(aside[seen]), heights[seen]
    radii = np.arange(0, _MOST, _STEP)
    arcs = _misfits(_arcs(aside, radii, half_turn), heights)
    mitre = tip - aside * math.tan(half_turn)
    bevel = np.minimum(mitre, 0.5 * math.cos(half_turn))
    sharp = min(_misfits(np.stack([mitre, bevel]), heights).min(), arcs[0])
    best = int(np.argmin(arcs))
    noise = (_NOISE * ink.stair_px / width_px) ** 2
    return float(radii[best]) if sharp + noise > _CLEARLY * (arcs[best] + noise) else 0.0


def _arcs(aside: FloatArray, radii: FloatArray, half_turn: float) -> FloatArray:
    """Heights (m, n) over the apex of the outer edges of bends with these radii (m,), with their sides."""
    outer = radii[:, None] + 0.5
    arc = np.sqrt(np.maximum(outer**2 - aside**2, 0.0)) - radii[:, None] / math.cos(half_turn)
    side = 0.5 / math.cos(half_turn) - aside * math.tan(half_turn)
    return np.where(aside < outer * math.sin(half_turn), arc, side)


def _misfits(models: FloatArray, heights: FloatArray) -> FloatArray:
    """Mean squared distance of each model (m, n) from the heights (n,)."""
    return ((models - heights) ** 2).mean(axis=1)


def _outer_edge(
    ink: Ink,
    apex: FloatArray,
    outwards: FloatArray,
    across: FloatArray,
    aside: FloatArray,
    tip: float,
    width_px: float,
) -> FloatArray:
    """Heights of the ink's edge over the apex, walking inwards; nan where the walk doesn't begin on paper."""
    start = tip + _OUTSIDE
    step = max(0.25, width_px / 24)
    # Inside of the deepest arc there is ink.
    offsets = np.arange(0, (start + tip * (2 * _MOST + 1)) * width_px, step)
    origins = apex + width_px * (aside[:, None] * across + start * outwards)
    levels = sample(ink, origins, np.broadcast_to(-outwards, origins.shape), offsets) - ink.half
    dark = levels < 0
    at = np.argmax(dark, axis=1)
    rows = np.arange(len(aside))
    found = (at > 0) & dark[rows, at]
    before, after = levels[rows, np.maximum(at - 1, 0)], levels[rows, at]
    share = np.divide(before, before - after, out=np.zeros_like(before), where=after != before)
    return np.where(found, start - (np.maximum(at - 1, 0) + share) * step / width_px, np.nan)
