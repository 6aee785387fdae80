"""Drawings in several pieces: the largest is kept, or near ones are joined by straight links."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

import numpy as np

from wrapit.config.tracing import Components
from wrapit.drawing.assembly import Piece, bounds
from wrapit.drawing.changes import Change, Notice
from wrapit.drawing.spots import Spot, spots_of_outlines
from wrapit.geometry import BezierChain, FloatArray, IntArray, straight
from wrapit.geometry.bezier import evaluate, split
from wrapit.geometry.disjoint_sets import Sets

# How far apart may pieces be that are joined on request? In sizes of the drawing: a link across more of it
# would be a part of the drawing that nobody drew.
LONGEST_LINK = 0.25
# A piece that is worth joining is so many times as long as its link, at least.
_WORTH_A_LINK = 2.0
# How many pieces that are left out are named each by its place; a page of text has hundreds.
_NAMED = 8
# Where a cubic is looked at for its nearest place to another: a link may start a 64th of it beside that.
_SHARES = np.linspace(0, 1, 33)


@dataclass(eq=False)
class Connected:
    """Places and pieces of one connected drawing, and what was left out or added for that."""

    places: dict[int, FloatArray]
    pieces: list[Piece]
    changes: list[Change] = field(default_factory=list)
    notices: list[Notice] = field(default_factory=list)
    spots: list[Spot] = field(default_factory=list)


@dataclass(frozen=True)
class Gap:
    """The shortest way between two groups: its length, and on either the piece's index and parameter."""

    length: float
    on_one: tuple[int, float]
    on_other: tuple[int, float]


@dataclass(frozen=True, eq=False)
class _Samples:
    """Points (n, 2) along pieces, and for each the piece's index and its parameter there."""

    points: FloatArray
    piece: IntArray
    at: FloatArray


def connect(places: dict[int, FloatArray], pieces: list[Piece], how: Components, longest: float) -> Connected:
    """One connected drawing: others are joined where `how` says so and the link is at most `longest`.

    Weighed, only those are that lie within the box of the largest, which so keeps its size, and are worth it.

    What stays apart is left out, with a warning that names the place. The nearest group is always the next
    to be joined (Prim's method for the shortest tree), so the work grows with the square of the groups.
    """
    groups = _groups(pieces)
    if len(groups) == 1:
        return Connected(places, pieces)
    result = Connected(dict(places), groups[0])
    box = bounds([piece.curve for piece in groups[0]])
    near = [group for group in groups[1:] if how == "join" or (how == "weigh" and _is_within(group, box))]
    rest = [group for group in groups[1:] if group not in near]
    known: dict[Piece, _Samples] = {}
    apart = [_samples(group, known) for group in near]
    while apart:
        gaps = _gaps(result.pieces, apart, known)
        best = min(range(len(near)), key=lambda k: (gaps[k].length, k))
        if gaps[best].length > longest:
            break
        del apart[best]
        group = near.pop(best)
        if how == "weigh" and _length(group) < _WORTH_A_LINK * gaps[best].length:
            rest.append(group)
        else:
            _link(result, group, gaps[best])
    rest = sorted((*rest, *near), key=lambda group: -_length(group))
    for k, group in enumerate(rest):
        _leave_out(result, group, named=k < _NAMED)
    if len(rest) > _NAMED:
        result.notices.append(
            Notice("warning", "left-out", (0.0, 0.0), f"{len(rest) - _NAMED} more pieces are left out")
        )
    return result


def _is_within(group: list[Piece], box: tuple[FloatArray, FloatArray]) -> bool:
    low, high = bounds([piece.curve for piece in group])
    return bool((low >= box[0]).all() and (high <= box[1]).all())


def _length(group: list[Piece]) -> float:
    return sum(piece.curve.length for piece in group)


def _leave_out(result: Connected, group: list[Piece], named: bool) -> None:
    points = np.concatenate([piece.curve.points.reshape(-1, 2) for piece in group])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    length = _length(group)
    at = (float(middle[0]), float(middle[1]))
    result.changes.append(Change("piece", at, length, "not connected to the largest piece"))
    result.spots += spots_of_outlines([piece.curve.points for piece in group] if len(group) == 1 else [])
    if named:
        result.notices.append(
            Notice(
                "warning",
                "left-out",
                at,
                "a piece of the drawing that touches nothing else is left out",
                "connect it in the drawing, or set tracing.components to join",
            )
        )


def _groups(pieces: list[Piece]) -> list[list[Piece]]:
    """Connected groups of pieces, the longest first."""
    together = Sets()
    for piece in pieces:
        together.merge(piece.start, piece.end)
    groups: dict[int, list[Piece]] = {}
    for piece in pieces:
        groups.setdefault(together.find(piece.start), []).append(piece)
    if len(groups) == 1:
        return [pieces]
    return sorted(groups.values(), key=lambda group: -_length(group))


def _gaps(one: list[Piece], others: list[_Samples], known: dict[Piece, _Samples]) -> list[Gap]:
    """Shortest gap from a group to each of several others: one tree for them all."""
    from scipy.spatial import cKDTree

    own = _samples(one, known)
    far, index = cKDTree(own.points).query(np.concatenate([other.points for other in others]))
    bounds = np.cumsum([0, *(len(other.points) for other in others)]).tolist()
    gaps = []
    for other, (low, high) in zip(others, itertools.pairwise(bounds), strict=True):
        k = int(np.argmin(np.round(far[low:high], 9)))
        at = int(index[low + k])
        gaps.append(
            Gap(
                float(far[low + k]),
                (int(own.piece[at]), float(own.at[at])),
                (int(other.piece[k]), float(other.at[k])),
            )
        )
    return gaps


def _samples(group: list[Piece], known: dict[Piece, _Samples]) -> _Samples:
    """Points along the pieces of a group; those of pieces that are `known` are not worked out again."""
    for piece in group:
        if piece not in known:
            count = len(piece.curve)
            points = evaluate(piece.curve.points, _SHARES).reshape(-1, 2)
            at = (np.arange(count)[:, None] + _SHARES).ravel()
            known[piece] = _Samples(points, np.zeros(len(at), dtype=np.int64), at)
    each = [known[piece] for piece in group]
    return _Samples(
        np.concatenate([own.points for own in each]),
        np.repeat(np.arange(len(each)), [len(own.at) for own in each]),
        np.concatenate([own.at for own in each]),
    )


def _link(result: Connected, group: list[Piece], gap: Gap) -> None:
    first, result.pieces = _opened(result, result.pieces, *gap.on_one)
    second, group = _opened(result, group, *gap.on_other)
    a, b = result.places[first], result.places[second]
    result.pieces = [*result.pieces, *group, Piece(first, second, straight(a, b))]
    middle = (a + b) / 2
    at = (float(middle[0]), float(middle[1]))
    result.changes.append(Change("link", at, gap.length, "added to connect two pieces of the drawing"))
    result.notices.append(
        Notice("note", "joined", at, "two pieces of the drawing were joined by a straight link")
    )


def _opened(result: Connected, pieces: list[Piece], index: int, at: float) -> tuple[int, list[Piece]]:
    """A node on a piece at a parameter, and the pieces with that one cut there."""
    piece = pieces[index]
    if at < 1e-9:
        return piece.start, pieces
    if at > len(piece.curve) - 1e-9:
        return piece.end, pieces
    k = min(int(at), len(piece.curve) - 1)
    cubics, t = piece.curve.points, at - k
    if t < 1e-9:
        before, after = cubics[:k], cubics[k:]
    else:
        left, right = split(cubics[k : k + 1], t)
        before = np.concatenate([cubics[:k], left])
        after = np.concatenate([right, cubics[k + 1 :]])
    node = max(result.places) + 1
    result.places[node] = after[0, 0].copy()
    parts = [
        Piece(piece.start, node, BezierChain(before), piece.kind),
        Piece(node, piece.end, BezierChain(after), piece.kind),
    ]
    return node, [*pieces[:index], *parts, *pieces[index + 1 :]]
