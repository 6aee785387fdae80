"""Curves for a laser without spans that are too short to be cut smoothly."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, Line
from wrapit.geometry.arrays import norms, unit
from wrapit.geometry.bezier import derivative, evaluate
from wrapit.geometry.outlines.closing import SHORT_MM
from wrapit.geometry.polyline import steps

# How near does one cubic follow two, and how sharp may the joint be that goes? Side by side with a beam of
# 0.1 mm and more; 1.4° is what lies between the short lines of a side that has no exact curve.
MERGED_MM, SMOOTH_RAD = 1e-3, math.radians(6)
_PLACES = np.linspace(0, 1, 9)


def without_short_spans(chain: BezierChain, *, closed: bool) -> BezierChain:
    """The chain with each span under SHORT_MM joined to a neighbour where they are smooth, else left out.

    Where it is left out the neighbours are led to the point where their tangents meet, or half-way: half of
    SHORT_MM at most from what was. Two spans always stay.
    """
    spans = [span.copy() for span in chain.points]
    while len(spans) > 2:
        sizes = _sizes(np.array(spans))
        at = int(np.argmin(sizes))
        if sizes[at] >= SHORT_MM:
            break
        if not _joined(spans, at, closed=closed):
            _left_out(spans, at, closed=closed)
    return BezierChain(np.array(spans))


def without_short_lines(edges: Sequence[Line], *, closed: bool) -> list[Line]:
    """A polyline without points nearer than SHORT_MM to the one before; an open one keeps its ends."""
    points = [edge.start for edge in edges] + ([] if closed else [edges[-1].end])
    kept = points[:1]
    for point in points[1:]:
        if math.dist(kept[-1], point) >= SHORT_MM:
            kept.append(point)
    if closed:
        while len(kept) > 3 and math.dist(kept[-1], kept[0]) < SHORT_MM:
            kept.pop()
    elif kept[-1] != points[-1]:
        kept[max(1, len(kept) - 1) :] = points[-1:]
    ends = [*kept[1:], kept[0]] if closed else kept[1:]
    few = len(kept) < (3 if closed else 2)
    return list(edges) if few else [Line(a, b) for a, b in zip(kept, ends, strict=False)]


def _joined(spans: list[FloatArray], at: int, *, closed: bool) -> bool:
    """Makes one of the span and its shorter neighbour, or its other one; False where neither allows it."""
    last = len(spans) - 1
    pairs = [(at - 1, at), (at, at + 1)]
    if closed:
        pairs = [(a % (last + 1), b % (last + 1)) for a, b in pairs]
    pairs = [(a, b) for a, b in pairs if a >= 0 and b <= last]
    pairs.sort(key=lambda pair: _size(spans[pair[0]]) + _size(spans[pair[1]]))
    for first, second in pairs:
        cubic = _merged(spans[first], spans[second])
        if cubic is not None:
            spans[first] = cubic
            del spans[second]
            return True
    return False


def _merged(before: FloatArray, after: FloatArray) -> FloatArray | None:
    """One cubic for two, with their ends and end tangents; None where it strays or there is a corner."""
    (_, arriving), (leaving, _) = _tangents(before), _tangents(after)
    if float(arriving @ leaving) < math.cos(SMOOTH_RAD):
        return None
    first, last = _tangents(before)[0], _tangents(after)[1]
    third = (_size(before) + _size(after)) / 3
    cubic = np.array([before[0], before[0] + third * first, after[3] - third * last, after[3]])
    places = np.linspace(0, 1, 65)
    got, along = evaluate(cubic[None], places)[0], unit(derivative(cubic[None], places)[0])
    own = evaluate(np.stack([before, after]), _PLACES).reshape(-1, 2)
    apart = own[:, None] - got
    nearest = norms(apart).argmin(axis=1)
    rest = apart[np.arange(len(own)), nearest]
    aside = rest[:, 0] * along[nearest, 1] - rest[:, 1] * along[nearest, 0]
    return cubic if float(np.abs(aside).max()) <= MERGED_MM else None


def _left_out(spans: list[FloatArray], at: int, *, closed: bool) -> None:
    """Takes one span out; its neighbours are led to a common point, or its one neighbour to its far end."""
    short, last = spans[at], len(spans) - 1
    before = spans[at - 1] if closed or at > 0 else None
    after = spans[(at + 1) % (last + 1)] if closed or at < last else None
    if before is None:
        point = short[0]
    elif after is None:
        point = short[3]
    else:
        point = _meeting(short[0], _tangents(before)[1], short[3], _tangents(after)[0])
    if before is not None:
        before[2:] += point - short[0]
        before[3] = point
    if after is not None:
        after[:2] += point - short[3]
        after[0] = point
    del spans[at]


def _meeting(start: FloatArray, arriving: FloatArray, end: FloatArray, leaving: FloatArray) -> FloatArray:
    """Where the tangents at both ends of a span meet, if that is near; else half-way."""
    cross = float(arriving[0] * leaving[1] - arriving[1] * leaving[0])
    chord, half = end - start, (start + end) / 2
    if abs(cross) < math.sin(SMOOTH_RAD):
        return np.asarray(half)
    ahead = float(chord[0] * leaving[1] - chord[1] * leaving[0]) / cross
    point = start + ahead * arriving
    return np.asarray(point if float(np.linalg.norm(point - half)) <= SHORT_MM / 2 else half)


def _tangents(cubic: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit directions of travel at both ends."""
    one = BezierChain(cubic[None])
    return one.start_tangent, one.end_tangent


def _size(cubic: FloatArray) -> float:
    return float(_sizes(cubic[None])[0])


def _sizes(cubics: FloatArray) -> FloatArray:
    """Lengths (n,) of cubics (n, 4, 2) along eight chords: never longer than they are."""
    return np.asarray(steps(evaluate(cubics, _PLACES)).sum(axis=1))
