"""Joins the segments of a trail into one smooth chain; corners are rounded to what the metal allows."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, from_chain, unit
from wrapit.geometry.arclength import NEAR_MM, ArcLength, cut
from wrapit.wires.fairing import faired
from wrapit.wires.rounding import (
    FOLD_RAD,
    SMOOTH_BEND_RAD,
    Blend,
    bend_rad,
    best_blend,
    corner_blend,
    turning_rad,
)

# Bends from here on are rounded first. In the wires of 60 drawings 7 places are tighter than a tenth of what
# the metal takes; 9 if all bends share the room between them.
BLUNT_RAD = math.radians(10)
# How far that may reach. On three of our drawings a third more or less moves no wire; they bound what strange
# drawings may ask for.
RELAX_RADII = 4.0  # how far beyond a tight span a wire may leave the drawing to widen it
MAX_TRIM = 0.45  # share of a segment that one corner may use up
END_TRIM = 0.95  # and of one that has no other corner, as a hairpin follows
# A side so short between two corners, or behind the last one, has no room for a bend (a blend is twice as
# long): the two are one, and the line ends with the corner. Of 500 such wires, with sides of a hundredth of a
# micrometre to two millimetres, one in four had no sound solid; with 0.05, 0.15 and 0.25 all have one.
SLIVER_MM = 0.15
# That is so where the sides around have room, in slivers. Many short sides in a row are a curve.
_AROUND = 4.0


@dataclass(frozen=True)
class Corner:
    """A rounded bend."""

    at_mm: float
    bend_rad: float
    radius_mm: float
    deviation_mm: float


@dataclass(frozen=True, eq=False)
class Joined:
    """One chain for a whole trail; `spans_mm[i]` is where traversal i runs along it."""

    chain: BezierChain
    spans_mm: tuple[tuple[float, float], ...]
    corners: tuple[Corner, ...]


def join(
    curves: Sequence[BezierChain],
    min_radius_mm: float,
    held: tuple[bool, bool] = (True, True),
    between_mm: Sequence[float] | None = None,
) -> Joined:
    """One chain, G1 but at folds; bends become arcs of `min_radius_mm` where there is room.

    Each curve starts where the one before ends. Kinks inside a curve are rounded like those between curves.
    `between_mm` are the radii of bends between two curves, where these aren't the same. `held` says for both
    ends whether the line ends there: where it goes on straight, one bend may use up almost all of the last
    curve.
    """
    split = [_split_at_kinks(faired(curve, min_radius_mm)) for curve in curves]
    pieces = _from_start(_to_end(_aligned([piece for group in split for piece in group])))
    ends = list(itertools.accumulate(map(len, split)))
    asked_mm = [min_radius_mm] * (len(pieces) - 1)
    for end, radius in zip(ends, between_mm or (), strict=False):
        asked_mm[end - 1] = radius
    drawn_mm = np.cumsum([0.0, *(piece.length for piece in pieces)])
    bounds_mm = drawn_mm[[0, *ends]]
    corners: list[Corner] = []
    # Blunt bends are rounded in what sharp ones leave of the line: beside a tip they would take its room.
    for least_rad in (BLUNT_RAD, SMOOTH_BEND_RAD):
        pieces, asked_mm, places_mm, new = _rounded(pieces, asked_mm, held, least_rad)
        bounds_mm = np.interp(bounds_mm, *places_mm)
        corners = [
            dataclasses.replace(corner, at_mm=float(np.interp(corner.at_mm, *places_mm)))
            for corner in corners
        ] + new
    spans_mm = tuple(itertools.pairwise(bounds_mm.tolist()))
    joined = Joined(_connected(pieces), spans_mm, tuple(sorted(corners, key=lambda corner: corner.at_mm)))
    return _relaxed(joined, min_radius_mm)


def _rounded(
    pieces: Sequence[BezierChain], asked_mm: Sequence[float], held: tuple[bool, bool], least_rad: float
) -> tuple[list[BezierChain], list[float], FloatArray, list[Corner]]:
    """The pieces with bends from `least_rad` on rounded, each to the radius asked for at its joint.

    Pieces that a bend ties become one. Told are the radii asked for at the joints that stay, and where places
    along the pieces (first row) come to lie (second).
    """
    bends = [bend_rad(*pair) for pair in itertools.pairwise(pieces)]
    drawn_mm = np.cumsum([0.0, *(piece.length for piece in pieces)])
    sharp = _corners(drawn_mm, bends, least_rad)
    bounds = list(itertools.pairwise([0, *sharp, len(pieces)]))
    sides = [_connected(pieces[a:b]) for a, b in bounds]
    blends = []
    for i, joint in enumerate(sharp):
        radius_mm = asked_mm[joint - 1]
        before_mm = _room_mm(sides[i], pieces[joint - 1], radius_mm, alone=i == 0 and not held[0])
        after_mm = _room_mm(sides[i + 1], pieces[joint], radius_mm, alone=i + 2 == len(sides) and not held[1])
        blends.append(corner_blend(sides[i], sides[i + 1], min(before_mm, after_mm), radius_mm))
    groups: list[list[BezierChain]] = [[]]
    left_mm: list[float] = []
    places_mm, corners = [(0.0, 0.0)], []
    at_mm = head = 0.0
    for (first, last), blend in itertools.zip_longest(bounds, blends):
        tail = blend.trim_mm if blend is not None else 0.0
        start, end = drawn_mm[first] + head, drawn_mm[last] - tail
        for k in range(first, last):
            if drawn_mm[k + 1] < start + NEAR_MM or drawn_mm[k] > end - NEAR_MM:
                continue  # it is all within a bend
            if groups[-1] and drawn_mm[k] > start:
                groups.append([])
                left_mm.append(asked_mm[k - 1])
            groups[-1].append(
                _trimmed(pieces[k], max(0.0, start - drawn_mm[k]), max(0.0, drawn_mm[k + 1] - end))
            )
            at_mm += groups[-1][-1].length
        if blend is None:
            break
        half = sum(curve.length for curve in blend.curves) / 2
        corner_mm = float(drawn_mm[last])
        places_mm += [
            (corner_mm - tail, at_mm),
            (corner_mm, at_mm + half),
            (corner_mm + tail, at_mm + 2 * half),
        ]
        at_mm += 2 * half
        head = tail
        if blend.curves:
            groups[-1] += blend.curves
            corners.append(Corner(at_mm - half, bends[last - 1], blend.radius_mm, blend.deviation_mm))
        else:
            groups.append([])
            left_mm.append(asked_mm[last - 1])
    places_mm.append((float(drawn_mm[-1]), at_mm))
    return [_connected(group) for group in groups], left_mm, np.transpose(places_mm), corners


def _room_mm(side: BezierChain, piece: BezierChain, radius_mm: float, *, alone: bool) -> float:
    """How much of a side a corner may use up: of the piece beside it, unless that is shorter than a bend."""
    share = END_TRIM if alone else MAX_TRIM
    return share * (side if piece.length < radius_mm else piece).length


def _split_at_kinks(curve: BezierChain) -> list[BezierChain]:
    cubics = [BezierChain(points[None]) for points in curve.points]
    kinks = [
        index + 1
        for index, pair in enumerate(itertools.pairwise(cubics))
        if bend_rad(*pair) >= SMOOTH_BEND_RAD
    ]
    return [BezierChain(curve.points[a:b]) for a, b in itertools.pairwise([0, *kinks, len(curve)])]


def _to_end(pieces: list[BezierChain]) -> list[BezierChain]:
    """The pieces with a last one that is no sliver behind a corner: the one before leads to its end."""
    if len(pieces) < 2 or not pieces[-1].length < SLIVER_MM <= pieces[-2].length / _AROUND:
        return pieces
    if bend_rad(*pieces[-2:]) < SMOOTH_BEND_RAD:
        return pieces
    points = pieces[-2].points.copy()
    points[-1, 2:] += pieces[-1].end - points[-1, 3]
    bent = BezierChain(points)
    return [*pieces[:-2], *cut(bent, bent.length - SLIVER_MM)]


def _from_start(pieces: list[BezierChain]) -> list[BezierChain]:
    """The same for the first one."""
    return [piece.reversed() for piece in _to_end([piece.reversed() for piece in pieces[::-1]])[::-1]]


def _corners(at_mm: FloatArray, bends: Sequence[float], least_rad: float) -> list[int]:
    """The joints that are corners, each by the piece after it; of two with a sliver between, the sharper."""
    joints = [joint for joint, bend in enumerate(bends, 1) if bend >= least_rad]
    while True:
        bounds = [0, *joints, len(at_mm) - 1]
        sides_mm = np.diff(at_mm[bounds])
        weaker = [
            min(bounds[i : i + 2], key=lambda joint: bends[joint - 1])
            for i in range(1, len(sides_mm) - 1)
            if sides_mm[i] < SLIVER_MM <= min(sides_mm[i - 1], sides_mm[i + 1]) / _AROUND
            and max(bends[joint - 1] for joint in bounds[i : i + 2]) <= FOLD_RAD
        ]
        if not weaker:
            return joints
        joints.remove(weaker[0])


def _aligned(curves: Sequence[BezierChain]) -> list[BezierChain]:
    """The curves with handles turned to one direction wherever they differ by noise only."""
    points = np.concatenate([curve.points for curve in curves])
    cubics = [BezierChain(cubic[None]) for cubic in points]
    for index, (before, after) in enumerate(itertools.pairwise(cubics)):
        if bend_rad(before, after) < SMOOTH_BEND_RAD:
            direction = unit(before.end_tangent + after.start_tangent)
            at = before.end
            points[index, 2] = at - direction * np.linalg.norm(at - points[index, 2])
            points[index + 1, 1] = at + direction * np.linalg.norm(points[index + 1, 1] - at)
    firsts = itertools.accumulate((len(curve) for curve in curves), initial=0)
    return [BezierChain(points[a:b]) for a, b in itertools.pairwise(firsts)]


def _relaxed(joined: Joined, min_radius_mm: float) -> Joined:
    """Spans that bend more tightly than the metal allows are widened, where a short stretch is enough."""
    for start_mm, end_mm in reversed(_tight_spans(joined.chain, min_radius_mm)):
        middle, half = (start_mm + end_mm) / 2, (end_mm - start_mm) / 2
        room = min(middle, joined.chain.length - middle, half + RELAX_RADII * min_radius_mm) - 1e-3
        if room <= half:
            continue
        before, after = cut(joined.chain, middle)
        blend = best_blend(before, after, half + 0.05, room, min_radius_mm)
        if blend.curves and blend.radius_mm >= 0.999 * min_radius_mm and blend.deviation_mm <= min_radius_mm:
            joined = _replaced(joined, middle, before, after, blend)
    return joined


def _tight_spans(chain: BezierChain, min_radius_mm: float) -> list[tuple[float, float]]:
    """Where the curvature is beyond the metal's, joined where they are nearer than that radius."""
    lengths = ArcLength(from_chain(chain))
    at_mm = lengths.stations(0.02)
    middle_mm = (at_mm[:-1] + at_mm[1:]) / 2
    tight = np.abs(lengths.spline.curvature(lengths.parameter(middle_mm))) > 1.01 / min_radius_mm
    spans: list[tuple[float, float]] = []
    for a, b in np.flatnonzero(np.diff(np.r_[False, tight, False])).reshape(-1, 2):
        start, end = float(at_mm[a]), float(at_mm[b])
        if spans and start - spans[-1][1] < min_radius_mm:
            spans[-1] = (spans[-1][0], end)
        else:
            spans.append((start, end))
    return spans


def _replaced(
    joined: Joined, middle_mm: float, before: BezierChain, after: BezierChain, blend: Blend
) -> Joined:
    low, high = middle_mm - blend.trim_mm, middle_mm + blend.trim_mm
    new_mm = sum(curve.length for curve in blend.curves)

    def moved(at_mm: float) -> float:
        return (
            float(np.interp(at_mm, [low, high], [low, low + new_mm]))
            + max(0.0, at_mm - high)
            - max(0.0, low - at_mm)
        )

    chain = [_trimmed(before, 0.0, blend.trim_mm), *blend.curves, _trimmed(after, blend.trim_mm, 0.0)]
    corners = [dataclasses.replace(corner, at_mm=moved(corner.at_mm)) for corner in joined.corners]
    bend = turning_rad(chain[0].end_tangent, chain[-1].start_tangent)
    corners.append(Corner(low + new_mm / 2, bend, blend.radius_mm, blend.deviation_mm))
    spans = tuple((moved(start), moved(end)) for start, end in joined.spans_mm)
    return Joined(_connected(chain), spans, tuple(sorted(corners, key=lambda corner: corner.at_mm)))


def _trimmed(piece: BezierChain, head: float, tail: float) -> BezierChain:
    if tail > 0:
        piece = cut(piece, piece.length - tail)[0]
    return cut(piece, head)[1] if head > 0 else piece


def _connected(chain: Sequence[BezierChain]) -> BezierChain:
    """One chain; ends that differ by rounding are made the same."""
    points = np.concatenate([curve.points for curve in chain])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)
