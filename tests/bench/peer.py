"""`autotrace -centerline` as the peer of our tracing: its strokes, made a graph, in pixels of the picture.

Autotrace gives strokes without a graph. To be fair to it, ends that come within half a stroke width of
one another or of another stroke are joined there, and strokes that cross are cut where they cross.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import shapely

Polyline = np.ndarray[Any, Any]


def autotraced(path: Path, stroke_px: float) -> tuple[dict[str, Any], int] | None:
    """The graph as the corpus writes it, and the number of Béziers; None without pyautotrace."""
    try:
        from autotrace import Bitmap  # type: ignore[import-not-found]
    except ImportError:
        return None
    from PIL import Image

    grey = np.asarray(Image.open(path).convert("L"))
    ink = np.where(grey < 128, 0, 255).astype(np.uint8)
    vector = Bitmap(np.repeat(ink[:, :, None], 3, axis=2)).trace(centerline=True)
    dark = [stroke for stroke in vector.paths if stroke.color.r < 128]
    strokes = [_sampled(stroke.splines, grey.shape[0]) for stroke in dark]
    return _graph([s for s in strokes if len(s) > 1], stroke_px / 2), sum(len(s.splines) for s in dark)


def _sampled(splines: Any, height_px: int) -> Polyline:
    """One stroke as points; autotrace counts rows from below."""
    t = np.linspace(0, 1, 12)[:, None]
    parts = []
    for spline in splines:
        p = np.array([(point.x, point.y) for point in spline.points])
        straight = spline.degree == 1
        curve = (
            (1 - t) * p[0] + t * p[3]
            if straight
            else (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]
        )
        parts.append(curve)
    points = np.concatenate(parts)
    points = np.column_stack([points[:, 0], height_px - 1 - points[:, 1]])
    return points[np.r_[True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-6]]


def _graph(strokes: list[Polyline], reach_px: float) -> dict[str, Any]:
    lines = [shapely.LineString(stroke) for stroke in strokes]
    ends = shapely.points(np.array([end for stroke in strokes for end in (stroke[0], stroke[-1])]))
    links, feet = [], [list[float]() for _ in lines]
    tree = shapely.STRtree(lines)
    for index, end in enumerate(ends):
        others = [k for k in tree.query(end, predicate="dwithin", distance=reach_px) if k != index // 2]
        if others:
            nearest = min(others, key=lambda k: (shapely.distance(end, lines[k]), k))
            feet[nearest].append(float(shapely.line_locate_point(lines[nearest], end)))
            foot = shapely.line_interpolate_point(lines[nearest], feet[nearest][-1])
            links.append(shapely.LineString([end, foot]))
    met = [_with_points(line, at) for line, at in zip(lines, feet, strict=True)]
    cut = shapely.node(shapely.multilinestrings([*met, *(link for link in links if link.length > 1e-9)]))
    edges = [np.asarray(part.coords) for part in shapely.get_parts(shapely.line_merge(cut))]
    places: dict[tuple[float, float], int] = {}
    rows = []
    for edge in edges:
        a, b = (places.setdefault((round(x, 4), round(y, 4)), len(places)) for x, y in (edge[0], edge[-1]))
        rows.append([a, b, edge.tolist()])
    return {"vertices": [list(place) for place in places], "edges": rows}


def _with_points(line: Any, at: list[float]) -> Any:
    """The line with vertices at these lengths along it, so that what ends there meets it exactly."""
    own = np.asarray(line.coords)
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(own, axis=0), axis=1))]
    feet = np.array([shapely.line_interpolate_point(line, s).coords[0] for s in at]).reshape(-1, 2)
    points = np.concatenate([own, feet])[np.argsort(np.r_[along, at], kind="stable")]
    return shapely.LineString(points[np.r_[True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 0]])
