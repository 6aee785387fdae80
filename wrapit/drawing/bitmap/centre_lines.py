"""Centre lines finer than a pixel: the middle between both edges of the stroke, and its width there."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, IntArray, unit
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import at_lengths, lengths

# In stroke widths, unless the name says otherwise.
# Where is the edge of the ink looked for? Not right at the centre, which is ink by the second pass, and not
# beyond 1.3 widths, where there is another stroke; either moved by 30 % changes the mean distance by 0.0001.
_INSIDE = 0.25
_REACH = 1.3
# How much are the skeleton's stairs smoothed before its normals are taken? Too little (0.25) or too much
# (0.45) raises the Hausdorff distance from 0.12 to 0.16 widths.
_SMOOTHING = 0.35
# When is a point clean? Where the ink is no broader than usual by more than this, or a third of a pixel,
# which a hard edge is off by chance. 0.063 throws clean points away: Hausdorff distance 0.16 instead of 0.12.
_CLEAN = 0.09
_CLEAN_PX = 0.35
# What is usual along a line? A pen's pressure may change the width by this share; the median within 3.5
# widths is wide enough to overlook a crossing. A share of 0.12 raises the Hausdorff distance to 0.14, 0.22
# changes nothing; a reach of 4.6 raises it to 0.15.
_DRIFT = 0.17
_DRIFT_REACH = 3.5
# Of how many points are the edges looked for at once? Both sides of so many fit a processor's cache: it takes
# 0.7 times as long as each side of all points, and the memory that a large picture takes doesn't grow.
_AT_ONCE = 512
# When is a second look worth its call? Edges mostly lie in the nearer half, so the farther one is looked at
# only where there is none. For fewer places than this both halves at once are as fast.
_WORTH_PARTING = 1000


@dataclass(frozen=True, eq=False)
class Line:
    """The centre line of a strand: points (n, 2) in pixels, stroke width at each, and where it stands alone.

    `clean` is false where another stroke, or an end, disturbs the width; there the centre is unknown. `arms`
    remembers those that `arms.arm` found at its ends, as several steps ask for them.
    """

    points: FloatArray
    width: FloatArray
    clean: NDArray[np.bool_]
    along: FloatArray
    arms: dict[tuple[int, int, float, bool], Any] = field(default_factory=dict, repr=False)

    @property
    def length(self) -> float:
        """Length in pixels."""
        return float(self.along[-1])

    @cached_property
    def box(self) -> tuple[FloatArray, FloatArray]:
        """Lowest and highest x and y, (2,) each."""
        return self.points.min(axis=0), self.points.max(axis=0)

    def turned(self, first: int) -> Line:
        """A closed line that starts (and ends) at another of its points."""
        order = np.concatenate([np.arange(first, len(self.points) - 1), np.arange(first + 1)])
        points = self.points[order]
        return Line(points, self.width[order], self.clean[order], lengths(points))


def renewed(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> dict[int, Line]:
    """The lines of a graph that has changed: those of strands that are new are found now."""
    fresh = [strand for strand in graph.strands if strand not in lines]
    kept = {strand: line for strand, line in lines.items() if strand in graph.strands}
    return kept | centre_lines(graph, ink, width_px, fresh)


def centre_lines(
    graph: StrandGraph, ink: Ink, width_px: float, strands: list[int] | None = None
) -> dict[int, Line]:
    """The centre line of each strand, walking from its start; closed loops lose nothing at the seam."""
    strands = list(graph.strands) if strands is None else strands
    if not strands:
        return {}
    step = max(1.0, width_px / 8)
    paths = [_resampled(graph.path(strand), step) for strand in strands]
    loops = [
        graph.strands[s].start == graph.strands[s].end and graph.degree(graph.strands[s].start) == 2
        for s in strands
    ]
    sigma = max(_SMOOTHING * width_px, 1.0) / step
    # The first pass only has to come near enough for the second.
    for fineness, inside in ((8, 0.0), (14, _INSIDE)):
        paths = [smoothed(path, sigma, loop) for path, loop in zip(paths, loops, strict=True)]
        points = np.concatenate(paths)
        stops = np.cumsum([len(path) for path in paths])
        bounds, normals = stops[:-1], _normals(points, stops, np.array(loops)[:, None])
        left, right = edges(
            ink, points, normals, _REACH * width_px, max(0.5, width_px / fineness), inside=inside * width_px
        )
        width = left + right
        shift = np.where(width < 1.8 * width_px, (right - left) / 2, 0.0)
        points = points + np.nan_to_num(shift)[:, None] * normals
        paths = np.split(points, bounds)
    known = width[np.isfinite(width)]
    spread = median(np.abs(known - median(known))) if len(known) else 0.0
    return {
        strand: _line(path, width, width_px, min(spread, 0.1 * width_px))
        for strand, path, width in zip(strands, paths, np.split(width, bounds), strict=True)
    }


def _line(points: FloatArray, width: FloatArray, width_px: float, spread: float) -> Line:
    known = width[np.isfinite(width)]
    usual = median(known) if len(known) > 24 else width_px
    usual = float(np.clip(usual, 0.85 * width_px, 1.15 * width_px))
    # Another stroke only widens: thinner places are the hand's, and as good as others.
    slack = max(_CLEAN * width_px, _CLEAN_PX, 1.5 * spread)
    along = lengths(points)
    near = _running_median(width, along, width_px)
    nearby = np.clip(near, (1 - _DRIFT) * usual, (1 + _DRIFT) * usual)
    clean = (width - nearby <= slack) & (width >= 0.6 * nearby)
    return Line(points, width, clean, along)


def _running_median(width: FloatArray, along: FloatArray, width_px: float) -> FloatArray:
    """The width around each point, as a pen's pressure changes it; wide enough to overlook a crossing."""
    from scipy.ndimage import median_filter

    step = max(float(along[-1]) / (len(along) - 1), 1e-6)
    size = 2 * round(_DRIFT_REACH * width_px / step) + 1
    seen = np.where(np.isnan(width), 2 * width_px, width)
    if size >= len(width):
        return np.full(len(width), median(seen))
    return median_filter(seen, size, mode="reflect")


def _resampled(path: FloatArray, step: float) -> FloatArray:
    along = lengths(path)
    count = max(3, int(np.ceil(along[-1] / step)) + 1)
    return at_lengths(path, along, np.linspace(0, along[-1], count))


def smoothed(path: FloatArray, sigma: float, loop: bool) -> FloatArray:
    """Gaussian smoothing that keeps the ends (a loop has none)."""
    reach = int(np.ceil(3 * sigma))
    if loop:
        ring = path[:-1]
        around = np.arange(-reach, len(ring) + reach) % len(ring)
        padded = ring[around]
    else:
        reach = min(reach, len(path) - 1)
        padded = np.concatenate(
            [2 * path[0] - path[reach:0:-1], path, 2 * path[-1] - path[-2 : -reach - 2 : -1]]
        )
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    smooth = np.empty((len(padded) - 2 * reach, 2))
    for k in (0, 1):
        smooth[:, k] = np.convolve(padded[:, k], kernel, mode="valid")
    return np.vstack([smooth, smooth[:1]]) if loop else smooth


def _normals(points: FloatArray, stops: IntArray, loops: NDArray[np.bool_]) -> FloatArray:
    """The unit normals of lines whose points (n, 2) end before `stops` (m,); some are `loops` (m, 1)."""
    first, last = np.concatenate([[0], stops[:-1]]), stops - 1
    second, next_to_last = points[first + 1], points[last - 1]
    course = np.empty_like(points)
    course[1:-1] = points[2:] - points[:-2]
    course[first] = second - np.where(loops, next_to_last, 2 * points[first] - second)
    course[last] = np.where(loops, second, 2 * points[last] - next_to_last) - next_to_last
    tangent = unit(course)
    normals = np.empty_like(tangent)
    np.negative(tangent[:, 1], out=normals[:, 0])
    normals[:, 1] = tangent[:, 0]
    return normals


def edges(
    ink: Ink,
    points: FloatArray,
    normals: FloatArray,
    reach: float,
    step: float,
    inside: float = 0.0,
    bridged: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """Distance to the edge of the ink against and along the normal; nan where there is none in reach.

    The search starts at `inside`; paper narrower than `bridged` counts as ink.
    """
    offsets = np.arange(inside, reach + step, step)
    found = np.empty((2, len(points)))
    for first in range(0, len(points), _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        origins = np.concatenate([points[part]] * 2)
        directions = np.concatenate([-normals[part], normals[part]])
        if bridged:
            levels = _closed(sample(ink, origins, directions, offsets) - ink.half, int(bridged / step))
            found[:, part] = _first_crossing(levels, step).reshape(2, -1)
        else:
            found[:, part] = _first_edge(ink, origins, directions, offsets, step).reshape(2, -1)
    found += inside
    return found[0], found[1]


def _first_edge(
    ink: Ink, origins: FloatArray, directions: FloatArray, offsets: FloatArray, step: float
) -> FloatArray:
    """How far one walks from the first offset until the ink ends; nan where it doesn't, or isn't there."""
    near = len(offsets) // 2 + 1
    if len(origins) * (len(offsets) - near) < _WORTH_PARTING:
        levels = sample(ink, origins, directions, offsets)
        levels -= ink.half
        return _first_crossing(levels, step)
    levels = sample(ink, origins, directions, offsets[:near])
    levels -= ink.half
    found = _first_crossing(levels, step)
    on = np.flatnonzero(~(levels > 0).any(axis=1))
    if len(on):
        levels = sample(ink, origins[on], directions[on], offsets[near - 1 :])
        levels -= ink.half
        found[on] = _first_crossing(levels, step, near - 1)
    return found


def _closed(levels: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """Levels where runs of paper are filled: those up to `count` long, and any at the start."""
    from scipy.ndimage import grey_opening

    opened = grey_opening(levels, size=(1, count + 1), mode="nearest")
    return np.where(np.logical_or.accumulate(opened <= 0, axis=1), opened, -1.0).astype(np.float32)


def _first_crossing(levels: NDArray[np.float32], step: float, walked: int = 0) -> FloatArray:
    """How far one walks until the level rises through zero; `walked` steps lie before the first column."""
    at = (levels > 0).argmax(axis=1)
    # Places in one row are found in a third of the time that pairs of them take.
    flat = levels.ravel()
    place = np.arange(0, flat.size, levels.shape[1])
    place += at
    after = flat.take(place)
    rows = ((at > 0) & (after > 0)).nonzero()[0]
    found = np.full(len(levels), np.nan)
    last, before, after = at.take(rows) - 1, flat.take(place.take(rows) - 1), after.take(rows)
    found[rows] = (last + walked + before / (before - after)) * step
    return found


def sample(ink: Ink, points: FloatArray, directions: FloatArray, offsets: FloatArray) -> NDArray[np.float32]:
    """Bilinear grey levels (n, k) at offsets from points (n, 2); outside the picture all is paper."""
    grey = ink.framed
    height, width = grey.shape
    # Both coordinates (2, n, k) at once, as there are many calls for few points.
    at = np.empty((2, len(points), len(offsets)))
    np.multiply(offsets, directions.T[..., None], out=at)
    at += points.T[..., None]
    np.maximum(at, -1.0, out=at)
    # Not .001 from the frame: at 10,000 px single precision tells .001 apart.
    np.minimum(at, np.array([width - 2.01, height - 2.01])[:, None, None], out=at)
    within = at.astype(np.float32)
    pixel = np.floor(within)
    within -= pixel
    x, y = within
    # Places are looked up four times, each of which would widen smaller numbers anew.
    column, place = pixel.astype(np.intp)
    place *= width
    place += column
    place += width + 1  # beside and below the frame
    flat = grey.ravel()
    a, b, c, d = (flat[step:].take(place).astype(np.float32) for step in (0, 1, width, width + 1))
    b -= a
    b *= x
    b += a
    d -= c
    d *= x
    d += c
    d -= b
    d *= y
    d += b
    return d
