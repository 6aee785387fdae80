"""Corners along a stroke: sharp ones become junctions, gentle and round ones get their true points back."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.arms import arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.corners.apart import Corner
from wrapit.drawing.bitmap.corners.find import find_corners
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths


def split_corners(
    graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float, corner_rad: float
) -> None:
    """Makes a node of each corner sharper than `corner_rad`; gentler ones become points of their line."""
    for strand in list(graph.strands):
        s = graph.strands[strand]
        closed = graph.is_seam(s.start)
        line = lines[strand]
        if closed:
            line = lines[strand] = line.turned(_flattest(line, width_px))
            graph.nodes[s.start] = line.points[0]
            first, last = 0, len(line.points) - 1
        else:
            first = arm(line, strand, 0, width_px).cut
            last = len(line.points) - 1 - arm(line, strand, 1, width_px).cut
        if last - first < 8:
            continue
        corners = find_corners(line, ink, width_px, first, last)
        if corners:
            _split(graph, lines, strand, corners, corner_rad, hard=ink.stair_px > 0)


def _split(
    graph: StrandGraph,
    lines: dict[int, Line],
    strand: int,
    corners: list[Corner],
    corner_rad: float,
    *,
    hard: bool,
) -> None:
    """Cuts a strand at its corners.

    Their places are kept where they tell more than what points at them: those of chains on hard edges, whose
    arms begin far off, and those of corners apart on grey ones, as arms take in bends near by.
    """
    s, line = graph.strands[strand], lines[strand]
    parts: list[tuple[list[slice | FloatArray | Line], FloatArray]] = []
    placed: list[bool] = []
    stretch: list[slice | FloatArray | Line] = []
    start = 0
    for corner in corners:
        stretch.append(slice(start, corner.before))
        if corner.side is not None:
            stretch.append(corner.side)
        start = corner.after
        if corner.sharp and corner.turn_rad >= corner_rad:
            parts.append((stretch, corner.points[0]))
            placed.append(corner.chained == hard)
            stretch = []
        else:
            stretch.append(corner.points)
        if corner.last_side is not None:
            stretch.append(corner.last_side)
    stretch.append(slice(start, len(line.points)))
    nodes = [s.start, *(graph.add_node(apex) for _, apex in parts), s.end]
    graph.corners |= set(nodes[1:-1])
    graph.placed |= {node for node, kept in zip(nodes[1:-1], placed, strict=True) if kept}
    pieces = [_joined(line, items) for items in [*(items for items, _ in parts), stretch]]
    if graph.is_seam(s.start) and len(pieces) > 1:
        # A closed loop with corners needs its seam no longer.
        pieces[0] = _after(pieces.pop(), pieces[0])
        nodes[0] = nodes[-2]
        del nodes[-1]
    graph.drop_strand(strand)
    del lines[strand]
    for piece, start_node, end_node in zip(pieces, nodes[:-1], nodes[1:], strict=True):
        lines[graph.add_strand(start_node, end_node, piece.points)] = piece
    graph.drop_lonely()


def _joined(line: Line, items: list[slice | FloatArray | Line]) -> Line:
    """A line from stretches of another and sides drawn anew, with the points of gentle corners between."""
    points, width, clean = [], [], []
    for item in items:
        if isinstance(item, slice):
            points.append(line.points[item])
            width.append(line.width[item])
            clean.append(line.clean[item])
        elif isinstance(item, Line):
            points.append(item.points)
            width.append(item.width)
            clean.append(item.clean)
        else:
            points.append(item)
            width.append(np.full(len(item), np.nan))
            clean.append(np.ones(len(item), dtype=np.bool_))
    chain = np.concatenate(points)
    return Line(chain, np.concatenate(width), np.concatenate(clean), lengths(chain))


def _after(first: Line, second: Line) -> Line:
    chain = np.concatenate([first.points, second.points[1:]])
    return Line(
        chain,
        np.concatenate([first.width, second.width[1:]]),
        np.concatenate([first.clean, second.clean[1:]]),
        lengths(chain),
    )


def _flattest(line: Line, width_px: float) -> int:
    """The point of a closed line around which it turns least."""
    ring = line.points[:-1]
    whole = 2 * width_px / max(line.length / len(ring), 1e-6)
    turns = []
    # Near by as well as farther on: turns one way and back leave the farther course as it was.
    for part in (1, 2, 4):
        reach = max(1, min(int(whole / part), len(ring) // 3))
        before, after = ring - np.roll(ring, reach, axis=0), np.roll(ring, -reach, axis=0) - ring
        cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        turns.append(np.abs(np.arctan2(cross, (before * after).sum(axis=1))))
    return int(np.argmin(np.round(np.sum(turns, axis=0), 6)))
