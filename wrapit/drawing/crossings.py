"""Crossings that thinning tore apart: two forks with a shared stretch between them, put together again.

Where two strokes cross at an acute angle, their ink is one stroke for up to eleven widths. Each shared
stretch gets two explanations: the strokes cross in it, or they truly run together. Both are drawn again,
and the one whose width along the stretch agrees with the ink is kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.centring import Line
from wrapit.drawing.junctions import Arm, Through, arm, through, turn
from wrapit.drawing.network import Network, StrandEnd
from wrapit.geometry import FloatArray, unit

# In stroke widths.
_LONGEST = 30.0
_SHORT = 2.5
_MISFIT = 0.28
_BETTER = 0.6
_EXCESS = 0.15
_TURN_RAD = np.radians(30)
_TURN_SEEN_RAD = np.radians(65)


@dataclass(frozen=True, eq=False)
class _Crossing:
    """A way to explain a shared stretch by two strokes that cross in it."""

    strand: int
    at: FloatArray
    cost: float
    pairs: tuple[tuple[StrandEnd, StrandEnd], ...]


def join_crossings(net: Network, lines: dict[int, Line], width_px: float) -> None:
    """Makes one node of each two forks between which two strokes cross."""
    found = []
    for strand, s in net.strands.items():
        if s.start == s.end or net.degree(s.start) != 3 or net.degree(s.end) != 3:
            continue
        line = lines[strand]
        if line.length > _LONGEST * width_px or (
            line.length > _SHORT * width_px and _excess(line, width_px) < _EXCESS
        ):
            continue
        crossing = _explained(net, lines, strand, width_px)
        if crossing is not None:
            found.append(crossing)
    taken: set[int] = set()
    for crossing in sorted(found, key=lambda c: (c.cost, c.strand)):
        s = net.strands[crossing.strand]
        if s.start in taken or s.end in taken:
            continue
        taken |= {s.start, s.end}
        node = net.merge([s.start, s.end], crossing.at, [crossing.strand])
        net.through[node] = crossing.pairs


def _excess(line: Line, width_px: float) -> float:
    """How much wider (stroke widths) the ink along a line is than one stroke, on average."""
    width = np.where(np.isfinite(line.width), np.minimum(line.width, 2 * width_px), 2 * width_px)
    return float(width.mean()) / width_px - 1


def _explained(net: Network, lines: dict[int, Line], strand: int, width_px: float) -> _Crossing | None:
    s, line = net.strands[strand], lines[strand]
    heads = _others(net, lines, s.start, strand, width_px)
    tails = _others(net, lines, s.end, strand, width_px)
    if len(heads) != 2 or len(tails) != 2:
        return None
    best = None
    for order in ((0, 1), (1, 0)):
        pairs = [(heads[0], tails[order[0]]), (heads[1], tails[order[1]])]
        if any(a.strand == b.strand and a.end == b.end for a, b in pairs):
            continue
        turns = [turn(a, b) for a, b in pairs]
        if max(turns) > _TURN_SEEN_RAD:
            continue
        curves = [through(a, b) for a, b in pairs]
        crossed, together = _misfits(line, _apart(curves, line), width_px)
        cost = sum(value**2 for value in turns)
        if line.length > _SHORT * width_px:
            cost += (2 * crossed) ** 2
        if best is None or cost < best[0]:
            best = (cost, max(turns), curves, pairs, crossed, together)
    if best is None:
        return None
    cost, sharpest, curves, pairs, crossed, together = best
    at = _meeting(curves[0], curves[1], width_px)
    seen = line.length > 0.8 * width_px and crossed < _MISFIT and crossed < _BETTER * together
    if at is None or sharpest > (_TURN_SEEN_RAD if seen else _TURN_RAD):
        return None
    if line.length > _SHORT * width_px and not seen:
        return None
    return _Crossing(strand, at, cost, tuple(((a.strand, a.end), (b.strand, b.end)) for a, b in pairs))


def _meeting(a: Through, b: Through, width_px: float) -> FloatArray | None:
    """Where two curves cross between their arms, or nothing."""
    first, second = (
        (np.linspace(-0.5, 0.5, 41) * (curve.gap + width_px))[:, None] ** np.arange(len(curve.coefficients))
        @ curve.coefficients
        for curve in (a, b)
    )
    d, e = np.diff(first, axis=0)[:, None], np.diff(second, axis=0)[None]
    between = second[None, :-1] - first[:-1, None]
    det = d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0]
    safe = np.where(np.abs(det) < 1e-12, np.inf, det)
    s = (between[..., 0] * e[..., 1] - between[..., 1] * e[..., 0]) / safe
    t = (between[..., 0] * d[..., 1] - between[..., 1] * d[..., 0]) / safe
    hits = np.argwhere((s >= 0) & (s < 1) & (t >= 0) & (t < 1))
    if len(hits) != 1:
        return None
    i, j = hits[0]
    return first[i] + s[i, j] * d[i, 0]


def _others(net: Network, lines: dict[int, Line], node: int, strand: int, width_px: float) -> list[Arm]:
    return [arm(lines[other], other, end, width_px) for other, end in net.ends_at(node) if other != strand]


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
