"""Cubic Béziers through measured points, with ends and end tangents given.

The method is Schneider's ("An algorithm for automatically fitting digitized curves", Graphics Gems,
1990), for many strokes at once: all pieces of a level are solved in one vector operation, those that
miss the tolerance are split, and neighbours that fit one Bézier together are merged at the end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray, IntArray, unit
from wrapit.geometry.bezier import BezierChain

_ITERATIONS = 5
_HOPELESS = 10.0


@dataclass(frozen=True, eq=False)
class Stroke:
    """Points (n, 2) from end to end, with unit directions of travel (2,) at the start and the end."""

    points: FloatArray
    start_tangent: FloatArray
    end_tangent: FloatArray


def fit(stroke: Stroke, tolerance: float) -> BezierChain:
    """One stroke as a G1 chain; see `fit_all`."""
    return fit_all([stroke], tolerance)[0]


def fit_all(strokes: Sequence[Stroke], tolerance: float, reach: float | None = None) -> list[BezierChain]:
    """G1 chains no farther than `tolerance` from the points, with the given ends and tangents exactly.

    `reach` is the length over which the tangent at a joint is measured (4 tolerances unless given).
    Raises ValueError for a stroke of fewer than two points.
    """
    if not strokes:
        return []
    if any(len(stroke.points) < 2 for stroke in strokes):
        raise ValueError("a stroke has at least two points")
    points = np.concatenate([stroke.points for stroke in strokes])
    lasts = np.cumsum([len(stroke.points) for stroke in strokes]) - 1
    firsts = np.concatenate([[0], lasts[:-1] + 1])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    course = _Course(points, along, firsts, lasts, 4 * tolerance if reach is None else reach)
    pieces = _Pieces(
        firsts,
        lasts,
        unit(np.array([stroke.start_tangent for stroke in strokes], dtype=np.float64)),
        unit(np.array([stroke.end_tangent for stroke in strokes], dtype=np.float64)),
    )
    done = _merged(course, _split_until_close(course, pieces, tolerance), tolerance)
    belongs = np.searchsorted(lasts, done.last)
    return [BezierChain(done.cubics[belongs == index]) for index in range(len(strokes))]


@dataclass(frozen=True, eq=False)
class _Course:
    """All points, their arc length, and the first and last point of each stroke."""

    points: FloatArray
    along: FloatArray
    firsts: IntArray
    lasts: IntArray
    reach: float

    def tangents(self, at: IntArray) -> FloatArray:
        """Directions of travel at inner points, from a line through the points within reach."""
        stroke = np.searchsorted(self.lasts, at)
        first, last = self.firsts[stroke], self.lasts[stroke]
        low = np.searchsorted(self.along, self.along[at] - self.reach)
        high = np.searchsorted(self.along, self.along[at] + self.reach, side="right") - 1
        # The window is symmetric, or a bend would turn the tangent.
        half = np.maximum(np.minimum(np.minimum(at - first, last - at), np.minimum(at - low, high - at)), 1)
        index, piece = _ranges(at - half, at + half)
        weight = self.along[index] - self.along[at][piece]
        starts = np.concatenate([[0], np.cumsum(2 * half + 1)[:-1]])
        return unit(np.add.reduceat(weight[:, None] * (self.points[index] - self.points[at][piece]), starts))


@dataclass(frozen=True, eq=False)
class _Pieces:
    """Pieces from point `first` to point `last`, with directions of travel; `cubics` once solved."""

    first: IntArray
    last: IntArray
    leaving: FloatArray
    arriving: FloatArray
    cubics: FloatArray = field(default_factory=lambda: np.zeros((0, 4, 2)))

    def __len__(self) -> int:
        return len(self.first)

    def where(self, chosen: NDArray[np.bool_]) -> _Pieces:
        cubics = self.cubics[chosen] if len(self.cubics) else self.cubics
        return _Pieces(
            self.first[chosen], self.last[chosen], self.leaving[chosen], self.arriving[chosen], cubics
        )


def _split_until_close(course: _Course, pieces: _Pieces, tolerance: float) -> _Pieces:
    done: list[_Pieces] = []
    while len(pieces):
        cubics, error, worst = _solve(course, pieces, tolerance)
        close = (error <= tolerance) | (pieces.last - pieces.first < 2)
        done.append(
            _Pieces(
                pieces.first[close],
                pieces.last[close],
                pieces.leaving[close],
                pieces.arriving[close],
                cubics[close],
            )
        )
        pieces, at = pieces.where(~close), worst[~close]
        middle = course.tangents(at) if len(at) else np.zeros((0, 2))
        pieces = _Pieces(
            np.concatenate([pieces.first, at]),
            np.concatenate([at, pieces.last]),
            np.concatenate([pieces.leaving, middle]),
            np.concatenate([middle, pieces.arriving]),
        )
    return _sorted(done)


def _merged(course: _Course, pieces: _Pieces, tolerance: float) -> _Pieces:
    """Joins neighbours that one Bézier fits too, until none is left."""
    parity, idle = 0, 0
    failed: set[tuple[int, int]] = set()
    while idle < 2 and len(pieces) > 1:
        same = np.searchsorted(course.lasts, pieces.last)
        rank = np.arange(len(pieces)) - np.searchsorted(same, same)
        left = np.flatnonzero((same[:-1] == same[1:]) & (rank[:-1] % 2 == parity))
        parity = 1 - parity
        spans = zip(pieces.first[left].tolist(), pieces.last[left + 1].tolist(), strict=True)
        left = left[np.array([span not in failed for span in spans], dtype=bool)]
        if not len(left):
            idle += 1
            continue
        trial = _Pieces(
            pieces.first[left], pieces.last[left + 1], pieces.leaving[left], pieces.arriving[left + 1]
        )
        cubics, error, _ = _solve(course, trial, tolerance)
        good = error <= tolerance
        failed |= set(zip(trial.first[~good].tolist(), trial.last[~good].tolist(), strict=True))
        idle = 0 if good.any() else idle + 1
        rest = np.ones(len(pieces), dtype=bool)
        rest[left[good]] = rest[left[good] + 1] = False
        new = trial.where(good)
        pieces = _sorted(
            [
                pieces.where(rest),
                _Pieces(new.first, new.last, new.leaving, new.arriving, cubics[good]),
            ]
        )
    return pieces


def _sorted(parts: list[_Pieces]) -> _Pieces:
    first = np.concatenate([part.first for part in parts])
    order = np.argsort(first, kind="stable")
    return _Pieces(
        first[order],
        np.concatenate([part.last for part in parts])[order],
        np.concatenate([part.leaving for part in parts])[order],
        np.concatenate([part.arriving for part in parts])[order],
        np.concatenate([part.cubics for part in parts if len(part)])[order],
    )


def _solve(course: _Course, pieces: _Pieces, tolerance: float) -> tuple[FloatArray, FloatArray, IntArray]:
    """Best Bézier of each piece (m, 4, 2), its greatest distance (m,), and the point where that is.

    A piece is done once it is close enough, so that no piece depends on the others.
    """
    count = len(pieces)
    cubics, error = np.zeros((count, 4, 2)), np.full(count, np.inf)
    worst = np.zeros(count, dtype=np.int64)
    open_ = np.arange(count)
    index, piece = _ranges(pieces.first, pieces.last)
    span = course.along[pieces.last] - course.along[pieces.first]
    u = (course.along[index] - course.along[pieces.first][piece]) / np.maximum(span, 1e-12)[piece]
    for iteration in range(_ITERATIONS):
        points = course.points[index]
        starts = np.concatenate([[0], np.cumsum(pieces.last - pieces.first + 1)[:-1]])
        found = _least_squares(course, pieces, points, u, piece, starts)
        on, first, second = _at(found[piece], u)
        away = on - points
        squared = (away * away).sum(axis=1)
        peak = np.maximum.reduceat(squared, starts)
        cubics[open_], error[open_] = found, np.sqrt(peak)
        # Even a piece that is close already gains from one step of better parameters.
        more = (error[open_] > tolerance) | (iteration == 0)
        # Better parameters never save a piece that misses by this much (Schneider's rule).
        hopeless = more & (error[open_] > _HOPELESS * tolerance)
        if hopeless.any():
            worst[open_[hopeless]] = _peaks(squared, index, piece, starts, pieces)[hopeless]
            more &= ~hopeless
        if not more.any():
            break
        if iteration == _ITERATIONS - 1:
            worst[open_[more]] = _peaks(squared, index, piece, starts, pieces)[more]
            break
        # Newton's step towards the foot of each point.
        top = (away * first).sum(axis=1)
        bottom = (first * first).sum(axis=1) + (away * second).sum(axis=1)
        step = np.divide(top, bottom, out=np.zeros_like(top), where=bottom > 1e-12)
        u = np.clip(u - np.clip(step, -0.1, 0.1), 0, 1)
        keep = more[piece]
        index, u, pieces, open_ = index[keep], u[keep], pieces.where(more), open_[more]
        piece = (np.cumsum(more) - 1)[piece[keep]]
    return cubics, error, worst


def _peaks(
    squared: FloatArray, index: IntArray, piece: IntArray, starts: IntArray, pieces: _Pieces
) -> IntArray:
    """The inner point of each piece that is farthest from its curve."""
    inner = np.where((index > pieces.first[piece]) & (index < pieces.last[piece]), squared, -1.0)
    hits = np.flatnonzero(inner == np.maximum.reduceat(inner, starts)[piece])
    _, firsts = np.unique(piece[hits], return_index=True)
    return index[hits[firsts]]


def _least_squares(
    course: _Course, pieces: _Pieces, points: FloatArray, u: FloatArray, piece: IntArray, starts: IntArray
) -> FloatArray:
    """Handles of the best Bézier of each piece for given parameters."""
    ends = course.points[pieces.first], course.points[pieces.last]
    span = course.along[pieces.last] - course.along[pieces.first]
    s = 1 - u
    b1, b2 = 3 * u * s * s, 3 * u * u * s
    low = s * s * s + b1
    target = points - low[:, None] * ends[0][piece] - (1 - low)[:, None] * ends[1][piece]
    sums = np.add.reduceat(
        np.column_stack([b1 * b1, b1 * b2, b2 * b2, b1[:, None] * target, b2[:, None] * target]), starts
    )
    cross = -(pieces.leaving * pieces.arriving).sum(axis=1) * sums[:, 1]
    right0 = (sums[:, 3:5] * pieces.leaving).sum(axis=1)
    right1 = -(sums[:, 5:7] * pieces.arriving).sum(axis=1)
    determinant = sums[:, 0] * sums[:, 2] - cross * cross
    usable = determinant > 1e-9 * np.maximum(sums[:, 0] * sums[:, 2], 1e-12)
    safe = np.where(usable, determinant, 1.0)
    before = (right0 * sums[:, 2] - right1 * cross) / safe
    after = (right1 * sums[:, 0] - right0 * cross) / safe
    # Wu and Barsky's rule where the best handles point backwards or run wild.
    usable &= (np.minimum(before, after) > 1e-3 * span) & (np.maximum(before, after) < 1.2 * span)
    before, after = np.where(usable, before, span / 3), np.where(usable, after, span / 3)
    return np.stack(
        [
            ends[0],
            ends[0] + before[:, None] * pieces.leaving,
            ends[1] - after[:, None] * pieces.arriving,
            ends[1],
        ],
        axis=1,
    )


def _at(cubics: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Point and two derivatives of one cubic per parameter."""
    a, b, c, d = (cubics[:, k] for k in range(4))
    u = u[:, None]
    cube, square, line = d - 3 * c + 3 * b - a, 3 * (c - 2 * b + a), 3 * (b - a)
    return (
        ((cube * u + square) * u + line) * u + a,
        (3 * cube * u + 2 * square) * u + line,
        6 * cube * u + 2 * square,
    )


def _ranges(first: IntArray, last: IntArray) -> tuple[IntArray, IntArray]:
    """All whole numbers first..last (included) one after another, and which range each is from."""
    counts = last - first + 1
    piece = np.repeat(np.arange(len(first)), counts)
    offset = np.concatenate([[0], np.cumsum(counts)[:-1]])
    return np.arange(counts.sum()) - offset[piece] + first[piece], piece
