"""Explains short stretches of ink between two forks: are these two joints, or one, as where strokes cross?

Both answers are drawn again as they would be traced, and compared with the ink.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arm, usual_width, widths_near
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.overlaps.redrawn import joint, meeting, surroundings, two_joints
from wrapit.drawing.bitmap.pairing import Through, stepped, through, turn
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray

# In stroke widths: what stretch is short? Longer ones are ribbons, whose edges tell more.
_LONGEST = 2.5
# How much may a stroke turn where it crosses another?
_TURN_RAD = np.radians(65)
# By how many squared stroke widths may a crossing miss the ink by more than two joints do, which can be put
# where they fit best? Of icons, tangles and bars, crossings do by 0.03 at most, bars between joints by 0.13.
_ALIKE = 0.07
# Shorter stretches are one crossing whatever their arms say: thinning alone tears a right-angled one so far.
_TORN = 0.5


@dataclass(frozen=True, eq=False)
class Explanation:
    """A joint in place of a stretch, the arms that cross there, one at either end, and what misses the ink.

    `misfit` is in squared stroke widths.
    """

    strand: int
    at: FloatArray
    pairs: list[tuple[Arm, Arm]]
    misfit: float


def worth_explaining(line: Line, width_px: float) -> bool:
    """Whether a stretch is short."""
    return line.length <= _LONGEST * width_px


def explain(
    graph: StrandGraph, lines: dict[int, Line], strand: int, ink: Ink, width_px: float
) -> Explanation | None:
    """The joint that a stretch between two forks is; nothing if it is a stroke of its own."""
    s, line = graph.strands[strand], lines[strand]
    heads = _others(graph, lines, s.start, strand, width_px)
    tails = _others(graph, lines, s.end, strand, width_px)
    if len(heads) != 2 or len(tails) != 2:
        return None
    arms = [*heads, *tails]
    own_px = usual_width(widths_near(lines, arms, width_px), width_px)
    around = surroundings(ink, line.points, heads, tails, own_px)
    stretch = arm(line, strand, 0, width_px), arm(line, strand, 1, width_px)
    two = around.misfit(two_joints(line.points, heads, tails, stretch, ink))
    crossings = []
    for pairs, at in _crossings(heads, tails, width_px):
        index = [(arms.index(a), arms.index(b)) for a, b in pairs]
        crossings.append(Explanation(strand, at, pairs, around.misfit(joint(arms, at, index, ink))))
    best = min(crossings, key=lambda each: each.misfit, default=None)
    if best is not None and best.misfit < two + _ALIKE:
        return best
    middle = line.points[len(line.points) // 2]
    met = around.misfit(meeting(arms, middle, ink))
    return Explanation(strand, middle, [], met) if met < two else None


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


def _crossings(
    heads: list[Arm], tails: list[Arm], width_px: float
) -> list[tuple[list[tuple[Arm, Arm]], FloatArray]]:
    """The ways in which two strokes cross once and turn little, and where."""
    found = []
    for pairs in _crossed(heads, tails):
        if max(turn(a, b) for a, b in pairs) < _TURN_RAD:
            one, other = (through(a, b) for a, b in pairs)
            places = _common(one, other, width_px)
            if len(places) == 1:
                found.append((pairs, places[0]))
    return found


def _common(a: Through, b: Through, width_px: float) -> list[FloatArray]:
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
