"""Curves that cross and touch, cut into a planar graph: exact crossings, joints, corners."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.assembly import Piece
from wrapit.drawing.meetings import crossings, touches
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.bezier import split

_STUB = 0.63


@dataclass(frozen=True, eq=False)
class Curve:
    """Cubics (n, 4, 2) that follow one another, closed or open."""

    cubics: FloatArray
    closed: bool


@dataclass(frozen=True, eq=False)
class Planar:
    """Places by number, pieces between them, and free stubs (middle, length) that were left out."""

    places: dict[int, FloatArray]
    pieces: list[Piece]
    stubs: list[tuple[FloatArray, float]]


def planar(curves: list[Curve], reach: float, corner_rad: float) -> Planar:
    """The graph of curves cut where they cross, touch, end, or turn by more than `corner_rad`.

    Ends closer than `reach` to another curve are joined to it; free stubs shorter than two thirds of
    that are left out.
    """
    marks = [_own_marks(curve, corner_rad) for curve in curves]
    cubics = [curve.cubics for curve in curves]
    closed = [curve.closed for curve in curves]
    contacts = [*crossings(cubics, closed), *touches(cubics, closed, reach)]
    for contact in contacts:
        for curve, at in contact.on:
            marks[curve].append((at, contact.point))
    nodes = _Nodes(0.08 * reach)
    for contact in contacts:
        nodes.join([contact.point, *(_at(cubics[curve], at) for curve, at in contact.on)], contact.point)
    pieces: list[Piece] = []
    for each, own in zip(curves, marks, strict=True):
        pieces += _pieces(each, own, nodes, reach)
    pieces = _without_doubles(pieces, 0.1 * reach)
    pieces, stubs = _without_stubs(pieces, _STUB * reach)
    pieces = _rejoined(pieces, corner_rad)
    return Planar(nodes.places(), pieces, stubs)


class _Nodes:
    """Places that are one: points closer than the tolerance, and those joined by a contact."""

    def __init__(self, tolerance: float) -> None:
        self._tolerance = tolerance
        self._points: list[FloatArray] = []
        self._owner: list[int] = []
        self._place: dict[int, FloatArray] = {}
        self._settled: set[int] = set()

    def join(self, points: list[FloatArray], place: FloatArray) -> None:
        """Says that several points are one node, which lies at `place` unless it had a place before."""
        found = sorted({self.find(point) for point in points})
        keep = found[0]
        self._owner = [keep if owner in found else owner for owner in self._owner]
        fresh = all(node not in self._settled for node in found)
        for other in found[1:]:
            self._place.pop(other)
        if fresh:
            self._place[keep] = np.asarray(place, dtype=np.float64)
        self._settled.add(keep)

    def find(self, point: FloatArray) -> int:
        """Number of the node at a point, a new one if there is none."""
        if self._points:
            far = np.linalg.norm(np.array(self._points) - point, axis=1)
            nearest = int(np.argmin(far))
            if far[nearest] <= self._tolerance:
                return self._owner[nearest]
        self._points.append(np.asarray(point, dtype=np.float64))
        number = len(self._owner)
        self._owner.append(number)
        self._place[number] = self._points[-1]
        return number

    def places(self) -> dict[int, FloatArray]:
        """Place of each node."""
        return dict(self._place)


def _own_marks(curve: Curve, corner_rad: float) -> list[tuple[float, FloatArray]]:
    """Where a curve is cut without any other: its ends and its corners, as (parameter, place)."""
    count = len(curve.cubics)
    marks = [] if curve.closed else [(0.0, curve.cubics[0, 0]), (float(count), curve.cubics[-1, 3])]
    for joint in range(0 if curve.closed else 1, count):
        arriving = BezierChain(curve.cubics[joint - 1][None]).end_tangent
        leaving = BezierChain(curve.cubics[joint][None]).start_tangent
        if np.arccos(np.clip(arriving @ leaving, -1, 1)) > corner_rad:
            marks.append((float(joint), curve.cubics[joint, 0]))
    return marks


def _pieces(curve: Curve, marks: list[tuple[float, FloatArray]], nodes: _Nodes, reach: float) -> list[Piece]:
    count = len(curve.cubics)
    if not marks:
        marks = [(0.0, curve.cubics[0, 0])]
    # Close marks are one: an end that touches a crossing, a corner that another stroke meets.
    ordered = sorted(((at % count if curve.closed else at, nodes.find(place)) for at, place in marks))
    kept = [
        mark
        for k, mark in enumerate(ordered)
        if k == 0 or mark[1] != ordered[k - 1][1] or _far(curve, ordered[k - 1][0], mark[0], reach)
    ]
    if curve.closed:
        if (
            len(kept) > 1
            and kept[0][1] == kept[-1][1]
            and not _far(curve, kept[-1][0], kept[0][0] + count, reach)
        ):
            kept.pop()
        kept.append((kept[0][0] + count, kept[0][1]))
    places = nodes.places()
    pieces = []
    for (start, first), (end, last) in itertools.pairwise(kept):
        cubics = stretch(curve, start, end)
        if cubics is None:
            continue
        pieces.append(Piece(first, last, moved(cubics, places[first], places[last])))
    return pieces


def _far(curve: Curve, start: float, end: float, reach: float) -> bool:
    cubics = stretch(curve, start, end)
    return cubics is not None and BezierChain(cubics).length > reach


def stretch(curve: Curve, start: float, end: float) -> FloatArray | None:
    """The cubics between two parameters; beyond the end a closed curve goes round."""
    count = len(curve.cubics)
    parts = []
    k = int(np.floor(start))
    while k < end - 1e-9:
        cubic = curve.cubics[k % count][None]
        low, high = max(start - k, 0.0), min(end - k, 1.0)
        if high - low > 1e-7:
            if high < 1:
                cubic = split(cubic, high)[0]
            if low > 0:
                cubic = split(cubic, low / high)[1]
            parts.append(cubic[0])
        k += 1
    if not parts:
        return None
    cubics = np.array(parts)
    cubics[1:, 0] = cubics[:-1, 3]
    return cubics


def moved(cubics: FloatArray, start: FloatArray, end: FloatArray) -> BezierChain:
    """The cubics with their ends moved exactly onto places, each handle along with its end."""
    moved = cubics.copy()
    moved[0, 1] += start - moved[0, 0]
    moved[-1, 2] += end - moved[-1, 3]
    moved[0, 0], moved[-1, 3] = start, end
    return BezierChain(moved)


def _at(cubics: FloatArray, at: float) -> FloatArray:
    k = min(int(at), len(cubics) - 1)
    t = at - k
    s = 1 - t
    a, b, c, d = cubics[k]
    return s**3 * a + 3 * s * s * t * b + 3 * s * t * t * c + t**3 * d


def _without_doubles(pieces: list[Piece], tolerance: float) -> list[Piece]:
    """Leaves out pieces that lie on an earlier one."""
    kept: list[tuple[Piece, FloatArray]] = []
    for piece in pieces:
        samples = _at_shares(piece.curve)
        for other, theirs in kept:
            same = (other.start, other.end) == (piece.start, piece.end)
            turned = (other.start, other.end) == (piece.end, piece.start)
            if (same and np.abs(samples - theirs).max() < tolerance) or (
                turned and np.abs(samples[::-1] - theirs).max() < tolerance
            ):
                break
        else:
            kept.append((piece, samples))
    return [piece for piece, _ in kept]


def _at_shares(curve: BezierChain) -> FloatArray:
    points = curve.sampled(max(curve.length / 200, 1e-9))
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = np.linspace(0, along[-1], 9)
    return np.column_stack([np.interp(at, along, points[:, k]) for k in (0, 1)])


def _without_stubs(pieces: list[Piece], reach: float) -> tuple[list[Piece], list[tuple[FloatArray, float]]]:
    stubs = []
    while True:
        degree: dict[int, int] = {}
        for piece in pieces:
            for node in (piece.start, piece.end):
                degree[node] = degree.get(node, 0) + 1
        rest = []
        for piece in pieces:
            free = (degree[piece.start] == 1) != (degree[piece.end] == 1)
            nothing = piece.start == piece.end and piece.curve.length < 0.1 * reach
            if nothing or (
                free and piece.curve.length < reach and max(degree[piece.start], degree[piece.end]) > 2
            ):
                stubs.append((piece.curve.start, piece.curve.length))
            else:
                rest.append(piece)
        if len(rest) == len(pieces):
            return pieces, stubs
        pieces = rest


def _rejoined(pieces: list[Piece], corner_rad: float) -> list[Piece]:
    """One piece in place of two that meet smoothly where nothing else does: one stroke drawn in parts."""
    pieces = list(pieces)
    at: dict[int, list[int]] = {}
    for index, piece in enumerate(pieces):
        for node in (piece.start, piece.end):
            at.setdefault(node, []).append(index)
    gone: set[int] = set()
    for node, ends in at.items():
        if len(ends) != 2 or ends[0] == ends[1]:
            continue
        first, second = sorted(ends)
        before, after = _towards(pieces[first], node), _from(pieces[second], node)
        if np.arccos(np.clip(before.curve.end_tangent @ after.curve.start_tangent, -1, 1)) > corner_rad:
            continue
        cubics = np.concatenate([before.curve.points, after.curve.points])
        pieces[first] = Piece(before.start, after.end, BezierChain(cubics), before.kind)
        gone.add(second)
        # The far end of the second now belongs to the first.
        at[after.end] = [first if index == second else index for index in at[after.end]]
    return [piece for index, piece in enumerate(pieces) if index not in gone]


def _towards(piece: Piece, node: int) -> Piece:
    return piece if piece.end == node else Piece(piece.end, piece.start, piece.curve.reversed(), piece.kind)


def _from(piece: Piece, node: int) -> Piece:
    return piece if piece.start == node else Piece(piece.end, piece.start, piece.curve.reversed(), piece.kind)
