"""Where neither the middle line nor the corners found explain the ink; chains of curved sides there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.corners.curved_sides import Curves, curves_of
from wrapit.drawing.bitmap.corners.edge_fit import missed
from wrapit.drawing.bitmap.corners.short_sides import clean_from, edges_from, stretch_of
from wrapit.drawing.bitmap.corners.turning import twins
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths

# In stroke widths, or pixels where the name says so; measured on the strokes named in `curved_sides.py`.
# What can't be explained? A stretch of this length whose edges are missed by more (root mean square). With
# 0.045 five more of the 120 come out right, with 0.08 two fewer; tracing takes a twentieth longer, or less.
_OVER = 0.8
_MISSED = 0.06
_MISSED_PX = 0.6
# How far off is other ink? As in `edge_fit.py`.
_OTHER = 0.25
# How far does it reach? As far as edges are missed by more than can be seen, over pauses of this length.
_UNSURE = 0.03
_UNSURE_PX = 0.3
_PAUSE = 1.5
# How far around are sides taken from? Where the chain ends, the middle line must be right. With 1.25 small
# steps lose a corner, as no side is left at the end; with 2.25 chains reach into their neighbours.
_AROUND = 1.75
# When is all explained? Where edges are missed by no more than they are off by: a chain would have to fit
# them better than any does. Of 60 such places on 216 pictures none has a chain; below 0.0067 two of 97 have
# one, and with 0.0033 chains are sought in vain at 44 of the 60.
_EXPLAINED = 0.005
# When does a chain fit? Ink beyond its ends is left out, so true ones fit better than straight chains do;
# with 0.014 those whose sides are no parabolas are lost. And when better than what is known?
_GOOD = 0.022
_GOOD_PX = 0.2
_BETTER = 0.7
# How long may it be? Five corners three widths apart, less the last.
_LONGEST = 14


@dataclass(frozen=True, eq=False)
class CurvedChain:
    """Curved sides instead of a line's points `first` to `last` - 1, and the width of their ink."""

    curves: Curves
    first: int
    last: int
    width_px: float

    def side(self, k: int) -> Line:
        """The points of side `k`, but those next to its ends: sides point at their corners."""
        chord = float(np.linalg.norm(self.curves.corners[k + 1] - self.curves.corners[k]))
        count = max(6, round(8 * chord / self.width_px))
        points = self.curves.points(k, np.linspace(0.1, 0.9, count))
        return Line(points, np.full(count, self.width_px), np.ones(count, dtype=np.bool_), lengths(points))


def curved_chains(
    line: Line,
    ink: Ink,
    width_px: float,
    stretches: list[tuple[int, int]],
    limits: tuple[int, int],
    tops: NDArray[np.intp],
    spans: list[tuple[int, int, FloatArray]],
    taken: list[tuple[int, int]],
) -> list[CurvedChain]:
    """The chains that explain what stretches of a line, with the corners known so far, do not.

    `spans` are the points before and after each known corner, and what lies between; `taken` are stretches
    that need no other corners.
    """
    found = []
    windows = [w for stretch in stretches for w in _windows(line, ink, stretch, tops, spans, width_px)]
    for window in _widened(windows, line, limits, tops, spans, width_px):
        chain = _chain(line, ink, _beside(*window, taken), limits, spans)
        if chain is not None:
            found.append(chain)
    return [*found, *_between_twins(line, ink, width_px, limits, tops, spans, taken, found)]


def chain_around(
    line: Line, ink: Ink, width_px: float, at: int, limits: tuple[int, int]
) -> CurvedChain | None:
    """The chain of two curved sides that explains a corner near a point of a line, within limits."""
    around = round(_AROUND * width_px * (len(line.points) - 1) / line.length)
    window = max(at - around, limits[0]), min(at + around, limits[1])
    chain = _chain(line, ink, window, window, [])
    return chain if chain is not None and len(chain.curves.corners) == 3 else None


def _between_twins(
    line: Line,
    ink: Ink,
    width_px: float,
    limits: tuple[int, int],
    tops: NDArray[np.intp],
    spans: list[tuple[int, int, FloatArray]],
    taken: list[tuple[int, int]],
    known: list[CurvedChain],
) -> list[CurvedChain]:
    """Chains around close turns beside those `known`: the middle line explains small steps nearly as well."""
    found: list[CurvedChain] = []
    around = round(_AROUND * width_px * (len(line.points) - 1) / line.length)
    taken = [*taken, *((chain.first, chain.last) for chain in known)]
    for pair in twins(line, width_px, *limits):
        if any(before <= pair[1] and pair[0] <= after for before, after, *_ in (*taken, *spans)):
            continue
        low, high = _with_sides(*pair, around, limits, tops, spans)
        low = max([low, *(after for _, after in taken if after <= pair[0])])
        high = min([high, *(before - 1 for before, _ in taken if before >= pair[1])])
        chain = _chain(line, ink, (low, high), (low, high), spans)
        if chain is not None:
            found.append(chain)
            taken.append((chain.first, chain.last))
    return found


def _beside(low: int, high: int, taken: list[tuple[int, int]]) -> tuple[int, int]:
    """What is left of a window beside stretches that need no other corners."""
    for before, after in taken:
        if before <= low < after:
            low = min(after, high)
        if before < high <= after:
            high = max(before, low)
    return low, high


def _widened(
    windows: list[tuple[int, int]],
    line: Line,
    limits: tuple[int, int],
    tops: NDArray[np.intp],
    spans: list[tuple[int, int, FloatArray]],
    width_px: float,
) -> list[tuple[int, int]]:
    """Windows with sides at both ends, and where known corners are near, sides beyond those."""
    around = round(_AROUND * width_px * (len(line.points) - 1) / line.length)
    wide: list[tuple[int, int]] = []
    for k, window in enumerate(windows):
        low, high = _with_sides(*window, around, limits, tops, spans)
        if wide and low < wide[-1][1]:
            # They share the sides between them, unless a known corner stands there.
            earlier = wide.pop()
            parted = (windows[k - 1][1] + window[0]) // 2
            if any(start - 2 <= parted <= stop + 2 for start, stop, _ in spans):
                parted = earlier[0]
            else:
                wide.append((earlier[0], parted))
            low = parted
        wide.append((low, high))
    return wide


def _with_sides(
    low: int,
    high: int,
    around: int,
    limits: tuple[int, int],
    tops: NDArray[np.intp],
    spans: list[tuple[int, int, FloatArray]],
) -> tuple[int, int]:
    """A window with a side beyond its last turns and corners at either end."""
    low = min([low, *tops[(tops > low - around) & (tops < low)].tolist()]) - around
    high = max([high, *tops[(tops > high) & (tops < high + around)].tolist()]) + around
    for before, after, _ in reversed(spans):
        if before < low <= after + around // 2:
            low = min(low, before - around // 2)
    for before, after, _ in spans:
        if before - around // 2 <= high < after:
            high = max(high, after + around // 2)
    return max(low, limits[0]), min(high, limits[1])


def _windows(
    line: Line,
    ink: Ink,
    stretch: tuple[int, int],
    tops: NDArray[np.intp],
    spans: list[tuple[int, int, FloatArray]],
    width_px: float,
) -> list[tuple[int, int]]:
    """First and last point of each part whose edges are missed, and where the line turns."""
    start, end = stretch
    edge, of = edges_from(ink, line.points[start : end + 1], width_px)
    if len(edge) == 0:
        return []
    off = np.clip(missed(_explained(line, start, end, spans), edge, width_px).outside, -_OTHER, _OTHER) ** 2
    step = line.length / (len(line.points) - 1)
    box = np.ones(max(1, round(_OVER * width_px / step)))
    whole, count = (
        np.convolve(np.bincount(of, weights=weights, minlength=end - start + 1), box)
        for weights in (off, np.ones(len(of)))
    )
    shift = len(box) // 2
    mean = (whole / np.maximum(count, 1))[shift : shift + end - start + 1]
    some = np.flatnonzero(mean > max(_UNSURE, _UNSURE_PX / width_px) ** 2)
    if not len(some):
        return []
    parted = np.flatnonzero(np.diff(some) > _PAUSE * width_px / step)
    parts = zip(some[np.r_[0, parted + 1]], some[np.r_[parted, len(some) - 1]], strict=True)
    return [
        (int(a) + start, int(b) + start)
        for a, b in parts
        if mean[a : b + 1].max() > max(_MISSED, _MISSED_PX / width_px) ** 2
        and ((tops >= a + start - 8) & (tops <= b + start + 8)).any()
    ]


def _explained(line: Line, start: int, end: int, spans: list[tuple[int, int, FloatArray]]) -> FloatArray:
    """A stretch of a line with its corners' points instead of its own there."""
    parts, at = [], start
    for before, after, points in spans:
        if at < before and after <= end:
            parts += [line.points[at:before], points]
            at = after
        elif at == before == after:
            parts.append(points)
    return np.concatenate([*parts, line.points[at : end + 1]])


def _chain(
    line: Line,
    ink: Ink,
    window: tuple[int, int],
    limits: tuple[int, int],
    spans: list[tuple[int, int, FloatArray]],
) -> CurvedChain | None:
    first, last = (_clean_end(line, at, sign, limits) for at, sign in zip(window, (-1, 1), strict=True))
    if first is None or last is None:
        return None
    stretch = stretch_of(line, first, last, _LONGEST)
    if stretch is None:
        return None
    middle, width_px = stretch
    edge, _ = edges_from(ink, middle, width_px)
    edge = edge[_beside_line(middle, edge, width_px)]
    plain = missed(_explained(line, first, last, spans), edge, width_px)
    if plain.rms < _EXPLAINED:
        return None
    known = [
        points[0] for before, after, points in spans if first < before <= after < last and len(points) == 1
    ]
    curves = curves_of(
        middle, known, edge, width_px, min(max(_GOOD, _GOOD_PX / width_px), _BETTER * plain.rms)
    )
    return None if curves is None else CurvedChain(curves, first + 1, last, width_px)


def _clean_end(line: Line, at: int, outwards: int, limits: tuple[int, int]) -> int | None:
    """The nearest point at an end of a window from where the line is clean: outwards, or else inwards."""
    outer = clean_from(line, at, outwards)
    return outer if outer is not None and limits[0] <= outer <= limits[1] else clean_from(line, at, -outwards)


def _beside_line(middle: FloatArray, edge: FloatArray, width_px: float) -> NDArray[np.bool_]:
    """Which edge points lie beside a line, and not beyond its ends, where it goes on."""
    seen = missed(middle, edge, width_px)
    beyond = ((seen.side == 0) & (seen.share <= 0)) | ((seen.side == len(middle) - 2) & (seen.share >= 1))
    return ~beyond
