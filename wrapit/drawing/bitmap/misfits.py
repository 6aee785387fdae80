"""Where the traced lines, drawn again, are not the ink: what was misread can be told by that alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.geometry import BezierChain, FloatArray, IntArray

# In stroke widths, unless the name says otherwise.
# How far beside its edge may the ink end, or go on? A pen's edge is uneven, and so are stairs of pixels.
_SLACK = 0.12
_SLACK_PX = 0.5
# Over how much of a line is its width the median, and how often is it stamped? Steps of a quarter leave
# notches of a sixtieth.
_USUAL = 3.5
_STEP = 0.25
# How far does a mitre reach at most? That of 10 degrees reaches 5.7.
_MITRE = 6.0
# How many square widths are a misfit?
_LEAST = 0.04
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
    mask: NDArray[np.bool_], curves: Sequence[BezierChain], lines: Iterable[Line], width_px: float
) -> list[Misfit]:
    """Where ink (h, w) and curves differ by more than its edges are uneven, the largest first.

    Ink that touches no curve is none of them: dots, specks, what was left out.
    """
    points = np.concatenate([curve.sampled(_STEP * width_px) for curve in curves])
    half = _half_widths(points, lines, width_px)
    slack = _SLACK * width_px + _SLACK_PX
    covered = _stamped(mask.shape, points, half + slack)
    unexplained = np.argwhere(mask & ~covered)[:, ::-1]
    unexplained = unexplained[~_mitred(unexplained, curves, width_px / 2 + slack)]
    # A flat cap ends where its line does.
    inner = _off_free_ends(points, curves, width_px / 2)
    bare = np.argwhere(_stamped(mask.shape, points[inner], half[inner] - slack) & ~mask)[:, ::-1]
    found = [
        Misfit(group.mean(axis=0), len(group) / width_px**2, is_bare)
        for places, is_bare in ((unexplained, False), (bare, True))
        for group in _groups(places, _LEAST * width_px**2)
        if is_bare or _touches(group, covered & mask)
    ]
    return sorted(found, key=lambda misfit: (-misfit.area, *misfit.at))


def _half_widths(points: FloatArray, lines: Iterable[Line], width_px: float) -> FloatArray:
    """Half the usual width (n,) of the stroke nearest to each point."""
    from scipy.ndimage import median_filter
    from scipy.spatial import cKDTree

    places, widths = [], []
    for line in lines:
        known = line.clean & np.isfinite(line.width)
        if known.any():
            size = 2 * int(_USUAL * width_px * len(line.points) / max(line.length, 1.0)) + 1
            places.append(line.points[known])
            widths.append(median_filter(line.width[known], size, mode="reflect"))
    if not places:
        return np.full(len(points), width_px / 2)
    nearest = cKDTree(np.concatenate(places)).query(points)[1]
    return np.asarray(np.concatenate(widths)[nearest] / 2, dtype=np.float64)


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


def _ends(curves: Sequence[BezierChain]) -> tuple[FloatArray, FloatArray]:
    """The ends (n, 2) of curves, and the unit tangents (n, 2) from there."""
    places = [point for curve in curves for point in (curve.start, curve.end)]
    inwards = [tangent for curve in curves for tangent in (curve.start_tangent, -curve.end_tangent)]
    return np.array(places), np.array(inwards)


def _off_free_ends(points: FloatArray, curves: Sequence[BezierChain], reach: float) -> NDArray[np.bool_]:
    """Which points (n, 2) are farther than that from where a curve ends alone."""
    from scipy.spatial import cKDTree

    places, counts = np.unique(_ends(curves)[0], axis=0, return_counts=True)
    if not (counts == 1).any():
        return np.ones(len(points), dtype=np.bool_)
    return np.asarray(cKDTree(places[counts == 1]).query(points)[0] > reach)


def _mitred(places: IntArray, curves: Sequence[BezierChain], half: float) -> NDArray[np.bool_]:
    """Which places (n, 2) lie in the mitre of two curves' ends: between the outer edges of both, carried on."""
    mitred = np.zeros(len(places), dtype=np.bool_)
    if not len(places):
        return mitred
    at, inwards = _ends(curves)
    for point in np.unique(at, axis=0):
        ways = inwards[(at == point).all(axis=1)]
        from_point = places - point
        near = np.flatnonzero((from_point**2).sum(axis=1) < (2 * _MITRE * half) ** 2)
        across = np.abs(from_point[near, :1] * ways[:, 1] - from_point[near, 1:] * ways[:, 0]) < half
        behind = from_point[near] @ ways.T < 0
        mitred[near] |= (across & behind).sum(axis=1) > 1
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
