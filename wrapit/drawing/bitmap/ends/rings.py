"""Small rings at the end of a stroke, as of a key or an ear-ring: read from the paper inside.

A ring hardly larger than its stroke is broad has no clean arm beside the joint, and a skeleton that is drawn
out towards the stem. Its hole is whole all the same: half a width outside of the hole's edge runs the ring.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.arms import arm
from wrapit.drawing.bitmap.centre_lines import Line, sample
from wrapit.drawing.bitmap.endings import Ending
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polyline import lengths

# In stroke widths.
# Which rings are small? Larger holes leave clean arms on either side of the joint.
_HOLE = 1.8
# How much farther than its hole may the ring's own skeleton run? It is drawn out towards the stem.
_SKELETON = 3.0
# What is round? The hole's radius changes around it as three waves do, but for this much and the noise of
# pixels: the hole of a loop that crosses itself has a corner, which misses by 0.03 and more.
_WAVES = 3
_ROUND = 0.02
_ROUND_PX = 0.25
_RAYS = 96
# Is the stem as broad as the ring? Unless they differ by more than a quarter.
_LIKE = 0.25

Ends = dict[tuple[int, int], Ending]
Rings = dict[int, tuple[FloatArray, Ends]]


def ring_joints(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> Rings:
    """Where each small ring hangs at its stem, by node, and how both leave; the ring's line is renewed."""
    found = {}
    for node in graph.nodes:
        ends = graph.ends_at(node)
        loops = {strand for strand, _ in ends if graph.strands[strand].start == graph.strands[strand].end}
        if len(ends) != 3 or len(loops) != 1:
            continue
        (loop,) = loops
        ((stem, end),) = [(s, e) for s, e in ends if s != loop]
        ring = _ring(lines[loop], _broad(lines[stem], width_px), ink, width_px)
        if ring is None:
            continue
        towards = arm(lines[stem], stem, end, width_px)
        start, outward = towards.at(0.0)
        at = _joint(ring, start, -outward)
        ring = np.roll(ring, -at, axis=0)
        if _winds(ring) * _winds(lines[loop].points) < 0:
            ring = np.vstack([ring[:1], ring[:0:-1]])
        closed = np.vstack([ring, ring[:1]])
        along = unit(ring[1] - ring[-1])
        lines[loop] = Line(
            closed, np.full(len(closed), width_px), np.ones(len(closed), dtype=bool), lengths(closed)
        )
        none = np.zeros((0, 2))
        found[node] = (
            ring[0],
            {
                (loop, 0): Ending(along, none, 1),
                (loop, 1): Ending(-along, none, 1),
                (stem, end): Ending(unit(start - ring[0]), none, towards.cut),
            },
        )
    return found


def _broad(line: Line, width_px: float) -> float:
    return float(np.median(line.width[line.clean])) if line.clean.any() else width_px


def _ring(line: Line, stem_px: float, ink: Ink, width_px: float) -> FloatArray | None:
    """The ring (n, 2) around a small round hole inside a closed line, or nothing where there is no such."""
    if line.length > 2 * np.pi * (_HOLE + 0.5 + _SKELETON / np.pi) * width_px:
        return None
    angles = np.linspace(0, 2 * np.pi, _RAYS, endpoint=False)
    rays = np.column_stack([np.cos(angles), np.sin(angles)])
    steps = np.arange(0.0, (_HOLE + 2) * width_px, 0.25)
    centre = _paper_inside(line, ink)
    if centre is None:
        return None
    for _ in range(3):
        dark = sample(ink, np.broadcast_to(centre, rays.shape), rays, steps) <= ink.half
        hole = _first(dark, steps)
        if not np.isfinite(hole).all() or hole.max() > _HOLE * width_px:
            return None
        centre = centre + 2 * (hole[:, None] * rays).mean(axis=0)
    levels = sample(ink, np.broadcast_to(centre, rays.shape), rays, steps) - ink.half
    hole = _crossed(levels, levels <= 0, steps)
    outside = _crossed(levels, (levels > 0) & (steps > hole[:, None]), steps)
    broad = float(np.nanmedian(outside - hole))
    waves = np.column_stack(
        [np.ones(_RAYS), *(f(k * angles) for k in range(1, _WAVES + 1) for f in (np.cos, np.sin))]
    )
    smooth = waves @ np.linalg.lstsq(waves, hole, rcond=None)[0]
    if float(np.sqrt(((smooth - hole) ** 2).mean())) > _ROUND * width_px + _ROUND_PX:
        return None
    edge = centre + smooth[:, None] * rays
    ahead = unit(np.roll(edge, -1, axis=0) - np.roll(edge, 1, axis=0))
    # The edge of a hole of few pixels is less well known than the ring's outer edge and the stem's width.
    if abs(stem_px - broad) < _LIKE * broad:
        broad = 2 * broad - stem_px
    return edge + broad / 2 * np.column_stack([ahead[:, 1], -ahead[:, 0]])


def _paper_inside(line: Line, ink: Ink) -> FloatArray | None:
    """The middle of the paper that a closed line surrounds."""
    from skimage.draw import polygon2mask

    low = np.floor(line.points.min(axis=0)).astype(int)
    high = np.ceil(line.points.max(axis=0)).astype(int) + 1
    row, column = np.nonzero(polygon2mask((high - low)[::-1], (line.points - low)[:, ::-1]))  # type: ignore[no-untyped-call]
    paper = ~ink.mask[row + low[1], column + low[0]]
    row, column = row[paper], column[paper]
    return np.array([column.mean(), row.mean()]) + low if len(row) else None


def _first(where: NDArray[np.bool_], steps: FloatArray) -> FloatArray:
    at = np.argmax(where, axis=1)
    return np.where(where[np.arange(len(where)), at], steps[at], np.nan)


def _crossed(
    levels: NDArray[np.float32], where: np.typing.NDArray[np.bool_], steps: FloatArray
) -> FloatArray:
    """How far along each ray the level crosses zero, at the first sample that is meant; nan where none is."""
    rows, at = np.arange(len(levels)), np.argmax(where, axis=1)
    before, after = levels[rows, np.maximum(at - 1, 0)], levels[rows, at]
    share = np.divide(before, before - after, out=np.ones_like(before), where=before != after)
    return np.where(where[rows, at], steps[np.maximum(at - 1, 0)] + share * steps[1], np.nan)


def _joint(ring: FloatArray, start: FloatArray, ahead: FloatArray) -> int:
    """The point of a ring where a stroke arrives: on the near side, where its line goes on to."""
    offset = ring - start
    before, aside = offset @ ahead, np.abs(offset @ np.array([-ahead[1], ahead[0]]))
    return int(np.argmin(aside + 0.2 * before))


def _winds(points: FloatArray) -> float:
    x, y = points.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
