"""Crossings that thinning tore apart: two forks with a shared stretch between them, put together again.

Where two strokes cross at an acute angle, their ink is one stroke for up to eleven widths.
"""

from __future__ import annotations

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.overlaps.separate import separate_rest, separate_ribbons
from wrapit.drawing.bitmap.overlaps.short import Explanation, explain, worth_explaining
from wrapit.drawing.bitmap.strand_graph import StrandGraph


def resolve_overlaps(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Makes crossings of forks between which two strokes cross, and parts strokes that only touch."""
    separate_ribbons(graph, lines, ink, width_px)
    found = []
    for strand, s in graph.strands.items():
        if s.start == s.end or graph.degree(s.start) != 3 or graph.degree(s.end) != 3:
            continue
        if worth_explaining(lines[strand], width_px):
            explanation = explain(graph, lines, strand, ink, width_px)
            if explanation is not None:
                found.append(explanation)
    taken: set[int] = set()
    for explanation in sorted(found, key=lambda e: (e.misfit, e.strand)):
        strand = explanation.strand
        if strand not in graph.strands:
            continue
        s = graph.strands[strand]
        if s.start in taken or s.end in taken:
            continue
        taken |= {s.start, s.end}
        _cross(graph, lines, explanation)
    separate_rest(graph, lines, ink, width_px)


def _cross(graph: StrandGraph, lines: dict[int, Line], explanation: Explanation) -> None:
    s = graph.strands[explanation.strand]
    del lines[explanation.strand]
    node = graph.merge([s.start, s.end], explanation.at, [explanation.strand])
    graph.through[node] = tuple(((a.strand, a.end), (b.strand, b.end)) for a, b in explanation.pairs)
