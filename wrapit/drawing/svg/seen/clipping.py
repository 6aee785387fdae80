"""Leaves of curves what is seen: within the page, within viewports, within clip paths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Clip, Page, Shape
from wrapit.drawing.svg.seen.parting import Parts, parted
from wrapit.drawing.svg.seen.regions import Regions

# A line whose centre lies outside by up to this share of its width shows a quarter of it, and is a line.
SEEN_SHARE = 0.25
# In sizes of the page: what lies on its edge but for rounding.
_ROUNDING = 1e-7


class Seen:
    """What of curves is within the page and all clips."""

    def __init__(self, page: Page, regions: Regions) -> None:
        self._size = max(page.size)
        self._page = page.frame
        self._regions = regions
        self._widened: dict[tuple[tuple[int, ...], float], Any] = {}

    def parts(self, shape: Shape, curves: Sequence[Curve]) -> Parts:
        """Curves of a shape as far as they are seen, and what of them is not."""
        clips = (*shape.clips, *([self._page] if self._page else []))
        if not clips:
            return Parts(list(curves), [])
        region = self._region(clips, SEEN_SHARE * shape.stroke_width + _ROUNDING * self._size)
        found = [parted(curve, region) for curve in curves]
        return Parts(
            [curve for parts in found for curve in parts.within],
            [curve for parts in found for curve in parts.beyond],
        )

    def _region(self, clips: Sequence[Clip], margin: float) -> Any:
        import shapely

        key = tuple(map(id, clips)), margin
        if key not in self._widened:
            together = shapely.intersection_all([self._regions.clip(clip) for clip in clips])
            region = shapely.buffer(together, min(margin, self._size), join_style="mitre")
            shapely.prepare(region)
            self._widened[key] = region
        return self._widened[key]
