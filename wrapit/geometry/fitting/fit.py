"""Cubic Béziers through measured points, with ends and end tangents given.

The method is Schneider's ("An algorithm for automatically fitting digitized curves", Graphics Gems,
1990), for many strokes at once: all pieces of a level are solved in one vector operation, those that
miss the tolerance are split, and neighbours that fit one Bézier together are merged at the end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.geometry.arrays import FloatArray, IntArray, unit
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.fitting.solve import Pieces, ranges, solve
from wrapit.geometry.polyline import lengths


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
    along = lengths(points)
    course = _Course(points, along, firsts, lasts, 4 * tolerance if reach is None else reach)
    pieces = Pieces(
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
        index, piece = ranges(at - half, at + half)
        weight = self.along[index] - self.along[at][piece]
        starts = np.concatenate([[0], np.cumsum(2 * half + 1)[:-1]])
        return unit(np.add.reduceat(weight[:, None] * (self.points[index] - self.points[at][piece]), starts))


def _split_until_close(course: _Course, pieces: Pieces, tolerance: float) -> Pieces:
    done: list[Pieces] = []
    while len(pieces):
        cubics, error, worst = solve(course.points, course.along, pieces, tolerance)
        close = (error <= tolerance) | (pieces.last - pieces.first < 2)
        done.append(
            Pieces(
                pieces.first[close],
                pieces.last[close],
                pieces.leaving[close],
                pieces.arriving[close],
                cubics[close],
            )
        )
        pieces, at = pieces.where(~close), worst[~close]
        middle = course.tangents(at) if len(at) else np.zeros((0, 2))
        pieces = Pieces(
            np.concatenate([pieces.first, at]),
            np.concatenate([at, pieces.last]),
            np.concatenate([pieces.leaving, middle]),
            np.concatenate([middle, pieces.arriving]),
        )
    return _sorted(done)


def _merged(course: _Course, pieces: Pieces, tolerance: float) -> Pieces:
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
        trial = Pieces(
            pieces.first[left], pieces.last[left + 1], pieces.leaving[left], pieces.arriving[left + 1]
        )
        cubics, error, _ = solve(course.points, course.along, trial, tolerance)
        good = error <= tolerance
        failed |= set(zip(trial.first[~good].tolist(), trial.last[~good].tolist(), strict=True))
        idle = 0 if good.any() else idle + 1
        rest = np.ones(len(pieces), dtype=bool)
        rest[left[good]] = rest[left[good] + 1] = False
        new = trial.where(good)
        pieces = _sorted(
            [
                pieces.where(rest),
                Pieces(new.first, new.last, new.leaving, new.arriving, cubics[good]),
            ]
        )
    return pieces


def _sorted(parts: list[Pieces]) -> Pieces:
    first = np.concatenate([part.first for part in parts])
    order = np.argsort(first, kind="stable")
    return Pieces(
        first[order],
        np.concatenate([part.last for part in parts])[order],
        np.concatenate([part.leaving for part in parts])[order],
        np.concatenate([part.arriving for part in parts])[order],
        np.concatenate([part.cubics for part in parts if len(part)])[order],
    )
