"""Where parts and openings of a sheet are narrow, measured as they are when the laser has taken its kerf."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from wrapit.geometry import Loop
from wrapit.jig.contours import Contour
from wrapit.jig.sheet.model import LaserSheet

if TYPE_CHECKING:
    from shapely import Polygon
    from shapely.geometry.base import BaseGeometry

# How far chords may leave a curve: a width measures at most twice as much too small.
_FLAT_MM = 5e-4
# A bulge behind a neck is one if it is wider by this.
_STAIR_MM = 0.1
# Widths are told in hundredths.
_WIDTH_STEP_MM = 0.005
# What chords (1e-3 mm) and crumbs (1.2e-3 mm) may take of a width that is just wide enough.
_SLACK_MM = 3e-3
# Crumbs of an erosion are not pieces; a round hole measures narrower by twice the radius of one, 1.2e-3 mm.
_CRUMB_MM2 = 1e-6


@dataclass(frozen=True)
class Narrow:
    """A place of the sheet that is narrow, and the label of its part."""

    label: str
    width_mm: float
    at: tuple[float, float]


def small_holes(sheet: LaserSheet, least_mm: float, kerf_mm: float) -> Iterator[Narrow]:
    """Openings that are somewhere narrower than `least_mm`, one place each."""
    for placed in sheet.placed:
        for contour in placed.contours:
            if contour.layer == "CUT_INNER":
                yield from _narrow(placed.part.label, _polygon(contour), least_mm, -kerf_mm)


def narrow_parts(sheet: LaserSheet, least_mm: float, kerf_mm: float) -> Iterator[Narrow]:
    """Parts whose outline, or whose web beside an opening, is narrower than `least_mm`; one place each."""
    for placed in sheet.placed:
        outer = [_polygon(contour) for contour in placed.contours if contour.layer == "CUT_OUTER"]
        holes = [_polygon(contour) for contour in placed.contours if contour.layer == "CUT_INNER"]
        label = placed.part.label
        places = [each for outline in outer for each in _narrow(label, outline, least_mm, kerf_mm)]
        places += _webs(label, [*outer, *holes], least_mm, kerf_mm)
        yield from sorted(places, key=lambda each: each.width_mm)[:1]


def _polygon(contour: Contour) -> Polygon:
    from shapely import Polygon

    return Polygon(Loop(contour.edges).sampled(_FLAT_MM))


def _narrow(label: str, drawn: Polygon, least_mm: float, kerf_mm: float) -> Iterator[Narrow]:
    """Where the shape is narrower, if it is; drawn, it is `kerf_mm` wider than finished.

    A shape is as wide as its narrowest neck: the least disc that can't pass through it everywhere. Tips
    don't count, they end in a point anyway. Widths are tried upwards, since a wide disc fits on one side of a
    neck only, and is one piece again; then the width is found by halving.
    """
    low = 0.0
    for high in [*np.arange(_STAIR_MM, least_mm - _SLACK_MM, _STAIR_MM).tolist(), least_mm - _SLACK_MM]:
        if not _passes(drawn, high + kerf_mm):
            break
        low = high
    else:
        return
    while high - low > _WIDTH_STEP_MM:
        middle = (low + high) / 2
        low, high = (middle, high) if _passes(drawn, middle + kerf_mm) else (low, middle)
    yield Narrow(label, low, _neck(drawn, high + kerf_mm))


def _pieces(drawn: Polygon, width_mm: float) -> list[BaseGeometry]:
    """Where the centre of a disc so wide can be."""
    from shapely import get_parts

    eroded = drawn.buffer(-width_mm / 2, quad_segs=16)
    return [piece for piece in get_parts(eroded) if piece.area > _CRUMB_MM2]


def _passes(drawn: Polygon, width_mm: float) -> bool:
    return width_mm <= 0 or len(_pieces(drawn, width_mm)) == 1


def _neck(drawn: Polygon, width_mm: float) -> tuple[float, float]:
    """Between the two pieces that lie nearest; the widest place if the disc fits nowhere."""
    from shapely import maximum_inscribed_circle, shortest_line

    pieces = _pieces(drawn, width_mm)
    if len(pieces) < 2:
        x, y = maximum_inscribed_circle(drawn, 0.02).coords[0]
        return float(x), float(y)
    lines = [shortest_line(piece, other) for index, piece in enumerate(pieces) for other in pieces[:index]]
    (x, y), (u, v) = min(lines, key=lambda line: line.length).coords
    return (x + u) / 2, (y + v) / 2


def _webs(label: str, drawn: list[Polygon], least_mm: float, kerf_mm: float) -> Iterator[Narrow]:
    """Between two cuts of one part."""
    from shapely import STRtree, shortest_line

    rings = [polygon.exterior for polygon in drawn]
    reach_mm = least_mm + kerf_mm - _SLACK_MM
    for a, b in STRtree(rings).query(rings, predicate="dwithin", distance=reach_mm).T:
        if a < b:
            line = shortest_line(rings[a], rings[b])
            (x, y), (u, v) = line.coords
            yield Narrow(label, line.length - kerf_mm, ((x + u) / 2, (y + v) / 2))
