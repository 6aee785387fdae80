"""The way along a stretch of ink that two strokes share, from the fork where they join to the last one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.overlaps.short import excess
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.polyline import at_lengths, lengths

# What may be a ribbon? In stroke widths: a stretch of up to 60, which only bounds the work, whose ink is
# broader than one stroke by 0.15 in the mean. 30 % make no difference to 48 generated overlaps.
_LONGEST = 60.0
_EXCESS = 0.15
# A stretch as broad as one stroke (by 8 %) that is longer than this is one that both share. Breadths of up to
# 1.4 as plain take two of 12 tangles for such.
_PLAIN = 1.08
LONGEST_FLAT = 4.0
# What is a hole in a ribbon, not its end? One whose sides are this short, so that nowhere a stroke stands
# alone.
_OPENING = 3.0


@dataclass(frozen=True, eq=False)
class RibbonAxis:
    """The way along a ribbon, which may open a little between two of its strands."""

    strands: tuple[int, ...]
    inner: tuple[int, ...]
    ends: tuple[int, int]
    points: FloatArray


def axis_of(graph: StrandGraph, lines: dict[int, Line], strand: int, width_px: float) -> RibbonAxis | None:
    """The way along a ribbon from a strand on, if that is broader than one stroke and ends in two forks."""
    s, line = graph.strands[strand], lines[strand]
    if s.start == s.end or graph.degree(s.start) != 3 or graph.degree(s.end) != 3:
        return None
    if line.length > _LONGEST * width_px or excess(line, width_px) < _EXCESS:
        return None
    step = line.length / (len(line.points) - 1)
    if longest_run(line.width < _PLAIN * width_px) * step > (LONGEST_FLAT + 0.5) * width_px:
        return None
    if _is_opening(graph, lines, strand, width_px):
        return None
    strands, inner, parts, ends = [strand], list[int](), [line.points], [s.start, s.end]
    for side in (0, 1):
        while (further := _beyond(graph, lines, ends[side], strands, width_px)) is not None:
            opening, points, after, node, end = further
            inner += [ends[side], node]
            strands += [*opening, after]
            onwards = [
                points,
                lines[after].points if graph.strands[after].start == node else lines[after].points[::-1],
            ]
            parts = [*(part[::-1] for part in reversed(onwards)), *parts] if side == 0 else [*parts, *onwards]
            ends[side] = end
    return RibbonAxis(tuple(strands), tuple(inner), (ends[0], ends[1]), even(parts, width_px))


def _beyond(
    graph: StrandGraph, lines: dict[int, Line], node: int, strands: list[int], width_px: float
) -> tuple[tuple[int, int], FloatArray, int, int, int] | None:
    """The opening behind one end of a ribbon, the way through it, and what follows: strand, node, end."""
    opening = [(strand, end) for strand, end in graph.ends_at(node) if strand not in strands]
    if len(opening) != 2 or opening[0][0] == opening[1][0]:
        return None
    if not all(_is_opening(graph, lines, strand, width_px) for strand, _ in opening):
        return None
    walked = [lines[strand].points if end == 0 else lines[strand].points[::-1] for strand, end in opening]
    across = {
        graph.strands[strand].end if end == 0 else graph.strands[strand].start for strand, end in opening
    }
    other = across.pop()
    rest = [strand for strand, _ in graph.ends_at(other) if strand not in (opening[0][0], opening[1][0])]
    if other == node or len(rest) != 1 or rest[0] in strands:
        return None
    s = graph.strands[rest[0]]
    end = s.end if s.start == other else s.start
    if s.start == s.end or graph.degree(end) != 3:
        return None
    share = np.linspace(0, 1, 9)
    middle = sum(_at_shares(points, share) for points in walked) / 2
    return (opening[0][0], opening[1][0]), np.asarray(middle), rest[0], other, end


def _is_opening(graph: StrandGraph, lines: dict[int, Line], strand: int, width_px: float) -> bool:
    """Whether a strand is one side of a hole so small that nowhere one of its strokes stands alone."""
    s, line = graph.strands[strand], lines[strand]
    if s.start == s.end or line.length > _OPENING * width_px or line.clean.mean() > 0.2:
        return False
    return any(
        other != strand and {graph.strands[other].start, graph.strands[other].end} == {s.start, s.end}
        and lines[other].length < _OPENING * width_px
        for other, _ in graph.ends_at(s.start)
    ) and graph.degree(s.start) == graph.degree(s.end) == 3  # fmt: skip


def _at_shares(points: FloatArray, share: FloatArray) -> FloatArray:
    along = lengths(points)
    at = share * along[-1]
    return at_lengths(points, along, at)


def even(parts: list[FloatArray], width_px: float) -> FloatArray:
    """One chain of evenly spaced points, an eighth of the width apart."""
    points = np.concatenate(parts)
    count = max(8, int(lengths(points)[-1] / max(width_px / 8, 1.0)))
    return _at_shares(points, np.linspace(0, 1, count))


def longest_run(flags: NDArray[np.bool_]) -> int:
    """How many flags in a row are set, at most."""
    bounds: IntArray = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(np.int8), [0]])))
    return int((bounds[1::2] - bounds[::2]).max()) if len(bounds) else 0
