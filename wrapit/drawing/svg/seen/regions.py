"""What fills and strokes cover, as regions of shapely."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.drawing.svg.reading.model import Clip, Shape
from wrapit.drawing.svg.seen.parting import points, samples
from wrapit.geometry import FloatArray

# How caps and joins are called in shapely.
_CAPS = {"butt": "flat", "round": "round", "square": "square"}
_JOINS = {"round": "round", "bevel": "bevel"}


class Regions:
    """The regions of shapes and clips within their own clips; those of clips, which many share, are kept."""

    def __init__(self) -> None:
        self._clips: dict[int, Any] = {}

    def clip(self, clip: Clip) -> Any:
        """What is seen through a clip."""
        import shapely

        if id(clip) not in self._clips:
            self._clips[id(clip)] = shapely.union_all(
                [self.clipped(filled(shape), shape) for shape in clip.shapes]
            )
        return self._clips[id(clip)]

    def clipped(self, region: Any, shape: Shape) -> Any:
        """What a shape's clips leave of a region."""
        import shapely

        return shapely.intersection_all([region, *map(self.clip, shape.clips)]) if shape.clips else region


def filled(shape: Shape) -> Any:
    """What the fill of a shape covers, by its rule."""
    import shapely

    rings = []
    for curve in shape.curves:
        ring = points(curve.cubics, samples(curve))
        rings.append(np.concatenate([ring, ring[:1]]))
    if not rings:
        return shapely.Polygon()
    if len(rings) == 1 and (simple := shapely.Polygon(rings[0])).is_valid:
        return simple
    lines = shapely.union_all([shapely.LineString(ring) for ring in rings])
    faces = list(shapely.get_parts(shapely.polygonize([lines])))
    covered = []
    for face in faces:
        winding = sum(_winding(face.representative_point(), ring) for ring in rings)
        if winding % 2 if shape.fill_rule == "evenodd" else winding:
            covered.append(face)
    return shapely.union_all(covered)


def stroked(shape: Shape) -> Any:
    """What the stroke of a shape covers, dashes or not."""
    import shapely

    lines = [shapely.LineString(points(curve.cubics, samples(curve))) for curve in shape.curves]
    return shapely.union_all(
        shapely.buffer(
            lines,
            shape.stroke_width / 2,
            cap_style=_CAPS.get(shape.cap, "flat"),
            join_style=_JOINS.get(shape.join, "mitre"),
        )
    )


def _winding(point: Any, ring: FloatArray) -> int:
    """How often a closed polyline (n, 2) goes round a point."""
    x, y = (ring - [point.x, point.y]).T
    up = (y[:-1] <= 0) & (y[1:] > 0)
    down = (y[:-1] > 0) & (y[1:] <= 0)
    left = x[:-1] * y[1:] - x[1:] * y[:-1]
    return int((up & (left > 0)).sum()) - int((down & (left < 0)).sum())
