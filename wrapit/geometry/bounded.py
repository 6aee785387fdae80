"""Curves made gentle: the nearest curve that nowhere bends more tightly than a radius."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np

from wrapit.geometry.arclength import piece
from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, joined
from wrapit.geometry.steering.paths import Held
from wrapit.geometry.steering.replacing import FINE, New, crossings, replaced
from wrapit.geometry.steering.tight import Tight, tight_places
from wrapit.geometry.steering.windows import Window, Windows

# A window in which no path is found is widened by this, so often.
WIDER, TRIES = 1.4, 6
# A path that strays farther than this (in radii) is compared with that of a wider window.
FAR: Final = 1.0
# A part this short (of the curve) is none.
NOTHING: Final = 1e-9


@dataclass(frozen=True, eq=False)
class Bounded:
    """The gentle curve, how far it and the old one lie apart at most, and which lengths of the old one went.

    A last one of a closed curve may end beyond its length.
    """

    curve: BezierChain
    deviation: float
    spans: tuple[tuple[float, float], ...]


def bounded(
    curve: BezierChain, radius: float, start: Held = "pinned", end: Held = "pinned", closed: bool = False
) -> Bounded | None:
    """The curve with each tight place replaced by the nearest path of that least radius; None without one.

    An end that is pinned keeps its place and direction, one that is placed its place; a free one may move. A
    closed curve goes on smoothly over its start, which `start` holds (its direction only where there is no
    corner); `end` then means nothing. A curve that is gentle already is returned itself. Raises ValueError
    for a closed curve with a gap.
    """
    return Bounding(curve, radius, closed).held(start, end)


@dataclass(frozen=True, eq=False)
class Bounding:
    """A curve to be `bounded`, with its ends held in several ways: what they share is found once."""

    curve: BezierChain
    radius: float
    closed: bool = False
    _paths: dict[tuple[float, float, Held, Held, bool], New | None] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        if self.closed and not np.array_equal(self.curve.start, self.curve.end):
            raise ValueError("a closed curve ends where it starts")

    @cached_property
    def tight(self) -> list[Tight]:
        """Where it bends too tightly."""
        return tight_places(self.curve, self.radius, self.closed)

    @cached_property
    def _reach(self) -> FloatArray:
        return np.concatenate([[0.0], np.cumsum(self.curve.lengths)])

    @cached_property
    def _crossings(self) -> int:
        return crossings(self.curve, self.radius)

    def held(self, start: Held, end: Held) -> Bounded | None:
        """What `bounded` gives with the ends held so."""
        curve, radius = self.curve, self.radius
        if not self.tight:
            return Bounded(curve, 0.0, ())
        division = Windows(self._reach, radius, self.closed, start != "free")
        length = division.length
        wide = np.ones(len(self.tight))
        best: Bounded | None = None
        whole: set[frozenset[int]] = set()
        for _ in range(TRIES):
            windows = division.around(self.tight, wide, whole)
            paths = {window: self._path(window, length, (start, end)) for window in windows}
            new = {window: path for window, path in paths.items() if path is not None}
            result = _assembled(curve, length, new) if len(new) == len(windows) else None
            if result is None:
                widened = [window for window in windows if window not in new]
            elif crossings(result.curve, radius) > self._crossings:
                widened = _crossing(curve, length, radius, new) or windows
            elif best is None and result.deviation > FAR * radius:
                best, widened = result, [window for window in windows if new[window].deviation > FAR * radius]
            else:
                return result if best is None or result.deviation < best.deviation else best
            if all(window.length >= length for window in widened):
                break
            for window in widened:
                wide[list(window.spans)] *= WIDER
                whole |= window.cuts
        return best

    def _path(self, window: Window, length: float, ends: tuple[Held, Held]) -> New | None:
        """What takes the place of a window of the curve, whose ends are held as told; None if nothing can."""
        whole = window.start <= 0, window.end >= length
        over = window.end > length
        ring = self.closed and all(whole) and not over
        start = ends[0] if ring or (whole[0] and not self.closed) else "pinned"
        end = ends[1] if whole[1] and not self.closed else "pinned"
        key = (*window.ends, start, end, ring)
        if key not in self._paths:
            if over:
                parts = piece(self.curve, window.start, length), piece(self.curve, 0.0, window.end - length)
                part = joined(parts)
            else:
                part = piece(self.curve, window.start, window.end)
            self._paths[key] = replaced(part, self.radius, start, end, ring)
        return self._paths[key]


def _assembled(curve: BezierChain, length: float, new: dict[Window, New]) -> Bounded:
    """What is gentle as it was, with the new paths between."""
    parts: list[BezierChain] = []
    at, stop, last = 0.0, length, None
    for window, path in new.items():
        if window.end > length and window.length < length:
            last, first = _divided(path.curve, curve.start)
            at, stop = window.end - length, window.start
            parts.append(first)
    for window, path in new.items():
        if window.start >= stop:
            continue
        if window.start > at + NOTHING * length:
            parts.append(piece(curve, at, window.start))
        parts.append(path.curve)
        at = window.end
    if stop > at + NOTHING * length:
        parts.append(piece(curve, at, stop))
    if last is not None:
        parts.append(last)
    deviation = max(path.deviation for path in new.values())
    spans = tuple((float(window.start), float(window.end)) for window in new)
    return Bounded(_chained(parts), deviation, spans)


def _crossing(curve: BezierChain, length: float, radius: float, new: dict[Window, New]) -> list[Window]:
    """The windows whose new paths cross one another, or what stays of the curve."""
    import shapely

    windows, parts = list(new), [path.curve for path in new.values()]
    at = max(0.0, windows[-1].end - length) if windows[-1].length < length else 0.0
    for window in (*windows, Window(length, length, ())):
        if window.start > at + NOTHING * length:
            parts.append(piece(curve, at, min(window.start, length)))
        at = max(at, window.end)
    lines = [shapely.LineString(part.sampled(FINE * radius)) for part in parts]
    crossed = set(shapely.STRtree(lines).query(lines, predicate="crosses").ravel().tolist())
    return [window for number, window in enumerate(windows) if number in crossed]


def _divided(path: BezierChain, near: FloatArray) -> tuple[BezierChain, BezierChain]:
    """A chain before and after its place nearest to a point."""
    from shapely import LineString, Point

    line = LineString(path.sampled(path.length / 2000))
    share = line.project(Point(near), normalized=True)
    at = float(np.clip(share, 0.01, 0.99)) * path.length
    return piece(path, 0.0, at), piece(path, at, path.length)


def _chained(parts: list[BezierChain]) -> BezierChain:
    """One chain of parts whose ends are the same but for rounding."""
    points = np.concatenate([part.points for part in parts])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)
