"""Curves as short straight steps, and which of these can meet: a tree over their boxes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.bezier import evaluate

# Into how many straight steps is each cubic cut? So many that in one step it hardly bends: a quarter of a
# circle turns by less than 4 degrees in each.
SAMPLES = 24
# How many pairs of boxes are looked up at a time, about: 8 MB.
_AT_ONCE = 500_000
# And before it is known how many a shape meets.
_FIRST = 256


@dataclass(frozen=True, eq=False)
class Steps:
    """All curves as straight steps: ends (m, 2, 2), curve's number (m,), parameters (m,) of their ends.

    `cubics` holds those of all curves, one after the other; `first` where each curve's begin, and
    `count` how many it has.
    """

    ends: FloatArray
    curve: IntArray
    start: FloatArray
    end: FloatArray
    cubics: FloatArray
    first: IntArray
    count: IntArray

    @cached_property
    def size(self) -> float:
        """Longest side of the box around all steps."""
        return float(np.ptp(self.ends.reshape(-1, 2), axis=0).max())

    @cached_property
    def tree(self) -> Any:
        """A tree (shapely's STRtree) over the boxes of the steps."""
        from shapely import STRtree

        return STRtree(self._lines)

    @cached_property
    def _lines(self) -> Any:
        from shapely import linestrings

        return linestrings(self.ends)

    def of(self, curve: int) -> slice:
        """Where the steps of a curve are."""
        first = int(self.first[curve])
        return slice(first * SAMPLES, (first + int(self.count[curve])) * SAMPLES)

    def pairs(self) -> Iterator[tuple[IntArray, IntArray]]:
        """Pairs of steps whose boxes meet, each once and the earlier step first, in several portions."""
        for first, second in queried(self.tree, len(self.ends), lambda some: self._lines[some]):
            apart = first < second
            yield first[apart], second[apart]

    def near(self, point: FloatArray, reach: float) -> IntArray:
        """Numbers of the steps whose boxes come within `reach` of a point, ascending."""
        from shapely import box

        # A little more, so that no distance that rounds to `reach` is missed.
        reach = reach * (1 + 1e-9) + 1e-12 * (self.size + float(np.abs(point).max()))
        (x, y) = point
        found: IntArray = np.sort(self.tree.query(box(x - reach, y - reach, x + reach, y + reach)))
        return found

    def adjacent(self, one: IntArray, other: IntArray, closed: list[bool]) -> Any:
        """Whether steps of one curve follow each other; a closed curve goes on over its seam. (n,) flags."""
        curve = self.curve[one]
        gap = np.abs(self.start[other] - self.start[one])
        round_ = np.minimum(gap, self.count[curve] - gap)
        gap = np.where(np.array(closed, dtype=bool)[curve], round_, gap)
        return (curve == self.curve[other]) & (gap < 1.5 / SAMPLES)


def steps_of(curves: list[FloatArray]) -> Steps:
    """The steps of curves, each given as its cubics (n, 4, 2)."""
    t = np.linspace(0, 1, SAMPLES + 1)
    ends, start = [], []
    for cubics in curves:
        points = evaluate(cubics, t)
        ends.append(np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 2))
        start.append((np.arange(len(cubics))[:, None] + t[None, :-1]).ravel())
    count = np.array([len(cubics) for cubics in curves], dtype=np.int64)
    at = np.concatenate(start)
    owner = np.repeat(np.arange(len(curves), dtype=np.int64), count * SAMPLES)
    return Steps(
        np.concatenate(ends),
        owner,
        at,
        at + 1 / SAMPLES,
        np.concatenate(curves),
        np.cumsum(count) - count,
        count,
    )


def queried(
    tree: Any, count: int, shapes: Callable[[slice], Any], how: Literal["intersects"] | None = None
) -> Iterator[tuple[IntArray, IntArray]]:
    """Which of `count` shapes meet which of a tree's, by their boxes or truly: numbers of both, in portions.

    The portions get smaller where very many lie on each other, so that memory stays bounded.
    """
    begin, size = 0, _FIRST
    while begin < count:
        first, second = tree.query(shapes(slice(begin, begin + size)), predicate=how)
        yield first + begin, second
        begin += size
        size = min(4 * size, max(1, size * _AT_ONCE // max(len(first), 1)))
