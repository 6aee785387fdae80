"""Acute tips: strokes that end in one point, and whose ink is one long before they reach it.

Thinning sees a fork there, and a stem from the fork to the tip. The outer edges of the stem are those of
the outermost strokes, so half a width inside them run their centres; where these meet is the tip. A
mitred tip reaches farther than that, a bevelled one less far: neither changes where the centres meet.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arm
from wrapit.drawing.bitmap.centre_lines import Line, sample
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.overlaps.ribbon_axis import even
from wrapit.drawing.bitmap.overlaps.ribbons import between, measured
from wrapit.drawing.bitmap.overlaps.separate import lead_to
from wrapit.drawing.bitmap.strand_graph import StrandEnd, StrandGraph
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import angle, crossing, polynomial

# In stroke widths.
# How long may the stem of a tip be? The inner edges of a corner of angle a meet 1 / (2 sin(a / 2)) widths
# before its apex, 5.7 at 10 degrees, and its mitre reaches as far behind it.
_STEM = 13.0
# How far may the ink reach behind the apex? Half a width at a round tip; a mitre reaches farther, but tapers:
# halfway it is half as broad as the stroke, where a stroke that goes on is as broad as ever.
_REACHES = 0.8
_TAPERED = 0.8
# How far beside the middle of both sides may the stem end? None of the tips of 10 to 60
# degrees tried is lost by 0.4; one that ends farther off is a stroke that leaves to another side.
_ASTRAY = 0.4
# How much farther may one of its sides go on behind the apex than the other? The short end of a bar on a post
# looks like a stem, but goes on from the bar alone. Of 16 that stick out by 0.6 three are lost, without this
# nearly all.
_BEYOND = 0.25
# Up to where do the outer edges tell two centres? Until these are as near as 0.15; then the round tip begins
# to bend the edges. The sides are quadratics over 3 of length, as arms are.
_TOLD = 0.15
_SIDE = 3.0
# When do both strokes of a tip tell its width? When theirs are one within 0.08, and within 0.2 of the
# picture's, which is read from whole pixels: 7.7 for two strokes of 9 px, and tips 0.6 widths off.
_SAME = 0.08
_LIKE = 0.2
# Beyond how much of its merged ink may a tip lie? The mitre of 10 degrees is 5.7 long, and as much again for
# curved sides.
_AHEAD = 12.0


@dataclass(frozen=True, eq=False)
class Side:
    """One of the outermost strokes at a tip: its arm, and centres in the merged ink, the last first."""

    arm: Arm
    lead: FloatArray

    def model(self, width_px: float) -> FloatArray:
        """Coefficients (3, 2) in the length outward from its first point."""
        points = np.vstack([self.lead, self.arm.near(_SIDE * width_px)[1]])
        along = lengths(points)
        near = along <= max(_SIDE * width_px, along[min(5, len(along) - 1)])
        degree = 2 if along[near][-1] > 1.2 * width_px else 1
        model = polynomial(along[near], points[near], degree)
        return np.vstack([model, np.zeros((3 - len(model), 2))])


def open_tips(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Makes a corner of each acute tip: a fork whose stem ends where its outermost strokes would meet."""
    for node in [node for node in graph.nodes if graph.degree(node) >= 3]:
        stems = [
            (strand, end)
            for strand, end in graph.ends_at(node)
            if graph.degree(graph.other_node(strand, end)) == 1 and lines[strand].length < _STEM * width_px
        ]
        # Short strokes may all be stems: that of a tip is the one where the others meet.
        for stem in sorted(stems, key=lambda stem: lines[stem[0]].length):
            if _open(graph, lines, ink, width_px, node, stem):
                break


def _open(
    graph: StrandGraph,
    lines: dict[int, Line],
    ink: Ink,
    width_px: float,
    node: int,
    stem: StrandEnd,
) -> bool:
    """Whether a stem is a tip's; then its fork is a corner now."""
    strand, end = stem
    walked = lines[strand].points if end == 0 else lines[strand].points[::-1]
    arms = [arm(lines[s], s, e, width_px) for s, e in graph.ends_at(node) if s != strand]
    outermost = _outermost(arms, walked)
    width_px = _own_width(outermost, lines, width_px)
    sides = _sides(outermost, walked, ink, width_px)
    one, other = (side.model(width_px) for side in sides)
    found = crossing(one, other, _AHEAD * width_px, 0.05 * width_px)
    if found is None:
        return False
    apex, first, second = found
    between_sides = angle(first, second)
    mitre = width_px / 2 / math.sin(max(between_sides, 0.1) / 2)
    if between_sides > math.pi / 2 or np.linalg.norm(walked[-1] - apex) > mitre + _REACHES * width_px:
        return False
    ahead = -unit(first + second)
    beyond = walked[-1] - apex
    if abs(float(beyond @ np.array([-ahead[1], ahead[0]]))) > _ASTRAY * width_px:
        return False
    steps = np.arange(0.0, _STEM * width_px, 0.5)
    dark = sample(ink, np.stack([apex, apex]), -np.stack([first, second]), steps) <= ink.half
    if abs(int(np.argmin(dark[0])) - int(np.argmin(dark[1]))) / 2 > _BEYOND * width_px:
        return False
    if not _is_tip(apex, ahead, mitre, ink, width_px):
        return False
    graph.note("spur", walked[-1], lines[strand].length, "the tip of an acute corner")
    graph.drop_strand(strand)
    del lines[strand]
    graph.drop_lonely()
    graph.nodes[node] = apex
    graph.corners.add(node)
    for side in sides:
        if len(side.lead):
            known = np.ones(len(side.lead), dtype=bool)
            lead_to(graph, lines, side.arm, node, side.lead, known, width_px)
    return True


def _own_width(arms: tuple[Arm, Arm], lines: dict[int, Line], width_px: float) -> float:
    """The width of the strokes at a tip where both have one, and it is like the picture's; else that."""
    broad = [
        median(line.width[line.clean]) if line.clean.any() else width_px
        for line in (lines[each.strand] for each in arms)
    ]
    mean = sum(broad) / 2
    same = np.ptp(broad) < _SAME * mean and abs(mean - width_px) < _LIKE * width_px
    return mean if same else width_px


def _outermost(arms: list[Arm], walked: FloatArray) -> tuple[Arm, Arm]:
    """The leftmost and the rightmost arm for somebody who walks to the tip."""
    ahead = unit(walked[-1] - walked[0])
    across = [float(each.points[0] @ np.array([-ahead[1], ahead[0]])) for each in arms]
    return arms[int(np.argmax(across))], arms[int(np.argmin(across))]


def _sides(arms: tuple[Arm, Arm], walked: FloatArray, ink: Ink, width_px: float) -> tuple[Side, Side]:
    bare = Side(arms[0], np.zeros((0, 2))), Side(arms[1], np.zeros((0, 2)))
    before = between(arms, width_px)
    axis = even([before[::-1], walked], width_px)
    step = float(lengths(axis)[-1]) / (len(axis) - 1)
    found = measured(axis, ink, width_px, step)
    if found is None:
        return bare
    left, right, known, gap = found
    start = int(lengths(np.vstack([before[::-1], walked[:1]]))[-1] / step) if len(before) else 0
    told = np.flatnonzero(gap[start:] < _TOLD * width_px)
    last = start + (int(told[0]) if len(told) else len(gap) - start)
    known[last:] = False
    sides = []
    for each, centres in zip(arms, (left, right), strict=True):
        inside = (centres - each.points[0]) @ each.at(0.0)[1] < 0
        sides.append(Side(each, centres[known & inside][::-1]))
    return sides[0], sides[1]


def _is_tip(apex: FloatArray, ahead: FloatArray, mitre: float, ink: Ink, width_px: float) -> bool:
    """Whether the ink ends at an apex, or tapers from there on for as long as a mitre."""
    steps = np.arange(0.0, _STEM * width_px, 0.5)
    light = np.flatnonzero(sample(ink, apex[None], ahead[None], steps)[0] > ink.half)
    if not len(light):
        return False
    reach = float(steps[light[0]])
    if reach < _REACHES * width_px:
        return True
    if reach > mitre + _REACHES * width_px:
        return False
    across = np.array([-ahead[1], ahead[0]])
    offsets = np.arange(-width_px, width_px, 0.5)
    levels = sample(ink, (apex + reach / 2 * ahead)[None], across[None], offsets)[0]
    return float((levels <= ink.half).mean()) * 2 < _TAPERED
