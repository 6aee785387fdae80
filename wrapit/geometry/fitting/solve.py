"""The best cubic Bézier for each of many runs of points at once, with ends and end tangents given.

Vectors are complex numbers inside: sums over an axis of two are slow.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray, IntArray

# How often parameters are bettered before a piece is split (four times, as Schneider does), and how many
# tolerances away that is not tried. Both trade time for Béziers: 60 noisy waves of 300 points take 1134,
# 1064, 1036 with 3, 4, 5 rounds, and 1132, 1064, 1021 for 7, 10, 13 tolerances.
_ITERATIONS = 4
_HOPELESS = 10.0
Complex: TypeAlias = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces from point `first` to point `last`, with directions of travel; `cubics` once solved."""

    first: IntArray
    last: IntArray
    leaving: FloatArray
    arriving: FloatArray
    cubics: FloatArray = field(default_factory=lambda: np.zeros((0, 4, 2)))

    def __len__(self) -> int:
        return len(self.first)

    def where(self, chosen: NDArray[np.bool_]) -> Pieces:
        cubics = self.cubics[chosen] if len(self.cubics) else self.cubics
        return Pieces(
            self.first[chosen], self.last[chosen], self.leaving[chosen], self.arriving[chosen], cubics
        )


@dataclass(frozen=True, eq=False)
class _Samples:
    """The points of several pieces, one after another, with what each needs of its piece."""

    index: IntArray
    piece: IntArray
    points: Complex
    start: Complex
    stop: Complex
    leaving: Complex
    arriving: Complex

    def where(self, kept: NDArray[np.bool_], number: IntArray) -> _Samples:
        """Some of the points; `number` is the new one of each piece."""
        return _Samples(
            self.index[kept],
            number[self.piece[kept]],
            *(part[kept] for part in (self.points, self.start, self.stop, self.leaving, self.arriving)),
        )


def solve(
    points: FloatArray, along: FloatArray, pieces: Pieces, tolerance: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Best Bézier of each piece (m, 4, 2), its greatest distance (m,), and the point where that is.

    A piece is done once it is close enough, so that no piece depends on the others.
    """
    count = len(pieces)
    handles, error = np.zeros((count, 2)), np.full(count, np.inf)
    worst = np.zeros(count, dtype=np.int64)
    open_ = np.arange(count)
    index, piece = ranges(pieces.first, pieces.last)
    span = along[pieces.last] - along[pieces.first]
    u = (along[index] - along[pieces.first][piece]) / np.maximum(span, 1e-12)[piece]
    ends = points[pieces.first], points[pieces.last]
    data = _Samples(
        index, piece, _complex(points)[index], _complex(ends[0])[piece], _complex(ends[1])[piece],
        _complex(pieces.leaving)[piece], _complex(pieces.arriving)[piece],
    )  # fmt: skip
    cosine = (pieces.leaving * pieces.arriving).sum(axis=1)
    for iteration in range(_ITERATIONS):
        starts = np.searchsorted(data.piece, np.arange(len(open_)))
        found, away = _least_squares(data, u, starts, span[open_], cosine[open_])
        squared = _dot(away, away)
        handles[open_], error[open_] = found, np.sqrt(np.maximum.reduceat(squared, starts))
        # Even a piece that is close already gains from one step of better parameters.
        more = (error[open_] > tolerance) | (iteration == 0)
        # Better parameters never save a piece that misses by this much (Schneider's rule).
        lost = more & (error[open_] > _HOPELESS * tolerance)
        if iteration == _ITERATIONS - 1:
            lost = more
        if lost.any():
            worst[open_[lost]] = _peaks(squared, data, starts)[lost]
            more &= ~lost
        if not more.any():
            break
        if not more.all():
            keep = more[data.piece]
            data, away, u = data.where(keep, np.cumsum(more) - 1), away[keep], u[keep]
            found, open_ = found[more], open_[more]
        u = _nearer(data, away, u, found)
    return _cubics(pieces, ends, handles), error, worst


def _cubics(pieces: Pieces, ends: tuple[FloatArray, FloatArray], handles: FloatArray) -> FloatArray:
    return np.stack(
        [
            ends[0],
            ends[0] + handles[:, :1] * pieces.leaving,
            ends[1] - handles[:, 1:] * pieces.arriving,
            ends[1],
        ],
        axis=1,
    )


def _peaks(squared: FloatArray, data: _Samples, starts: IntArray) -> IntArray:
    """The inner point of each piece that is farthest from its curve."""
    inner = squared.copy()
    inner[starts] = inner[np.append(starts[1:], len(inner)) - 1] = -1.0
    hits = np.flatnonzero(inner == np.maximum.reduceat(inner, starts)[data.piece])
    _, firsts = np.unique(data.piece[hits], return_index=True)
    return data.index[hits[firsts]]


def _least_squares(
    data: _Samples, u: FloatArray, starts: IntArray, span: FloatArray, cosine: FloatArray
) -> tuple[FloatArray, Complex]:
    """Lengths of the best handles of each piece for given parameters, and where its points are missed."""
    s = 1 - u
    b1, b2 = 3 * u * s * s, 3 * u * u * s
    high = u * u * u + b2
    target = data.points - data.start - high * (data.stop - data.start)
    rows = np.empty((5, len(u)))
    rows[0], rows[1], rows[2] = b1 * b1, b1 * b2, b2 * b2
    rows[3] = b1 * _dot(target, data.leaving)
    rows[4] = -b2 * _dot(target, data.arriving)
    first, both, second, right0, right1 = np.add.reduceat(rows, starts, axis=1)
    cross = -cosine * both
    determinant = first * second - cross * cross
    usable = determinant > 1e-9 * np.maximum(first * second, 1e-12)
    safe = np.where(usable, determinant, 1.0)
    before = (right0 * second - right1 * cross) / safe
    after = (right1 * first - right0 * cross) / safe
    # Wu and Barsky's rule where the best handles point backwards or run wild.
    usable &= (np.minimum(before, after) > 1e-3 * span) & (np.maximum(before, after) < 1.2 * span)
    before, after = np.where(usable, before, span / 3), np.where(usable, after, span / 3)
    away = b1 * before[data.piece] * data.leaving - b2 * after[data.piece] * data.arriving - target
    return np.column_stack([before, after]), away


def _nearer(data: _Samples, away: Complex, u: FloatArray, handles: FloatArray) -> FloatArray:
    """Better parameters, by Newton's step towards the foot of each point."""
    out, in_ = handles[data.piece, 0] * data.leaving, handles[data.piece, 1] * data.arriving
    chord = data.stop - data.start - out - in_
    linear, square = chord - out, out - 2 * chord + in_
    first = 3 * (out + u * (2 * linear + u * square))
    second = 6 * (linear + u * square)
    top = _dot(away, first)
    bottom = _dot(first, first) + _dot(away, second)
    step = np.divide(top, bottom, out=np.zeros_like(top), where=bottom > 1e-12)
    return np.clip(u - np.clip(step, -0.1, 0.1), 0, 1)


def _complex(vectors: FloatArray) -> Complex:
    return np.ascontiguousarray(vectors).view(np.complex128)[:, 0]


def _dot(a: Complex, b: Complex) -> FloatArray:
    return a.real * b.real + a.imag * b.imag


def ranges(first: IntArray, last: IntArray) -> tuple[IntArray, IntArray]:
    """All whole numbers first..last (included) one after another, and which range each is from."""
    counts = last - first + 1
    piece = np.repeat(np.arange(len(first)), counts)
    offset = np.concatenate([[0], np.cumsum(counts)[:-1]])
    return np.arange(counts.sum()) - offset[piece] + first[piece], piece
