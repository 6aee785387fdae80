"""Crossings that thinning tore apart: two forks with a shared stretch between them, put together again.

Where two strokes cross at an acute angle, their ink is one stroke for up to eleven widths.
"""

from __future__ import annotations

import numpy as np

from wrapit.drawing.centring import Line, lengths
from wrapit.drawing.ink import Ink
from wrapit.drawing.joining import rejoin
from wrapit.drawing.junctions import Arm, Through
from wrapit.drawing.network import Network
from wrapit.drawing.shared import Explanation, explain, worth_explaining
from wrapit.drawing.unzipping import unzip_ribbons
from wrapit.geometry import FloatArray


def join_crossings(net: Network, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Makes crossings of forks between which two strokes cross, and parts strokes that only touch."""
    unzip_ribbons(net, lines, ink, width_px)
    found = []
    for strand, s in net.strands.items():
        if s.start == s.end or net.degree(s.start) != 3 or net.degree(s.end) != 3:
            continue
        if worth_explaining(lines[strand], width_px):
            explanation = explain(net, lines, strand, width_px)
            if explanation is not None:
                found.append(explanation)
    taken: set[int] = set()
    for explanation in sorted(found, key=lambda e: (e.cost, e.strand)):
        strand = explanation.strand
        arms = {arm.strand for pair in explanation.pairs for arm in pair}
        if strand not in net.strands or not arms <= net.strands.keys():
            continue
        s = net.strands[strand]
        if s.start in taken or s.end in taken:
            continue
        taken |= {s.start, s.end}
        if explanation.kind == "cross":
            _cross(net, lines, explanation)
        elif explanation.kind == "braid":
            _braid(net, lines, explanation, width_px)
        elif len(arms) == 4:
            _part(net, lines, explanation, width_px)


def _cross(net: Network, lines: dict[int, Line], explanation: Explanation) -> None:
    s = net.strands[explanation.strand]
    del lines[explanation.strand]
    node = net.merge([s.start, s.end], explanation.meetings[0].at, [explanation.strand])
    net.through[node] = tuple(((a.strand, a.end), (b.strand, b.end)) for a, b in explanation.pairs)


def _braid(net: Network, lines: dict[int, Line], explanation: Explanation, width_px: float) -> None:
    """Two strokes that cross at both ends of the stretch: two strands between two crossings."""
    s = net.strands[explanation.strand]
    del lines[explanation.strand]
    net.drop_strand(explanation.strand)
    first, last = explanation.meetings
    net.nodes[s.start], net.nodes[s.end] = first.at, last.at
    inner = []
    for k, curve in enumerate(explanation.curves):
        points = _sampled(curve, first.along[k], last.along[k], width_px)
        strand = net.add_strand(s.start, s.end, points)
        lines[strand] = _clean(points, width_px)
        inner.append(strand)
    starts = [(a.strand, a.end) for a, _ in explanation.pairs]
    ends = [(b.strand, b.end) for _, b in explanation.pairs]
    net.through[s.start] = tuple((arm, (strand, 0)) for arm, strand in zip(starts, inner, strict=True))
    net.through[s.end] = tuple((arm, (strand, 1)) for arm, strand in zip(ends, inner, strict=True))


def _part(net: Network, lines: dict[int, Line], explanation: Explanation, width_px: float) -> None:
    """Two strokes that only touch: each goes on by itself."""
    shared = lines.pop(explanation.strand)
    middle = shared.points[len(shared.points) // 2]
    net.tell(
        "note",
        "touching",
        middle,
        "two strokes touch side by side without crossing; they are taken as apart",
        "leave white paper between them, or let them cross",
    )
    net.drop_strand(explanation.strand)
    for (a, b), curve in zip(explanation.pairs, explanation.curves, strict=True):
        node = net.add_node(curve.at(0.0)[0])
        half = (curve.gap / 2) - width_px / 8
        lines[a.strand] = _extended(lines[a.strand], a, _sampled(curve, 0.0, -half, width_px), width_px)
        lines[b.strand] = _extended(lines[b.strand], b, _sampled(curve, 0.0, half, width_px), width_px)
        net.reroute(a.strand, a.end, node)
        net.reroute(b.strand, b.end, node)
        rejoin(net, lines, node)
    net.drop_lonely()


def _sampled(curve: Through, start: float, end: float, width_px: float) -> FloatArray:
    count = max(3, int(abs(end - start) / max(width_px / 8, 1.0)))
    s = np.linspace(start, end, count)
    return s[:, None] ** np.arange(len(curve.coefficients)) @ curve.coefficients


def _clean(points: FloatArray, width_px: float) -> Line:
    return Line(points, np.full(len(points), width_px), np.ones(len(points), dtype=bool), lengths(points))


def _extended(line: Line, arm: Arm, lead: FloatArray, width_px: float) -> Line:
    """The clean part of a line with points that lead up to it at one end, instead of what was there."""
    backwards = arm.end == 1
    points = line.points[::-1] if backwards else line.points
    width = line.width[::-1] if backwards else line.width
    clean = line.clean[::-1] if backwards else line.clean
    chain = np.vstack([lead, points[arm.cut :]])
    widths = np.concatenate([np.full(len(lead), width_px), width[arm.cut :]])
    flags = np.concatenate([np.ones(len(lead), dtype=bool), clean[arm.cut :]])
    if backwards:
        chain, widths, flags = chain[::-1], widths[::-1], flags[::-1]
    return Line(chain, widths, flags, lengths(chain))
