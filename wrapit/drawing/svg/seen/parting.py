"""Curves parted at the edge of a region, and what is within it and beyond."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.drawing.svg.cutting import stretches
from wrapit.drawing.svg.newton import local
from wrapit.drawing.svg.planar import Curve
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import total_length

# Samples of each cubic. A curve that leaves a region for less than a 64th of a cubic is taken as inside,
# and the edge of a curved region errs by its bend in a 64th of a cubic: 1e-5 of a circle's radius.
SAMPLES = 64
# Halvings that find where a curve leaves: a 64th of a cubic becomes a rounding error.
_HALVINGS = 40


@dataclass(frozen=True, eq=False)
class Parts:
    """The parts of one curve within a region and beyond it; a curve that isn't parted stays as it is."""

    within: list[Curve]
    beyond: list[Curve]


def parted(curve: Curve, region: Any, least: float = 0.0) -> Parts:
    """A curve parted where it enters and leaves a region of shapely.

    Stretches within that are shorter than `least` count as beyond, unless they are the whole curve.
    """
    import shapely

    def inside(at: FloatArray) -> Any:
        return shapely.intersects_xy(region, *points(curve.cubics, at).T)

    at = samples(curve)
    flags = inside(at)
    if flags.all():
        return Parts([curve], [])
    changes = np.flatnonzero(flags[1:] != flags[:-1])
    low, high, first = at[changes], at[changes + 1], flags[changes]
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        same = inside(middle) == first
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    count = float(len(curve.cubics))
    if curve.closed and len(low) > 1:
        # Where a closed curve begins is no end of a part of it.
        marks, is_within = np.append(low, low[0] + count), ~first
    else:
        marks = np.concatenate([[0.0], low, [count]])
        is_within = np.append(flags[0], ~first)
    spans = _without_short(curve, list(zip(marks[:-1], marks[1:], is_within, strict=True)), least)
    if len({kind for *_, kind in spans}) == 1:
        return Parts([curve], []) if spans[0][2] else Parts([], [curve])
    cut = stretches(curve.cubics, [start for start, *_ in spans], [end for _, end, _ in spans])
    found: tuple[list[Curve], list[Curve]] = [], []
    for part, (*_, kind) in zip(cut, spans, strict=True):
        if part is not None:
            found[not kind].append(Curve(part, closed=False))
    return Parts(*found)


Span = tuple[float, float, bool]


def _without_short(curve: Curve, spans: list[Span], least: float) -> list[Span]:
    """Spans with short ones within joined to what is beyond them."""
    if not least:
        return spans
    lengths = [_length(curve, start, end) for start, end, _ in spans]
    kept: list[Span] = []
    for (start, end, within), length in zip(spans, lengths, strict=True):
        kind = bool(within) and length >= least
        if kept and kept[-1][2] == kind:
            kept[-1] = (kept[-1][0], end, kind)
        else:
            kept.append((start, end, kind))
    if curve.closed and len(kept) > 1 and kept[0][2] == kept[-1][2]:
        start, _, kind = kept.pop()
        kept[0] = (start, kept[0][1] + len(curve.cubics), kind)
    return kept


def _length(curve: Curve, start: float, end: float) -> float:
    at = np.linspace(start, end, 2 + int(SAMPLES * (end - start)))
    whole = at % len(curve.cubics) if curve.closed else at
    return total_length(points(curve.cubics, whole))


def length(curve: Curve) -> float:
    """The length of a curve, to what its samples miss."""
    return total_length(points(curve.cubics, samples(curve)))


def middle(curve: Curve) -> FloatArray:
    """A point (2,) about halfway along a curve."""
    found: FloatArray = points(curve.cubics, np.array([len(curve.cubics) / 2]))[0]
    return found


def samples(curve: Curve) -> FloatArray:
    """Parameters evenly along a curve, both ends among them."""
    return np.linspace(0.0, len(curve.cubics), SAMPLES * len(curve.cubics) + 1)


def points(cubics: FloatArray, at: FloatArray) -> FloatArray:
    """Points (n, 2) at parameters of a chain."""
    index = np.minimum(at.astype(np.int64), len(cubics) - 1)
    return local(cubics[index], at - index)[0]
