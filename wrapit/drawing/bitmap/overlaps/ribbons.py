"""Two strokes that run along each other as one broad ribbon of ink: where does each run?

The edges of a ribbon are those of the two strokes, so half a stroke width inside either edge runs the
centre of one of them. Only which is which is open: they may change sides wherever the ribbon is as
narrow as a single stroke (`swaps.py` tells where).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.arms import Arm, arm, usual_width, widths_near
from wrapit.drawing.bitmap.centre_lines import Line, edges, smoothed
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.overlaps.ribbon_axis import RibbonAxis, axis_of, even
from wrapit.drawing.bitmap.overlaps.swaps import swaps_of
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polyline import lengths, slopes
from wrapit.geometry.polynomials import angle

# All in stroke widths. Each was varied by 30 % on 48 generated overlaps (crossings at 10 to 20 degrees,
# lenses, three crossings in a row, shared and touching stretches); where nothing is said, none came out
# differently.
# How are the edges measured? Up to 1.7 from the axis: where centres are 1.6 apart they are 1.3 away
# (with a reach of 1.2 neither crossings below 15 degrees nor touching strokes are found), over paper of up to
# 0.35, the pinholes between the strokes. The axis is smoothed over 0.5, the edges' slope over 0.4.
_REACH = 1.7
_BRIDGED = 0.35
_AXIS = 0.5
_SLOPE = 0.4
# How far beyond its forks is a ribbon followed? As long as both arms lie within 1.7 of each other, 2 at most.
_BEYOND = 2.0
_BEYOND_APART = 1.7
# When do two strokes only touch? Where nowhere their centres come within 0.15, all four arms go onward within
# 60 degrees, and the broadest is less than 1.4 times the thinnest (at 0.98, no touching is found at all).
_TOUCH = 0.15
_ONWARD_RAD = math.radians(60)
_ALIKE = 1.4
# How near to a crossing is the centre unknown? Where both strokes lie on each other.
_ROUND = 0.25


@dataclass(frozen=True, eq=False)
class Ribbon:
    """Two strokes that share ink: their centres on its left and right side (n, 2), and where they swap.

    `heads` and `tails` are the arms at its ends, the left one first; `strands` and `inner` are the
    strands and the nodes between that make way for the two strokes.
    """

    strands: tuple[int, ...]
    inner: tuple[int, ...]
    ends: tuple[int, int]
    heads: tuple[Arm, Arm]
    tails: tuple[Arm, Arm]
    left: FloatArray
    right: FloatArray
    swaps: tuple[int, ...]
    clean: NDArray[np.bool_]
    width_px: float
    misfit: float


def find_ribbons(
    graph: StrandGraph, lines: dict[int, Line], strands: list[int], ink: Ink, width_px: float
) -> list[Ribbon]:
    """Ribbons that start from some of the strands and in which two strokes can be told apart."""
    found, seen = [], set[int]()
    for strand in strands:
        if strand in seen or strand not in graph.strands:
            continue
        way = axis_of(graph, lines, strand, width_px)
        if way is None:
            continue
        seen |= set(way.strands)
        ribbon = _explained(graph, lines, way, ink, width_px)
        if ribbon is not None:
            found.append(ribbon)
    return found


def _explained(
    graph: StrandGraph, lines: dict[int, Line], way: RibbonAxis, ink: Ink, width_px: float
) -> Ribbon | None:
    heads = _sides(graph, lines, way.ends[0], way, way.points, width_px)
    tails = _sides(graph, lines, way.ends[1], way, way.points[::-1], width_px)
    if heads is None or tails is None:
        return None
    # Seen from the other end, left is right.
    tails = tails[1], tails[0]
    widths = widths_near(lines, [*heads, *tails], width_px)
    usual = usual_width(widths, width_px)
    before, after = (between(pair_, usual) for pair_ in (heads, tails))
    axis = even([before[::-1], way.points, after], usual)
    along = lengths(axis)
    step = along[-1] / (len(axis) - 1)
    core = slice(
        int(lengths(np.vstack([before[::-1], way.points[:1]]))[-1] / step),
        len(axis) - int(lengths(np.vstack([way.points[-1:], after]))[-1] / step),
    )
    sides = measured(axis, ink, usual, step)
    if sides is None:
        return None
    left, right, known, gap = sides
    found = swaps_of(gap / usual, known, step / usual)
    if found is None:
        return None
    touching = gap.min() > _TOUCH * usual and _may_touch(widths, [*heads, *tails], way)
    if not found[0] and not touching:
        return None
    swaps = [int(np.clip(at, core.start + 1, core.stop - 2)) - core.start for at in found[0]]
    if len(set(swaps)) < len(found[0]):
        return None
    clean = known[core].copy()
    for swap in swaps:
        clean &= np.abs(np.arange(len(clean)) - swap) * step > _ROUND * usual
    return Ribbon(
        way.strands, way.inner, way.ends, heads, tails,
        left[core], right[core],
        tuple(swaps), clean, usual, found[1],
    )  # fmt: skip


def measured(
    axis: FloatArray, ink: Ink, width_px: float, step: float
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], FloatArray] | None:
    """Centres of the left and the right stroke beside the axis, where they are known, and their distance."""
    index = np.arange(len(axis))
    # The first pass only finds the middle.
    for _ in range(2):
        axis = smoothed(axis, _AXIS * width_px / step, False)
        tangent = unit(slopes(axis))
        normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
        right, left = edges(ink, axis, normal, _REACH * width_px, width_px / 14, bridged=_BRIDGED * width_px)
        known = np.isfinite(left) & np.isfinite(right)
        if known.mean() < 0.8:
            return None
        left, right = (np.interp(index, index[known], side[known]) for side in (left, right))
        middle = axis
        axis = axis + (left - right)[:, None] / 2 * normal
    sigma = _SLOPE * width_px / step
    left, right = (side - width_px / 2 * _secant(side, step, sigma) for side in (left, right))
    gap = np.maximum(left + right, 0.0)
    return middle + left[:, None] * normal, middle - right[:, None] * normal, known, gap


def between(arms: tuple[Arm, Arm], width_px: float) -> FloatArray:
    """The way on between two arms beyond their fork, as far as both still touch it."""
    first, second = (each.near(_BEYOND * width_px)[1] for each in arms)
    count = min(len(first), len(second))
    near = np.linalg.norm(first[:count] - second[:count], axis=1) < _BEYOND_APART * width_px
    count = count if near.all() else int(np.argmin(near))
    return (first[:count] + second[:count]) / 2


def _sides(
    graph: StrandGraph,
    lines: dict[int, Line],
    node: int,
    way: RibbonAxis,
    walked: FloatArray,
    width_px: float,
) -> tuple[Arm, Arm] | None:
    """The left and the right one of two other arms at a node, for somebody who comes from there."""
    arms = [
        arm(lines[other], other, end, width_px)
        for other, end in graph.ends_at(node)
        if other not in way.strands
    ]
    if len(arms) != 2:
        return None
    reach = min(len(walked) - 1, 8)
    ahead = unit(walked[reach] - walked[0])
    side = np.array([-ahead[1], ahead[0]])
    across = (arms[0].points[0] - arms[1].points[0]) @ side
    if abs(across) < 0.3 * width_px:
        return None
    return (arms[0], arms[1]) if across > 0 else (arms[1], arms[0])


def _may_touch(widths: list[FloatArray], arms: list[Arm], way: RibbonAxis) -> bool:
    """Whether a ribbon may be two strokes side by side, not one broad stroke between forks of others."""
    if min(map(len, widths)) < 6:
        return False
    each = [float(np.median(width)) for width in widths]
    ways = [way.points[0] - way.points[-1]] * 2 + [way.points[-1] - way.points[0]] * 2
    straight = all(
        angle(arm.at(0.0)[1], onward) < _ONWARD_RAD for arm, onward in zip(arms, ways, strict=True)
    )
    return max(each) < _ALIKE * min(each) and straight


def _secant(side: FloatArray, step: float, sigma: float) -> FloatArray:
    """How much longer a cut along the ribbon's normal through a half stroke is than one straight across."""
    from scipy.ndimage import gaussian_filter1d

    slope = gaussian_filter1d(side, max(sigma, 0.5), order=1, mode="nearest") / step
    return np.sqrt(1 + slope * slope)
