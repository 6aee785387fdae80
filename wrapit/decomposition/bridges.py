"""Bridges: short straight segments that may be added between junctions that nearly meet (paper, 4.4)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from wrapit.drawing.model import Drawing, Segment
from wrapit.geometry import FloatArray, straight

# How near two junctions are that "nearly meet", as a share of the mean segment. On 30 icons at 50 mm,
# 3 / 6 / 9 / 17 / 23 bridges are offered at 0.21 / 0.25 / 0.3 / 0.35 / 0.39: few enough to be told apart.
_REACH = 0.3


def with_bridges(drawing: Drawing) -> Drawing:
    """The drawing with every bridge that may be offered appended to its segments, shortest first.

    Offered are pairs of junctions nearer than 0.3 × the mean length of a segment that no segment
    joins and that neither a line of the drawing nor a shorter bridge separates.
    """
    strokes = [segment for segment in drawing.segments if segment.kind == "stroke"]
    reach_mm = _REACH * sum(segment.curve.length for segment in strokes) / len(strokes)
    points = np.array([junction.point for junction in drawing.junctions])
    # Fine enough that a chord leaves its curve by a small part of the shortest gap that matters.
    lines = [segment.curve.sampled(reach_mm / 20) for segment in drawing.segments]
    starts = np.concatenate([line[:-1] for line in lines])
    ends = np.concatenate([line[1:] for line in lines])
    added: list[Segment] = []
    for a, b in _near_pairs(drawing, points, reach_mm):
        if not _crosses(points[a], points[b], starts, ends):
            bridge = Segment(
                len(drawing.segments) + len(added), a, b, straight(points[a], points[b]), "bridge"
            )
            added.append(bridge)
            starts = np.concatenate([starts, points[a][None]])
            ends = np.concatenate([ends, points[b][None]])
    return replace(drawing, segments=(*drawing.segments, *added))


def _near_pairs(drawing: Drawing, points: FloatArray, reach_mm: float) -> list[tuple[int, int]]:
    """Pairs of used junctions within reach that no segment joins, nearest first."""
    used = sorted({junction for segment in drawing.segments for junction in (segment.start, segment.end)})
    joined = {frozenset((segment.start, segment.end)) for segment in drawing.segments}
    pairs = []
    for index, a in enumerate(used):
        others = np.array(used[index + 1 :], dtype=np.int64)
        distances = np.linalg.norm(points[others] - points[a], axis=1) if len(others) else np.empty(0)
        for where in np.flatnonzero((distances < reach_mm) & (distances > 0)):
            b = int(others[where])
            if frozenset((a, b)) not in joined:
                pairs.append((float(distances[where]), a, b))
    return [(a, b) for _, a, b in sorted(pairs)]


def _crosses(a: FloatArray, b: FloatArray, starts: FloatArray, ends: FloatArray) -> bool:
    """Whether the straight line a–b meets any of the straight pieces anywhere but at its own ends."""
    way = b - a
    near = np.all(
        (np.maximum(starts, ends) >= np.minimum(a, b)) & (np.minimum(starts, ends) <= np.maximum(a, b)),
        axis=1,
    )
    first, steps = starts[near], (ends - starts)[near]
    slope = way[0] * steps[:, 1] - way[1] * steps[:, 0]
    offset = first - a
    with np.errstate(divide="ignore", invalid="ignore"):
        along_way = (offset[:, 0] * steps[:, 1] - offset[:, 1] * steps[:, 0]) / slope
        along_step = (offset[:, 0] * way[1] - offset[:, 1] * way[0]) / slope
    inner = (along_way > 1e-6) & (along_way < 1 - 1e-6)
    return bool(np.any(inner & (along_step >= -1e-9) & (along_step <= 1 + 1e-9)))
