"""Takes ribbons apart: two strokes, and the crossings between them, in place of their common ink."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.arms import Arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.gaps import rejoin
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.overlaps.ribbons import Ribbon, find_ribbons
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths

# How often is looked again? Each round separates ribbons that don't touch each other; 2 or 4 rounds give the
# same on 48 generated overlaps.
_ROUNDS = 3
# In stroke widths: shorter ribbons are better told by how their strokes bend. From 3.25 on, one of 12 tangles
# more goes wrong.
_LONG = 2.5
# Among the rest, what is still a ribbon, and which strokes only touch in it for sure? 30 % make no
# difference.
_SHORT = 1.2
_WELL_APART = 0.6


def separate_ribbons(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Puts the two strokes of each long ribbon in its place, where they can be told apart."""
    strands = [strand for strand in graph.strands if lines[strand].length > _LONG * width_px]
    for _ in range(_ROUNDS):
        changed = _separate(graph, lines, find_ribbons(graph, lines, strands, ink, width_px))
        # The neighbours of a ribbon have other arms now.
        strands = [
            strand
            for strand in strands
            if strand in graph.strands
            and any(
                other in changed
                for node in (graph.strands[strand].start, graph.strands[strand].end)
                for other, _ in graph.ends_at(node)
            )
        ]


def separate_rest(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Does the same with what is left, short ribbons too; only strokes well apart are parted there."""
    strands = [strand for strand in graph.strands if lines[strand].length > _SHORT * width_px]
    ribbons = find_ribbons(graph, lines, strands, ink, width_px)
    _separate(graph, lines, [r for r in ribbons if r.swaps or _narrowest(r) > _WELL_APART * width_px])


def _narrowest(ribbon: Ribbon) -> float:
    return float(np.linalg.norm(ribbon.left - ribbon.right, axis=1).min())


def _separate(graph: StrandGraph, lines: dict[int, Line], ribbons: list[Ribbon]) -> set[int]:
    """Separates ribbons that don't touch each other; the strands of them and their arms."""
    taken: set[int] = set()
    for ribbon in sorted(ribbons, key=lambda r: (r.misfit, r.strands)):
        touched = {*(arm.strand for arm in (*ribbon.heads, *ribbon.tails)), *ribbon.strands}
        if touched & taken:
            continue
        taken |= touched
        if ribbon.swaps:
            _cross(graph, lines, ribbon)
        else:
            _part(graph, lines, ribbon)
    return taken


def _cross(graph: StrandGraph, lines: dict[int, Line], ribbon: Ribbon) -> None:
    """Two strokes that change sides: a crossing at each change, two strands between crossings."""
    _drop(graph, lines, ribbon)
    nodes = [graph.add_node((ribbon.left[k] + ribbon.right[k]) / 2) for k in ribbon.swaps]
    arriving = [(arm.strand, arm.end) for arm in ribbon.heads]
    first, last = ribbon.swaps[0], ribbon.swaps[-1]
    for arm, side in zip(ribbon.heads, (ribbon.left, ribbon.right), strict=True):
        lead_to(graph, lines, arm, nodes[0], side[first::-1], ribbon.clean[first::-1], ribbon.width_px)
    for arm, side in zip(ribbon.tails, (ribbon.left, ribbon.right), strict=True):
        lead_to(graph, lines, arm, nodes[-1], side[last:], ribbon.clean[last:], ribbon.width_px)
    for (start, low), (end, high) in itertools.pairwise(zip(nodes, ribbon.swaps, strict=True)):
        span = slice(low, high + 1)
        inner = [
            _strand(graph, lines, start, end, side[span], ribbon.clean[span], ribbon.width_px)
            for side in (ribbon.left, ribbon.right)
        ]
        graph.through[start] = _swapped(arriving, [(strand, 0) for strand in inner])
        arriving = [(strand, 1) for strand in inner]
    graph.through[nodes[-1]] = _swapped(arriving, [(arm.strand, arm.end) for arm in ribbon.tails])
    graph.drop_lonely()


def _part(graph: StrandGraph, lines: dict[int, Line], ribbon: Ribbon) -> None:
    """Two strokes that only touch: each goes on by itself."""
    _drop(graph, lines, ribbon)
    middle = len(ribbon.left) // 2
    graph.tell(
        "note",
        "touching",
        (ribbon.left[middle] + ribbon.right[middle]) / 2,
        "two strokes touch side by side without crossing; they are taken as apart",
        "leave white paper between them, or let them cross",
    )
    ends: list[int] = []
    for head, tail, side in zip(ribbon.heads, ribbon.tails, (ribbon.left, ribbon.right), strict=True):
        start, end = graph.add_node(side[0]), graph.add_node(side[-1])
        _strand(graph, lines, start, end, side, ribbon.clean, ribbon.width_px)
        lead_to(graph, lines, head, start, side[:1], ribbon.clean[:1], ribbon.width_px)
        lead_to(graph, lines, tail, end, side[-1:], ribbon.clean[-1:], ribbon.width_px)
        ends += [start, end]
    for node in ends:
        rejoin(graph, lines, node)
    graph.drop_lonely()


def _swapped(
    arriving: list[tuple[int, int]], leaving: list[tuple[int, int]]
) -> tuple[tuple[tuple[int, int], tuple[int, int]], ...]:
    return (arriving[0], leaving[1]), (arriving[1], leaving[0])


def _drop(graph: StrandGraph, lines: dict[int, Line], ribbon: Ribbon) -> None:
    for strand in ribbon.strands:
        graph.drop_strand(strand)
        del lines[strand]


def _strand(
    graph: StrandGraph,
    lines: dict[int, Line],
    start: int,
    end: int,
    points: FloatArray,
    clean: NDArray[np.bool_],
    width_px: float,
) -> int:
    strand = graph.add_strand(start, end, points)
    lines[strand] = Line(points, np.full(len(points), width_px), clean, lengths(points))
    return strand


def lead_to(
    graph: StrandGraph,
    lines: dict[int, Line],
    arm: Arm,
    node: int,
    lead: FloatArray,
    clean: NDArray[np.bool_],
    width_px: float,
) -> None:
    """Moves an arm's end to a node, with points that lead from there to the arm's own clean part."""
    line, backwards = lines[arm.strand], arm.end == 1
    order = slice(None, None, -1) if backwards else slice(None)
    points, width, flags = (
        line.points[order][arm.cut :],
        line.width[order][arm.cut :],
        line.clean[order][arm.cut :],
    )
    gap = np.linalg.norm(points[0] - lead[-1])
    share = np.linspace(0, 1, max(2, int(gap / max(width_px / 8, 1.0))) + 1)[1:-1, None]
    between = (1 - share) * lead[-1] + share * points[0]
    chain = np.vstack([lead, between, points])
    widths = np.concatenate([np.full(len(lead) + len(between), width_px), width])
    flags = np.concatenate([clean, np.zeros(len(between), dtype=bool), flags])
    chain, widths, flags = chain[order], widths[order], flags[order]
    lines[arm.strand] = Line(chain, widths, flags, lengths(chain))
    graph.strands[arm.strand].points = chain
    graph.reroute(arm.strand, arm.end, node)
