"""Leaves of curves what no later ink covers: white fills that hide, strokes that erase, dark shapes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Page, Shape
from wrapit.drawing.svg.seen.clipping import SEEN_SHARE
from wrapit.drawing.svg.seen.paper import alike, is_white, opaque, paper_of
from wrapit.drawing.svg.seen.parting import Parts, parted
from wrapit.drawing.svg.seen.regions import Regions, filled, stroked

# All in widths of the line. Under paper, stretches shorter than half a width don't show as a gap: caps beside
# it fill it. Under a dark shape the ink goes on; up to four widths, it is a knot or an arrowhead on the line.
_SHORTEST_GAP = 0.5
_LARGEST_KNOT = 4.0


@dataclass(frozen=True, eq=False)
class _Cover:
    """Opaque ink: which shape, its stroke or its fill, and whether in the colour of paper: a gap."""

    shape: int
    stroke: bool
    paper: bool


class Covers:
    """All opaque ink of a page that can hide what was painted before, in a tree over its boxes.

    Strokes that are lines themselves hide only what lies in them altogether: what crosses them is a crossing.
    """

    def __init__(self, page: Page, erasing: set[int], regions: Regions) -> None:
        self._page, self._regions = page, regions
        paper = paper_of(page)
        self._covers: list[_Cover] = []
        halos = _halos(page, erasing)
        for k, shape in enumerate(page.shapes):
            if shape.mask:
                continue
            if opaque(shape.fill) and shape.fill and shape.curves:
                white = is_white(shape.fill.colour) or alike(shape.fill.colour, paper)
                self._covers.append(_Cover(k, False, white))
            if opaque(shape.stroke) and shape.curves and not shape.dashes and k not in halos:
                self._covers.append(_Cover(k, True, k in erasing))
        self._known: dict[int, Any] = {}
        self._tree = self._planted()

    def parts(self, number: int, curves: list[Curve]) -> Parts:
        """What is seen (within) and covered (beyond) of curves of the shape with that number."""
        shape = self._page.shapes[number]
        seen, hidden = [], []
        for curve in curves:
            over = [cover for cover in self._over(curve) if cover.shape > number]
            left = [curve]
            for some, least in (
                ([c for c in over if c.paper], _SHORTEST_GAP),
                ([c for c in over if not c.paper and not c.stroke], _LARGEST_KNOT),
                ([c for c in over if c.stroke and not c.paper and self._differs(c, shape)], np.inf),
            ):
                if not some or not left:
                    continue
                region = self._region(some, shape.stroke_width)
                found = [parted(part, region, least * shape.stroke_width) for part in left]
                hidden += [part for parts in found for part in parts.within]
                left = [part for parts in found for part in parts.beyond]
            seen += left
        return Parts(seen, hidden)

    def _differs(self, cover: _Cover, shape: Shape) -> bool:
        """Whether a line's ink can be told from that of a broader stroke over it."""
        over = self._page.shapes[cover.shape]
        one, other = over.stroke, shape.stroke
        broader = over.stroke_width > shape.stroke_width
        return bool(broader and one and other and not alike(one.colour, other.colour))

    def _planted(self) -> Any:
        from shapely import STRtree, box

        low, high = [], []
        for cover in self._covers:
            shape = self._page.shapes[cover.shape]
            margin = shape.stroke_width if cover.stroke else 0.0
            points = np.concatenate([curve.cubics.reshape(-1, 2) for curve in shape.curves])
            low.append(points.min(axis=0) - margin)
            high.append(points.max(axis=0) + margin)
        if not low:
            return None
        return STRtree(box(*np.array(low).T, *np.array(high).T))

    def _over(self, curve: Curve) -> list[_Cover]:
        """The covers whose boxes meet that of a curve, in the order of painting."""
        from shapely import box

        if self._tree is None:
            return []
        points = curve.cubics.reshape(-1, 2)
        found = self._tree.query(box(*points.min(axis=0), *points.max(axis=0)))
        return [self._covers[k] for k in sorted(found.tolist())]

    def _region(self, covers: list[_Cover], width: float) -> Any:
        """What covers hide of a line: all of it that doesn't show a quarter of its width beside them."""
        import shapely

        together = shapely.union_all([self._of(cover) for cover in covers])
        region = shapely.buffer(together, -SEEN_SHARE * width, join_style="mitre")
        shapely.prepare(region)
        return region

    def _of(self, cover: _Cover) -> Any:
        if id(cover) not in self._known:
            shape = self._page.shapes[cover.shape]
            region = stroked(shape) if cover.stroke else filled(shape)
            self._known[id(cover)] = self._regions.clipped(region, shape)
        return self._known[id(cover)]


def _halos(page: Page, erasing: set[int]) -> set[int]:
    """Erasing strokes that hide nothing but beside a line of the same course: knots show so what runs above.

    What runs below is a crossing then, and no gap. Above a broader line they are its light core.
    """
    courses: dict[bytes, list[int]] = {}
    for k, shape in enumerate(page.shapes):
        if k not in erasing and shape.stroke and shape.curves:
            courses.setdefault(_start(shape), []).append(k)
    found = set()
    for k in erasing:
        shape = page.shapes[k]
        for other in courses.get(_start(shape), []):
            line = page.shapes[other]
            broader = shape.stroke_width > line.stroke_width
            if broader == (other > k) and _same(shape, line):
                found.add(k)
    return found


def _start(shape: Shape) -> bytes:
    """Where a shape begins, to the last bit: copies of one course agree in it."""
    return shape.curves[0].cubics[0, 0].tobytes()


def _same(one: Shape, other: Shape) -> bool:
    return len(one.curves) == len(other.curves) and all(
        np.array_equal(a.cubics, b.cubics) for a, b in zip(one.curves, other.curves, strict=True)
    )
