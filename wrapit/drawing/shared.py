"""Explains stretches of ink that two strokes share: do they cross in it, once or twice, or only touch?

Each way to pair the arms at both ends gives two smooth curves through the stretch. They are drawn again,
and the pairing is kept whose width along the stretch agrees with the ink's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from wrapit.drawing.centring import Line
from wrapit.drawing.junctions import Arm, Through, arm, through, turn
from wrapit.drawing.network import Network
from wrapit.geometry import FloatArray, unit

Kind = Literal["cross", "braid", "touch"]

# In stroke widths.
_LONGEST = 30.0
_SHORT = 2.5
_MISFIT = 0.28
_BETTER = 0.6
_EXCESS = 0.15
_TOUCH = 0.4
_BRAID = 1.5
_TURN_RAD = np.radians(30)
_TURN_SEEN_RAD = np.radians(65)
_TURN_BRAID_RAD = np.radians(110)
_MISFIT_BRAID = 0.3
_BETTER_BRAID = 0.68


@dataclass(frozen=True, eq=False)
class Meeting:
    """A crossing of two curves: their lengths there (zero midway between the arms), and the place."""

    along: tuple[float, float]
    at: FloatArray


@dataclass(frozen=True, eq=False)
class Explanation:
    """Two strokes through a shared stretch: each a pair of arms (one at either end) and its curve."""

    kind: Kind
    strand: int
    cost: float
    pairs: list[tuple[Arm, Arm]]
    curves: list[Through]
    meetings: list[Meeting]


def worth_explaining(line: Line, width_px: float) -> bool:
    """Whether a stretch is short, or wider than one stroke."""
    if line.length > _LONGEST * width_px:
        return False
    return line.length <= _SHORT * width_px or excess(line, width_px) >= _EXCESS


def explain(net: Network, lines: dict[int, Line], strand: int, width_px: float) -> Explanation | None:
    """The best explanation of a stretch between two forks by two strokes, or nothing."""
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
        if max(turns) > (_TURN_BRAID_RAD if line.length > _SHORT * width_px else _TURN_SEEN_RAD):
            continue
        curves = [through(a, b) for a, b in pairs]
        crossed, together = _misfits(line, _apart(curves, line), width_px)
        cost = sum(value**2 for value in turns)
        if line.length > _SHORT * width_px:
            # Along a long stretch the ink's width says more than the bends.
            cost = cost / 10 + (2 * crossed) ** 2
        elif line.length > 0.8 * width_px:
            cost += crossed**2
        if best is None or cost < best[0]:
            best = (cost, turns, curves, pairs, crossed, together)
    if best is None:
        return None
    cost, turns, curves, pairs, crossed, together = best
    fits = crossed < _MISFIT and crossed < _BETTER * together
    long = line.length > _SHORT * width_px
    seen = line.length > 0.8 * width_px and fits
    kind, meetings = _kind(curves, width_px, long)
    if kind == "braid":
        # One of the two strokes bulges, so it bends a lot; only the ink's width can tell.
        fits = crossed < _MISFIT_BRAID and crossed < _BETTER_BRAID * together and min(turns) < _TURN_RAD
    else:
        fits = max(turns) < (_TURN_SEEN_RAD if seen else _TURN_RAD) and (seen or not long)
    return Explanation(kind, strand, cost, pairs, curves, meetings) if kind is not None and fits else None


def _kind(curves: list[Through], width_px: float, long: bool) -> tuple[Kind | None, list[Meeting]]:
    meetings, gap = _meetings(curves[0], curves[1], width_px)
    if len(meetings) == 1:
        return "cross", meetings
    if not meetings and gap > _TOUCH * width_px:
        return "touch", meetings
    if len(meetings) == 2 and long:
        apart = float(np.linalg.norm(meetings[0].at - meetings[1].at))
        return ("braid" if apart > _BRAID * width_px else None), meetings
    return None, meetings


def _meetings(a: Through, b: Through, width_px: float) -> tuple[list[Meeting], float]:
    """Where two curves cross between their arms, in walking order, and how near they come."""
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
    found = []
    for i, j in np.argwhere((s >= 0) & (s < 1) & (t >= 0) & (t < 1)):
        steps = (along[0][1] - along[0][0], along[1][1] - along[1][0])
        places = (along[0][i] + s[i, j] * steps[0], along[1][j] + t[i, j] * steps[1])
        found.append(Meeting((float(places[0]), float(places[1])), first[i] + s[i, j] * d[i, 0]))
    return found, float(np.linalg.norm(first[:, None] - second[None], axis=2).min())


def excess(line: Line, width_px: float) -> float:
    """How much wider (stroke widths) the ink along a line is than one stroke, on average."""
    width = np.where(np.isfinite(line.width), np.minimum(line.width, 2 * width_px), 2 * width_px)
    return float(width.mean()) / width_px - 1


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
