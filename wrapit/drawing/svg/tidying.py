"""Pieces of a planar graph made tidy: no doubles, no stubs, and one piece for one smooth stroke."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from wrapit.drawing.assembly import Piece
from wrapit.drawing.svg.cutting import moved
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.disjoint_sets import Sets
from wrapit.geometry.polyline import evenly

# Points along a piece where it is compared with another. Pieces with the same two ends that are alike in nine
# places are one stroke; a cubic is told by four.
_COMPARED = 9


def without_doubles(pieces: list[Piece], tolerance: float) -> list[Piece]:
    """Leaves out pieces that lie on an earlier one, which can only have the same ends."""
    bundles: dict[tuple[int, int], list[int]] = {}
    for index, piece in enumerate(pieces):
        bundles.setdefault((min(piece.start, piece.end), max(piece.start, piece.end)), []).append(index)
    gone: set[int] = set()
    for bundle in bundles.values():
        if len(bundle) > 1:
            gone |= _doubles(pieces, bundle, tolerance)
    return [piece for index, piece in enumerate(pieces) if index not in gone]


def _doubles(pieces: list[Piece], bundle: list[int], tolerance: float) -> set[int]:
    """Which pieces of a bundle with the same two ends lie on an earlier one."""
    kept = np.empty((len(bundle), _COMPARED, 2))
    starts = np.empty(len(bundle), dtype=np.int64)
    count = 0
    gone: set[int] = set()
    for index in bundle:
        piece = pieces[index]
        samples = _at_shares(piece.curve)
        same = np.abs(kept[:count] - samples).max(axis=(1, 2)) < tolerance
        turned = np.abs(kept[:count] - samples[::-1]).max(axis=(1, 2)) < tolerance
        if (same & (starts[:count] == piece.start)).any() or (turned & (starts[:count] == piece.end)).any():
            gone.add(index)
            continue
        kept[count], starts[count] = samples, piece.start
        count += 1
    return gone


def _at_shares(curve: BezierChain) -> FloatArray:
    points = curve.sampled(max(curve.length / 200, 1e-9))
    return evenly(points, _COMPARED)


def without_stubs(pieces: list[Piece], reach: float) -> tuple[list[Piece], list[tuple[FloatArray, float]]]:
    """Leaves out free ends shorter than `reach` behind a joint; returns start and length of each.

    Each round takes all stubs there are then. One that comes free later needs two that went in the round
    before, so that the rounds grow only with the logarithm of the number of pieces.
    """
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
                free and max(degree[piece.start], degree[piece.end]) > 2 and piece.curve.length < reach
            ):
                stubs.append((piece.curve.start, piece.curve.length))
            else:
                rest.append(piece)
        if len(rest) == len(pieces):
            return pieces, stubs
        pieces = rest


def without_nubs(
    pieces: list[Piece], places: dict[int, FloatArray], reach: float
) -> tuple[list[Piece], list[tuple[FloatArray, float]]]:
    """Moves corners less than `reach` behind a joint into it; returns start and length of what went.

    Two strokes that begin in one point just beside a third make such a corner: one of them crosses it.
    """
    at = _pieces_at(pieces)
    joint_of: dict[int, int] = {}
    gone: set[int] = set()
    for node, ends in at.items():
        for short, long in (ends, ends[::-1]) if len(ends) == 2 else ():
            nub = pieces[short]
            joint = nub.end if nub.start == node else nub.start
            if nub.curve.length < reach < pieces[long].curve.length / 2 and len(at[joint]) > 2:
                joint_of[node] = joint
                gone.add(short)
    rest = [
        _led(piece, joint_of, places) if {piece.start, piece.end} & joint_of.keys() else piece
        for index, piece in enumerate(pieces)
        if index not in gone
    ]
    return rest, [(pieces[index].curve.start, pieces[index].curve.length) for index in sorted(gone)]


def _led(piece: Piece, joint_of: dict[int, int], places: dict[int, FloatArray]) -> Piece:
    """The piece with its ends moved from corners to their joints."""
    start, end = (joint_of.get(node, node) for node in (piece.start, piece.end))
    return replace(piece, start=start, end=end, curve=moved(piece.curve.points, places[start], places[end]))


def _pieces_at(pieces: list[Piece]) -> dict[int, list[int]]:
    """The pieces at each node; twice where one begins and ends there."""
    at: dict[int, list[int]] = {}
    for index, piece in enumerate(pieces):
        for node in (piece.start, piece.end):
            at.setdefault(node, []).append(index)
    return at


def rejoined(pieces: list[Piece], corner_rad: float) -> list[Piece]:
    """One piece in place of those that meet smoothly where nothing else does: one stroke drawn in parts."""
    at = _pieces_at(pieces)
    together = Sets()
    joints: dict[int, tuple[int, int]] = {}
    latest: dict[int, int] = {}
    for node, ends in at.items():
        if len(ends) != 2:
            continue
        first, second = sorted(together.find(index) for index in ends)
        # The last joint of a closed stroke stays, for a place to begin at.
        if first == second or _turn(pieces, node, ends) > corner_rad:
            continue
        together.merge(first, second)
        joints[node] = (ends[0], ends[1])
        latest[first] = node
    return [
        _chained(pieces, joints, latest[index], index) if index in latest else piece
        for index, piece in enumerate(pieces)
        if together.find(index) == index
    ]


def _turn(pieces: list[Piece], node: int, ends: list[int]) -> float:
    """Angle by which two pieces that meet at a node turn there."""
    one, other = (
        piece.curve.start_tangent if piece.start == node else -piece.curve.end_tangent
        for piece in (pieces[index] for index in ends)
    )
    return float(np.arccos(np.clip(-one @ other, -1, 1)))


def _chained(pieces: list[Piece], joints: dict[int, tuple[int, int]], node: int, first: int) -> Piece:
    """All pieces joined to one, through a joint of theirs; the side with the first of them leads."""
    sides = [_walk(pieces, joints, node, index) for index in joints[node]]
    if all(index != first for index, _ in sides[0][0]):
        sides.reverse()
    (before, start), (after, end) = sides
    parts = [pieces[index].curve.points[:: -1 if out else 1, :: -1 if out else 1] for index, out in before]
    parts.reverse()
    parts += [pieces[index].curve.points[:: 1 if out else -1, :: 1 if out else -1] for index, out in after]
    return Piece(start, end, BezierChain(np.concatenate(parts)), pieces[first].kind)


def _walk(
    pieces: list[Piece], joints: dict[int, tuple[int, int]], node: int, index: int
) -> tuple[list[tuple[int, bool]], int]:
    """The pieces from a node on over joints, and whether each is run as drawn; and the node at the end."""
    run = []
    while True:
        piece = pieces[index]
        run.append((index, piece.start == node))
        node = piece.end if piece.start == node else piece.start
        if node not in joints:
            return run, node
        one, other = joints[node]
        index = other if index == one else one
