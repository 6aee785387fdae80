"""Explains short stretches of ink between two forks: do two strokes cross there?

Each way to pair the arms at both ends gives two smooth curves through the stretch. They are drawn again,
and the pairing is kept whose width along the stretch agrees with the ink's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.pairing import Through, stepped, through, turn
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, unit

# None of these, varied by 30 %, changes any of 48 generated overlaps or 8 pictures of the corpus: most
# crossings are far from each limit. In stroke widths: what stretch is short, and long enough to show its
# width? Longer ones are ribbons, whose edges tell more.
_LONGEST = 2.5
_SEEN = 0.8
# When does the width show a crossing? Where it misses that of two crossing strokes by less than this (in
# stroke widths), and by less than 0.6 times what it misses that of one stroke.
_MISFIT = 0.28
_BETTER = 0.6
# How much may each stroke turn in the stretch? More where the width shows that they cross.
_TURN_RAD = np.radians(30)
_TURN_SEEN_RAD = np.radians(65)
# Shorter stretches are one crossing whatever their arms say: thinning alone tears a right-angled one so far.
_TORN = 0.5


@dataclass(frozen=True, eq=False)
class Explanation:
    """Two strokes that cross in a shared stretch: each a pair of arms, one at either end."""

    strand: int
    cost: float
    pairs: list[tuple[Arm, Arm]]
    at: FloatArray


def worth_explaining(line: Line, width_px: float) -> bool:
    """Whether a stretch is short."""
    return line.length <= _LONGEST * width_px


def explain(graph: StrandGraph, lines: dict[int, Line], strand: int, width_px: float) -> Explanation | None:
    """The best explanation of a stretch between two forks by two strokes, or nothing."""
    s, line = graph.strands[strand], lines[strand]
    heads = _others(graph, lines, s.start, strand, width_px)
    tails = _others(graph, lines, s.end, strand, width_px)
    if len(heads) != 2 or len(tails) != 2:
        return None
    seen = line.length > _SEEN * width_px
    best = None
    for pairs in _crossed(heads, tails):
        turns = [turn(a, b) for a, b in pairs]
        if max(turns) > _TURN_SEEN_RAD:
            continue
        curves = [through(a, b) for a, b in pairs]
        crossed, together = _misfits(line, _apart(curves, line), width_px)
        cost = sum(value**2 for value in turns) + (crossed**2 if seen else 0.0)
        if best is None or cost < best[0]:
            best = (cost, turns, curves, pairs, crossed, together)
    if best is None:
        return None
    cost, turns, curves, pairs, crossed, together = best
    # A bar between two joints is as broad as one stroke, however smoothly other strokes would cross there.
    if seen and crossed > together:
        return None
    seen = seen and crossed < _MISFIT and crossed < _BETTER * together
    crossings = _crossings(curves[0], curves[1], width_px)
    if len(crossings) != 1 or max(turns) > (_TURN_SEEN_RAD if seen else _TURN_RAD):
        return None
    return Explanation(strand, cost, pairs, crossings[0])


def forks_apart(graph: StrandGraph, lines: dict[int, Line], width_px: float) -> set[int]:
    """Short strands between two forks that are two joints: nothing crosses there."""
    apart = set()
    for strand, s in graph.strands.items():
        if not graph.degree(s.start) == graph.degree(s.end) == 3 or s.start == s.end:
            continue
        if strand in lines and _TORN * width_px < lines[strand].length <= _LONGEST * width_px:
            heads = _others(graph, lines, s.start, strand, width_px)
            tails = _others(graph, lines, s.end, strand, width_px)
            if len(heads) == len(tails) == 2 and not _crossed(heads, tails):
                apart.add(strand)
    return apart


def _crossed(heads: list[Arm], tails: list[Arm]) -> list[list[tuple[Arm, Arm]]]:
    """The ways to pair arms across a stretch in which no stroke makes a step to the side."""
    ways = [[(heads[0], tails[k]), (heads[1], tails[1 - k])] for k in (0, 1)]
    return [pairs for pairs in ways if not any(stepped(a, b) for a, b in pairs)]


def _crossings(a: Through, b: Through, width_px: float) -> list[FloatArray]:
    """Where two curves cross between their arms."""
    along = [np.linspace(-0.5, 0.5, 61) * (curve.gap + width_px) for curve in (a, b)]
    first, second = (
        s[:, None] ** np.arange(len(curve.coefficients)) @ curve.coefficients
        for s, curve in zip(along, (a, b), strict=True)
    )
    d, e = np.diff(first, axis=0)[:, None], np.diff(second, axis=0)[None]
    between = second[None, :-1] - first[:-1, None]
    det = d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0]
    safe = np.where(np.abs(det) < 1e-12, np.inf, det)
    s = (between[..., 0] * e[..., 1] - between[..., 1] * e[..., 0]) / safe
    t = (between[..., 0] * d[..., 1] - between[..., 1] * d[..., 0]) / safe
    return [first[i] + s[i, j] * d[i, 0] for i, j in np.argwhere((s >= 0) & (s < 1) & (t >= 0) & (t < 1))]


def excess(line: Line, width_px: float) -> float:
    """How much wider (stroke widths) the ink along a line is than one stroke, on average."""
    width = np.where(np.isfinite(line.width), np.minimum(line.width, 2 * width_px), 2 * width_px)
    return float(width.mean()) / width_px - 1


def _others(graph: StrandGraph, lines: dict[int, Line], node: int, strand: int, width_px: float) -> list[Arm]:
    return [arm(lines[other], other, end, width_px) for other, end in graph.ends_at(node) if other != strand]


def _apart(curves: list[Through], line: Line) -> FloatArray:
    """Signed distance between two curves, across every other point of the line between the forks."""
    tangent = unit(np.gradient(line.points, axis=0))[::2]
    normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    points = line.points[::2]
    offsets = []
    for curve in curves:
        reach = 0.75 * curve.gap + line.length / 2
        s = np.linspace(-reach, reach, 61)
        places = (s[:, None] ** np.arange(len(curve.coefficients))) @ curve.coefficients
        difference = places[None] - points[:, None]
        along = np.abs((difference * tangent[:, None]).sum(axis=2))
        nearest = np.argmin(along + 0.2 * np.linalg.norm(difference, axis=2), axis=1)
        offsets.append((difference[np.arange(len(nearest)), nearest] * normal).sum(axis=1))
    return offsets[0] - offsets[1]


def _misfits(line: Line, apart: FloatArray, width_px: float) -> tuple[float, float]:
    """How far (stroke widths) the ink's width is from that of two crossing strokes, and from one's."""
    width = line.width[::2]
    known = np.isfinite(width)
    if not known.any():
        return 0.0, 0.0
    measured = np.minimum(width[known], 2 * width_px) / width_px
    crossed = np.minimum(1 + np.abs(apart[known]) / width_px, 2.0)
    return float(np.abs(measured - crossed).mean()), float(np.abs(measured - 1).mean())
