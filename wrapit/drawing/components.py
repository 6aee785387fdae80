"""Drawings in several pieces: the largest is kept, or near ones are joined by straight links."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from wrapit.drawing.assembly import Piece
from wrapit.drawing.changes import Change, Notice
from wrapit.geometry import BezierChain, FloatArray, straight
from wrapit.geometry.bezier import split
from wrapit.geometry.disjoint_sets import Sets

_NAMED = 8


@dataclass(eq=False)
class Connected:
    """Places and pieces of one connected drawing, and what was left out or added for that."""

    places: dict[int, FloatArray]
    pieces: list[Piece]
    changes: list[Change] = field(default_factory=list)
    notices: list[Notice] = field(default_factory=list)


def connect(
    places: dict[int, FloatArray], pieces: list[Piece], how: Literal["largest", "join"], longest: float
) -> Connected:
    """One connected drawing: others are joined where `how` says so and the link is at most `longest`.

    What stays apart is left out, with a warning that names the place.
    """
    groups = _groups(pieces)
    if len(groups) == 1:
        return Connected(places, pieces)
    result = Connected(dict(places), groups[0])
    rest = groups[1:]
    while rest and how == "join":
        gaps = [_nearest(result.pieces, group) for group in rest]
        best = min(range(len(rest)), key=lambda k: (gaps[k][0], k))
        if gaps[best][0] > longest:
            break
        _link(result, rest.pop(best), gaps[best])
    for k, group in enumerate(rest):
        _leave_out(result, group, named=k < _NAMED)
    if len(rest) > _NAMED:
        result.notices.append(
            Notice("warning", "left-out", (0.0, 0.0), f"{len(rest) - _NAMED} more pieces are left out")
        )
    return result


def _leave_out(result: Connected, group: list[Piece], named: bool) -> None:
    points = np.concatenate([piece.curve.points.reshape(-1, 2) for piece in group])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    length = sum(piece.curve.length for piece in group)
    at = (float(middle[0]), float(middle[1]))
    result.changes.append(Change("piece", at, length, "not connected to the largest piece"))
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
    return sorted(groups.values(), key=lambda group: -sum(piece.curve.length for piece in group))


def _nearest(one: list[Piece], other: list[Piece]) -> tuple[float, int, float, int, float]:
    """Shortest gap between two groups: its length, and piece and parameter on either side."""
    from scipy.spatial import cKDTree

    points_a, where_a = _samples(one)
    points_b, where_b = _samples(other)
    gaps, index = cKDTree(points_a).query(points_b)
    k = int(np.argmin(np.round(gaps, 9)))
    piece_a, at_a = where_a[int(index[k])]
    piece_b, at_b = where_b[k]
    return float(gaps[k]), piece_a, at_a, piece_b, at_b


def _samples(group: list[Piece]) -> tuple[FloatArray, list[tuple[int, float]]]:
    from wrapit.geometry.bezier import evaluate

    t = np.linspace(0, 1, 33)
    points, where = [], []
    for index, piece in enumerate(group):
        points.append(evaluate(piece.curve.points, t).reshape(-1, 2))
        where += [(index, k + float(u)) for k in range(len(piece.curve)) for u in t]
    return np.concatenate(points), where


def _link(result: Connected, group: list[Piece], gap: tuple[float, int, float, int, float]) -> None:
    length, piece_a, at_a, piece_b, at_b = gap
    first, result.pieces = _opened(result, result.pieces, piece_a, at_a)
    second, group = _opened(result, group, piece_b, at_b)
    a, b = result.places[first], result.places[second]
    result.pieces = [*result.pieces, *group, Piece(first, second, straight(a, b))]
    middle = (a + b) / 2
    at = (float(middle[0]), float(middle[1]))
    result.changes.append(Change("link", at, length, "added to connect two pieces of the drawing"))
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
