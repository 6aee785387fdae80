"""Where the traced lines, drawn again, are not the ink: what was misread can be told by that alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.mending.ink_edges import half_widths, near
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import BezierChain, FloatArray, IntArray

# In stroke widths, unless the name says otherwise.
# How far beside its edge may the ink end, or go on? A pen's edge is uneven, and so are stairs of pixels.
_SLACK = 0.12
_SLACK_PX = 0.5
# How often is a line stamped? Steps of 0.4 leave notches of 0.03.
_STEP = 0.4
# How far does a mitre reach at most? That of 10 degrees reaches 5.7.
_MITRE = 6.0
# When was something misread? Where so many square widths differ in one place. Of 804 icons that is told of 33
# of about 180 that are read otherwise than drawn, and of one of the others (a tip that is half a width off).
_MISREAD = 0.15
# How near to a line is what was misread there? And to a gap that was closed, which is told already?
_NEAR = 2.0
# How many are named each by its place?
_NAMED = 8
# How many pixels apart is one misfit still one?
_APART_PX = 2.0
# How many places are stamped at once? It bounds the memory that a large picture takes.
_AT_ONCE = 4096


@dataclass(frozen=True, eq=False)
class Misfit:
    """Ink that no line explains, or, where it is `bare`, a line without ink: the middle (2,) of it in pixels.

    `area` is in squared stroke widths.
    """

    at: FloatArray
    area: float
    bare: bool


def misfits(
    mask: NDArray[np.bool_], curves: Mapping[int, BezierChain], lines: Mapping[int, Line], width_px: float
) -> list[Misfit]:
    """Where ink (h, w) and the curves of strands differ by far more than edges are uneven, the largest first.

    Ink that touches no curve is none of them: dots, specks, what was left out.
    """
    drawn = {strand: curve.sampled(_STEP * width_px) for strand, curve in curves.items()}
    points = np.concatenate([*drawn.values()])
    half = np.concatenate([half_widths(lines[k], len(along), width_px) for k, along in drawn.items()])
    ends = _ends(curves.values())
    slack = _SLACK * width_px + _SLACK_PX
    covered = _stamped(mask.shape, points, half + slack)
    unexplained = _where(mask & ~covered)
    unexplained = unexplained[near(unexplained, points, _NEAR * width_px)]
    unexplained = unexplained[~_mitred(unexplained, ends, width_px / 2 + slack)]
    # A flat cap ends where its line does.
    inner = ~near(points, _free(ends), width_px / 2)
    bare = _where(_stamped(mask.shape, points[inner], half[inner] - slack) & ~mask)
    covered &= mask
    found = [
        Misfit(group.mean(axis=0), len(group) / width_px**2, is_bare)
        for places, is_bare in ((unexplained, False), (bare, True))
        for group in _groups(places, _MISREAD * width_px**2)
        if is_bare or _touches(group, covered)
    ]
    return sorted(found, key=lambda misfit: (-misfit.area, *misfit.at))


def tell_misread(graph: StrandGraph, found: list[Misfit], kept: list[BezierChain], width_px: float) -> None:
    """Names the places where the lines that are kept were misread, the worst first."""
    if not found:
        return
    at, reach = np.array([misfit.at for misfit in found]), _NEAR * width_px
    told = near(at, np.concatenate([curve.sampled(width_px) for curve in kept]), reach)
    closed = [notice.at_px for notice in graph.notices if notice.code == "gap-closed"]
    if closed:
        told &= ~(near(at, np.array(closed), reach) & [misfit.bare for misfit in found])
    found = [misfit for misfit, tells in zip(found, told, strict=True) if tells]
    remedy = "compare it with the preview; draw it larger, or with a thinner pen, so that lines keep apart"
    for misfit in found[:_NAMED]:
        what = "a line was read without ink" if misfit.bare else "ink is left over that is no line's"
        across = f"{math.sqrt(misfit.area):.1f} stroke widths across"
        graph.tell("warning", "misread", misfit.at, f"something was misread: {what}, {across}", remedy)
    if len(found) > _NAMED:
        rest = f"something was misread at {len(found) - _NAMED} more places"
        graph.tell("warning", "misread", found[_NAMED].at, rest, remedy)


def _where(mask: NDArray[np.bool_]) -> IntArray:
    """The places (n, 2), x and y, of a mask (h, w)."""
    return np.column_stack(np.divmod(np.flatnonzero(mask), mask.shape[1])[::-1])


def _stamped(shape: tuple[int, ...], points: FloatArray, radii: FloatArray) -> NDArray[np.bool_]:
    """The pixels (h, w) within a radius (n,) of points (n, 2)."""
    stamped = np.zeros(shape, dtype=np.bool_)
    high = np.array(shape[::-1]) - 1
    rounded = np.maximum(np.rint(radii * 2) / 2, 0.0)
    for radius in np.unique(rounded):
        reach = int(radius)
        disc = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1)] * 2), axis=-1).reshape(-1, 2)
        disc = disc[(disc**2).sum(axis=1) <= radius**2]
        centres = np.rint(points[rounded == radius]).astype(np.intp)
        for first in range(0, len(centres), _AT_ONCE):
            x, y = (centres[first : first + _AT_ONCE, None] + disc).reshape(-1, 2).T
            within = (x >= 0) & (x <= high[0]) & (y >= 0) & (y <= high[1])
            stamped[y[within], x[within]] = True
    return stamped


def _ends(curves: Iterable[BezierChain]) -> tuple[FloatArray, FloatArray]:
    """The ends (n, 2) of curves, and the unit tangents (n, 2) from there."""
    ends = [
        end
        for curve in curves
        for end in ((curve.start, curve.start_tangent), (curve.end, -curve.end_tangent))
    ]
    return np.array([place for place, _ in ends]), np.array([inwards for _, inwards in ends])


def _free(ends: tuple[FloatArray, FloatArray]) -> FloatArray:
    """Those ends (n, 2) at which no other curve ends."""
    places, counts = np.unique(ends[0], axis=0, return_counts=True)
    return np.asarray(places[counts == 1])


def _mitred(places: IntArray, ends: tuple[FloatArray, FloatArray], half: float) -> NDArray[np.bool_]:
    """Which places (n, 2) lie in a mitre: between the outer edges of two curves' ends, carried on."""
    mitred = np.zeros(len(places), dtype=np.bool_)
    if not len(places):
        return mitred
    at, inwards = ends
    for point in np.unique(at, axis=0):
        from_point = places - point
        near = np.flatnonzero((from_point**2).sum(axis=1) < (2 * _MITRE * half) ** 2)
        if len(near):
            ways = inwards[(at == point).all(axis=1)]
            across = from_point[near, :1] * ways[:, 1] - from_point[near, 1:] * ways[:, 0]
            within = (np.abs(across) < half) & (from_point[near] @ ways.T < 0)
            mitred[near] |= within.sum(axis=1) > 1
    return mitred


def _groups(places: IntArray, least: float) -> list[IntArray]:
    """Places (n, 2) that lie together, `least` of them or more."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    if len(places) < least:
        return []
    pairs = cKDTree(places).query_pairs(_APART_PX, output_type="ndarray")
    links = coo_array((np.ones(len(pairs), dtype=np.bool_), tuple(pairs.T)), shape=(len(places),) * 2)
    label = connected_components(links, directed=False)[1]
    order = np.argsort(label, kind="stable")
    groups = np.split(places[order], np.cumsum(np.bincount(label))[:-1])
    return [group for group in groups if len(group) >= least]


def _touches(group: IntArray, drawn: NDArray[np.bool_]) -> bool:
    """Whether there is a drawn pixel right beside some of a group (n, 2)."""
    beside = group[:, None] + np.array([(-1, 0), (1, 0), (0, -1), (0, 1)])
    x, y = np.clip(beside, 0, np.array(drawn.shape[::-1]) - 1).reshape(-1, 2).T
    return bool(drawn[y, x].any())
