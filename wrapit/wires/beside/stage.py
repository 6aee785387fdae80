"""Lays the trails of a solution as chains, runs of the same lines side by side."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.decomposition.json_file import wire_name
from wrapit.decomposition.model import Trail
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.geometry import BezierChain, from_chain, straight
from wrapit.geometry.arclength import ArcLength, piece
from wrapit.geometry.bezier import joined as as_one
from wrapit.wires.beside.bulb import bulb, bulb_reach_mm
from wrapit.wires.beside.sections import Item, laid_section
from wrapit.wires.beside.sides import Stretch, find_stretches
from wrapit.wires.centreline import END_TRIM, Joined, join
from wrapit.wires.rounding import bend_rad

# Centrelines of two runs are so many diameters apart: a kernel sees two solids that don't touch, and a hand
# no gap between them.
APART = 1.02
# Before its hairpin a stretch keeps what the corner at its other end takes; for one sharper than this no more
# than for this, 1.8 radii.
SHARPEST_RAD = math.radians(120)
# Where the lines don't turn at all, a stretch keeps so many diameters, or nothing would be left of it.
LEAST_STEM = 0.5


@dataclass(frozen=True, eq=False)
class Beside:
    """All trails as chains, the stretches with two runs side by side, and how far wires lie off lines."""

    joined: tuple[Joined, ...]
    stretches: tuple[Stretch, ...]
    moved_mm: tuple[float, ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True, eq=False)
class _Line:
    """The line of a stretch as its first run follows it, up to where a hairpin starts.

    `tip_mm` is how far its hairpin reaches beyond the end of the drawing's line.
    """

    joined: Joined
    stem: BezierChain
    tip_mm: float = 0.0


def lay_beside(drawing: Drawing, trails: Sequence[Trail], diameter_mm: float, radius_mm: float) -> Beside:
    """Each trail as one chain whose bends have the radius, where there is room.

    Where two runs follow the same segments they lie APART diameters from one another. Findings name
    segments where they can't, and hairpins that reach beyond their line. A trail that runs along no segment
    twice, and shares none, is the same as without.
    """
    apart_mm = APART * diameter_mm
    counts = Counter(step.segment for trail in trails for step in trail.traversals)
    swapped: set[int] = set()
    left_out: set[int] = set()
    while True:
        stretches = [
            stretch.swapped if swapped.intersection(stretch.segments) else stretch
            for stretch in find_stretches(drawing, trails, apart_mm, left_out)
        ]
        lines = [_line(drawing, trails, stretch, apart_mm, radius_mm) for stretch in stretches]
        laid, tight = [], set[int]()
        for index in range(len(trails)):
            chain, wrong = _laid(drawing, trails, index, stretches, lines, apart_mm, radius_mm)
            laid.append(chain)
            tight |= wrong
        if not tight:
            break
        # On the other side the run may be on the outside of what bends so tightly.
        left_out |= tight & swapped
        swapped |= tight
    moved = [0.0] * len(trails)
    findings = []
    for stretch, line in zip(stretches, lines, strict=True):
        for strand in stretch.strands:
            moved[strand.trail] = max(moved[strand.trail], apart_mm / 2)
        if stretch.folded:
            moved[stretch.strands[0].trail] = max(moved[stretch.strands[0].trail], radius_mm, line.tip_mm)
            findings += _short(stretch, line, laid)
    unlaid = sorted(left_out | {segment for segment, count in counts.items() if count > 2})
    findings += [_on_top(trails, laid, segment, counts[segment]) for segment in unlaid]
    return Beside(tuple(laid), tuple(stretches), tuple(moved), tuple(findings))


def _line(
    drawing: Drawing, trails: Sequence[Trail], stretch: Stretch, apart_mm: float, radius_mm: float
) -> _Line:
    strand = stretch.strands[0]
    steps = trails[strand.trail].traversals[strand.first : strand.last + 1]
    curves = [_curve(drawing, step.segment, step.reversed) for step in steps]
    # The inner run keeps the radius.
    whole = join(curves, radius_mm + apart_mm / 2)
    if not stretch.folded:
        return _Line(whole, whole.chain)
    length_mm, reach_mm = whole.chain.length, bulb_reach_mm(apart_mm / 2, radius_mm)
    bends = [min(bend, SHARPEST_RAD) for bend in _bends_rad(drawing, trails, stretch, whole.chain)]
    corner_mm = (radius_mm + apart_mm / 2) * math.tan(max(bends, default=0.0) / 2) / END_TRIM
    stem_mm = max(length_mm - reach_mm, corner_mm, LEAST_STEM * apart_mm)
    stem = piece(whole.chain, 0.0, stem_mm)
    if stem_mm > length_mm:
        stem = as_one([stem, straight(stem.end, stem.end + (stem_mm - length_mm) * stem.end_tangent)])
    return _Line(whole, stem, max(0.0, stem_mm + reach_mm - length_mm))


def _bends_rad(drawing: Drawing, trails: Sequence[Trail], stretch: Stretch, line: BezierChain) -> list[float]:
    """By how much the wire turns where it comes to a folded stretch and where it leaves it."""
    out, back = stretch.strands
    steps = trails[out.trail].traversals
    beyond = []
    if out.first > 0:
        beyond.append(_curve(drawing, *steps[out.first - 1]).reversed())
    if back.last + 1 < len(steps):
        beyond.append(_curve(drawing, *steps[back.last + 1]))
    return [bend_rad(line.reversed(), curve) for curve in beyond]


def _laid(
    drawing: Drawing,
    trails: Sequence[Trail],
    index: int,
    stretches: Sequence[Stretch],
    lines: Sequence[_Line],
    apart_mm: float,
    radius_mm: float,
) -> tuple[Joined, frozenset[int]]:
    """One trail, and segments of it that can't be laid beside another."""
    starts = {
        strand.first: (stretch, line, which)
        for stretch, line in zip(stretches, lines, strict=True)
        for which, strand in enumerate(stretch.strands)
        if strand.trail == index
    }
    steps = trails[index].traversals
    if not starts:
        return join([_curve(drawing, *step) for step in steps], radius_mm), frozenset()
    sections: list[list[Item]] = [[]]
    tips: list[BezierChain] = []
    at = 0
    while at < len(steps):
        if at not in starts:
            curve = _curve(drawing, *steps[at])
            sections[-1].append(Item(curve, (steps[at].segment,), False, 0.0, np.empty((0, 2))))
            at += 1
            continue
        stretch, line, which = starts[at]
        sections[-1].append(_item(stretch, line, which, apart_mm))
        if stretch.folded and which == 0:
            shift_mm = stretch.shifts(apart_mm)[0]
            tips.append(bulb(line.stem.end, line.stem.end_tangent, shift_mm, radius_mm))
            sections.append([])
        at = stretch.strands[which].last + 1
    laid = [
        laid_section(section, radius_mm, apart_mm / APART / 2, (place == 0, place == len(tips)))
        for place, section in enumerate(sections)
    ]
    tight = frozenset[int]().union(*(each.tight for each in laid))
    if tight:
        return laid[0].joined, tight  # nobody looks at it: the trail is laid again without them
    return _connected([each.joined for each in laid], tips), tight


def _item(stretch: Stretch, line: _Line, which: int, apart_mm: float) -> Item:
    course = ArcLength(from_chain(line.joined.chain))
    ends_mm = np.array([end for _, end in line.joined.spans_mm[:-1]])
    joints = course.spline.at(course.parameter(ends_mm)) if len(ends_mm) else np.empty((0, 2))
    corners = tuple(
        (corner, course.spline.at(course.parameter(np.array([corner.at_mm])))[0])
        for corner in line.joined.corners
    )
    segments, stem = stretch.segments, line.stem
    if which == 1 and stretch.opposed:
        segments, stem, joints = segments[::-1], stem.reversed(), joints[::-1]
    return Item(stem, segments, True, stretch.shifts(apart_mm)[which], joints, corners)


def _connected(sections: Sequence[Joined], tips: Sequence[BezierChain]) -> Joined:
    """Sections with a hairpin between each two; the middle of that is where one segment ends."""
    chains = [sections[0].chain]
    spans, corners = list(sections[0].spans_mm), list(sections[0].corners)
    at_mm = sections[0].chain.length
    for section, tip in zip(sections[1:], tips, strict=True):
        middle_mm = at_mm + tip.length / 2
        spans[-1] = (spans[-1][0], middle_mm)
        at_mm += tip.length
        moved = [(start + at_mm, end + at_mm) for start, end in section.spans_mm]
        spans += [(middle_mm, moved[0][1]), *moved[1:]]
        corners += [dataclasses.replace(corner, at_mm=corner.at_mm + at_mm) for corner in section.corners]
        at_mm += section.chain.length
        chains += [tip, section.chain]
    points = np.concatenate([chain.points for chain in chains])
    points[1:, 0] = points[:-1, 3]
    return Joined(BezierChain(points), tuple(spans), tuple(corners))


def _curve(drawing: Drawing, segment: int, backwards: bool) -> BezierChain:
    curve = drawing.segments[segment].curve
    return curve.reversed() if backwards else curve


def _short(stretch: Stretch, line: _Line, laid: Sequence[Joined]) -> list[Finding]:
    if line.tip_mm < 0.01:
        return []
    strand = stretch.strands[0]
    return [
        Finding(
            "warning",
            "hairpin-short",
            f"{wire_name(strand.trail)} at {laid[strand.trail].spans_mm[strand.last][1]:.0f} mm",
            f"the line is too short to turn back on: the bend reaches {line.tip_mm:.1f} mm beyond its end",
            "lengthen the line, or use thinner or softer wire",
            severity=1 + line.tip_mm / line.joined.chain.length,
        )
    ]


def _on_top(trails: Sequence[Trail], laid: Sequence[Joined], segment: int, count: int) -> Finding:
    trail, index = next(
        (trail, index)
        for trail, walk in enumerate(trails)
        for index, step in enumerate(walk.traversals)
        if step.segment == segment
    )
    why = "bends too tightly" if count == 2 else f"is run along {count} times"
    return Finding(
        "warning",
        "tight-double",
        f"{wire_name(trail)} at {sum(laid[trail].spans_mm[index]) / 2:.0f} mm",
        f"the line {why}, so its runs lie upon one another there",
        "draw the line with wider bends, or use thinner wire",
    )
