"""Leaves of curves what is seen: within the page, within viewports, within clip paths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.drawing.svg.cutting import stretches
from wrapit.drawing.svg.newton import local
from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Clip, Page, Shape
from wrapit.geometry import FloatArray

# Samples of each cubic. A curve that leaves what is seen for less than a 64th of a cubic is taken as inside,
# and the edge of a clip path errs by its bend in a 64th of a cubic: 1e-5 of a circle's radius.
_SAMPLES = 64
# Halvings that find where a curve leaves: a 64th of a cubic becomes a rounding error.
_HALVINGS = 40
# A line whose centre lies outside by up to this share of its width shows a quarter of it, and is a line.
_SEEN_SHARE = 0.25
# In sizes of the page: what lies on its edge but for rounding.
_ROUNDING = 1e-7

# A stretch that is not seen: its middle (2,), and its length in px.
Hidden = tuple[FloatArray, float]


class Seen:
    """What of curves is seen; remembers the regions of clips, which many shapes share."""

    def __init__(self, page: Page) -> None:
        self.hidden: list[Hidden] = []
        self._size = max(page.size)
        self._page = page.frame
        self._regions: dict[int, Any] = {}
        self._widened: dict[tuple[tuple[int, ...], float], Any] = {}

    def of(self, shape: Shape) -> list[Curve]:
        """The curves of a shape as far as they are seen."""
        clips = (*shape.clips, *([self._page] if self._page else []))
        found = list(shape.curves)
        if clips:
            region = self._region(clips, _SEEN_SHARE * shape.stroke_width + _ROUNDING * self._size)
            found = [part for curve in found for part in self._within(curve, region)]
        return found

    def _region(self, clips: Sequence[Clip], margin: float) -> Any:
        import shapely

        key = tuple(map(id, clips)), margin
        if key not in self._widened:
            together = shapely.intersection_all([self._clip(clip) for clip in clips])
            region = shapely.buffer(together, margin, join_style="mitre")
            shapely.prepare(region)
            self._widened[key] = region
        return self._widened[key]

    def _clip(self, clip: Clip) -> Any:
        import shapely

        if id(clip) not in self._regions:
            shapes = []
            for shape in clip.shapes:
                region = filled(shape)
                if shape.clips:
                    region = shapely.intersection_all([region, *map(self._clip, shape.clips)])
                shapes.append(region)
            self._regions[id(clip)] = shapely.union_all(shapes)
        return self._regions[id(clip)]

    def _within(self, curve: Curve, region: Any) -> list[Curve]:
        import shapely

        def inside(at: FloatArray) -> Any:
            return shapely.intersects_xy(region, *_points(curve.cubics, at).T)

        at = np.linspace(0.0, len(curve.cubics), _SAMPLES * len(curve.cubics) + 1)
        seen = inside(at)
        if seen.all():
            return [curve]
        changes = np.flatnonzero(seen[1:] != seen[:-1])
        low, high, first = at[changes], at[changes + 1], seen[changes]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            same = inside(middle) == first
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        marks = np.concatenate([[0.0], low, [float(len(curve.cubics))]])
        starts, ends = marks[:-1], marks[1:]
        shown = np.resize([bool(seen[0]), not seen[0]], len(starts))
        parts = stretches(curve.cubics, starts, ends)
        for part, is_shown in zip(parts, shown, strict=True):
            if part is not None and not is_shown:
                line = _points(part, np.linspace(0, len(part), _SAMPLES + 1))
                length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
                self.hidden.append((line[_SAMPLES // 2], length))
        kept = [part for part, is_shown in zip(parts, shown, strict=True) if part is not None and is_shown]
        if curve.closed and len(kept) > 1 and seen[0] and seen[-1]:
            # Where a closed curve begins is no end of what is seen of it.
            kept = [np.concatenate([kept[-1], kept[0]]), *kept[1:-1]]
        return [Curve(part, closed=False) for part in kept]


def filled(shape: Shape) -> Any:
    """What the fill of a shape covers, as a region of shapely, by its rule."""
    import shapely

    rings = []
    for curve in shape.curves:
        ring = _points(curve.cubics, np.linspace(0, len(curve.cubics), _SAMPLES * len(curve.cubics) + 1))
        rings.append(np.concatenate([ring, ring[:1]]))
    if not rings:
        return shapely.Polygon()
    lines = shapely.union_all([shapely.LineString(ring) for ring in rings])
    faces = list(shapely.get_parts(shapely.polygonize([lines])))
    covered = []
    for face in faces:
        winding = sum(_winding(face.representative_point(), ring) for ring in rings)
        if winding % 2 if shape.fill_rule == "evenodd" else winding:
            covered.append(face)
    return shapely.union_all(covered)


def _winding(point: Any, ring: FloatArray) -> int:
    """How often a closed polyline (n, 2) goes round a point."""
    x, y = (ring - [point.x, point.y]).T
    up = (y[:-1] <= 0) & (y[1:] > 0)
    down = (y[:-1] > 0) & (y[1:] <= 0)
    left = x[:-1] * y[1:] - x[1:] * y[:-1]
    return int((up & (left > 0)).sum()) - int((down & (left < 0)).sum())


def _points(cubics: FloatArray, at: FloatArray) -> FloatArray:
    """Points (n, 2) at parameters of a chain."""
    index = np.minimum(at.astype(np.int64), len(cubics) - 1)
    return local(cubics[index], at - index)[0]
