"""The parts of a curve that are replaced: what is tight, with room to both sides."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Final

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.steering.tight import Tight

# How far a window goes to both sides of what is tight, in radii: so much, and so much more a radian of turn.
MARGIN, MARGIN_PER_RAD = 1.0, 1.0
# Turns beyond this count no more: with more room than 3.4 radii the sides of a tip of 3° dip into each other.
MOST_COUNTED_RAD: Final = 2.4
# An end of a window this near (in radii) to a joint or to an end of the curve is put there: no short cubics.
SNAP: Final = 0.3
# A longer window (in radii) is cut in two between tight places: the work on a path grows with the cube.
# One in a hundred is longer in 70 drawings of the corpus and of public clipart.
MOST: Final = 24.0
# A cut leaves at least this share of the tight places on either side.
LEAST_SHARE: Final = 0.25


@dataclass(frozen=True)
class Window:
    """Lengths between which a curve is replaced, the end beyond the curve's where it goes over the start.

    `spans` are the numbers of the tight places inside; `cuts` are the pairs of tight places between which it
    was cut off from the next.
    """

    start: float
    end: float
    spans: tuple[int, ...]
    cuts: frozenset[frozenset[int]] = frozenset()

    @property
    def ends(self) -> tuple[float, float]:
        """Both lengths."""
        return self.start, self.end

    @property
    def length(self) -> float:
        """From end to end."""
        return self.end - self.start


@dataclass(frozen=True, eq=False)
class Windows:
    """How a curve is divided: `reach` (n + 1,) are the lengths at its joints and ends.

    A closed curve's start is `held` where it has to stay.
    """

    reach: FloatArray
    radius: float
    closed: bool
    held: bool

    @property
    def length(self) -> float:
        """Of the whole curve."""
        return float(self.reach[-1])

    def around(
        self, tight: list[Tight], wide: FloatArray, whole: Collection[frozenset[int]] = ()
    ) -> list[Window]:
        """Tight places with room to both sides, so many times the usual (n,); those that meet as one.

        Long ones are cut, but not between pairs that are to stay `whole`.
        """
        found: list[Window] = []
        for number, (place, factor) in enumerate(zip(tight, wide, strict=True)):
            margin = self.radius * factor * (MARGIN + MARGIN_PER_RAD * min(place.turn, MOST_COUNTED_RAD))
            start, end = self._snapped(place.start - margin, -1), self._snapped(place.end + margin, 1)
            found.append(Window(start, end, (number,)))
        found = _merged(sorted(found, key=lambda window: window.start))
        if self.closed:
            found = self._closed_up(found)
        cut = [part for window in found for part in self._cut(window, tight, whole)]
        if self.closed:
            cut = [self._round(part) for part in cut]  # one over the start may be cut beyond it
        return sorted(cut, key=lambda window: window.start)

    def _cut(self, window: Window, tight: list[Tight], whole: Collection[frozenset[int]]) -> list[Window]:
        """The window in parts, each cut where its tight places near the middle are farthest apart."""
        if window.length <= MOST * self.radius or (self.closed and window.length >= self.length):
            return [window]  # what goes all round has no ends to be cut between
        laps = {
            n: self.length if tight[n].start < window.start - SNAP * self.radius else 0.0
            for n in window.spans
        }
        spans = sorted(window.spans, key=lambda n: tight[n].start + laps[n])
        least = max(1, round(LEAST_SHARE * len(spans)))
        gaps = [
            (tight[b].start + laps[b] - tight[a].end - laps[a], k)
            for k, (a, b) in enumerate(itertools.pairwise(spans), 1)
            if least <= k <= len(spans) - least and frozenset((a, b)) not in whole
        ]
        if not gaps:
            return [window]
        gap, k = max(gaps)
        at = tight[spans[k]].start + laps[spans[k]] - gap / 2
        pair = frozenset({frozenset(spans[k - 1 : k + 1])})
        parts = (
            Window(window.start, at, tuple(spans[:k]), window.cuts | pair),
            Window(at, window.end, tuple(spans[k:]), window.cuts | pair),
        )
        return [each for part in parts for each in self._cut(part, tight, whole)]

    def _closed_up(self, found: list[Window]) -> list[Window]:
        """Windows of a closed curve, of which the last may meet the first."""
        first, last = found[0], found[-1]
        if len(found) > 1 and last.end - self.length >= first.start:
            end = max(last.end, first.end + self.length)
            found = _merged([*found[1:-1], Window(last.start, end, first.spans + last.spans)])
        found = [self._round(window) for window in found]
        if self.held and any(window.end > self.length for window in found):
            # A path through the start can't keep it, but one that goes all round can.
            return [Window(0.0, self.length, tuple(number for window in found for number in window.spans))]
        return sorted(found, key=lambda window: window.start)

    def _round(self, window: Window) -> Window:
        """The window of a closed curve, started on it, and all of it if hardly anything is left."""
        if window.length >= self.length - SNAP * self.radius:
            return replace(window, start=0.0, end=self.length)
        laps = math.floor(window.start / self.length) * self.length
        return replace(window, start=window.start - laps, end=window.end - laps)

    def _snapped(self, at: float, side: int) -> float:
        """An end of a window, moved outward to a joint just beyond it; never beyond an open curve's ends."""
        near = SNAP * self.radius
        if not self.closed:
            if at < 2 * near:
                return 0.0
            if at > self.length - 2 * near:
                return self.length
        beyond = self.reach[(side * (self.reach - at) >= 0) & (side * (self.reach - at) <= near)]
        return float(beyond[0 if side > 0 else -1]) if len(beyond) else at


def _merged(windows: list[Window]) -> list[Window]:
    """Windows in order of their starts, those that meet as one."""
    merged: list[Window] = []
    for window in windows:
        if merged and window.start <= merged[-1].end:
            last = merged[-1]
            merged[-1] = Window(last.start, max(last.end, window.end), last.spans + window.spans)
        else:
            merged.append(window)
    return merged
