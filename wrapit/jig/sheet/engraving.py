"""What is engraved: where each wire runs, its number, and the numbers of parts."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, Region
from wrapit.geometry.arclength import piece
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.outlines.loops import Line, point_of
from wrapit.geometry.polyline import at_lengths, lengths
from wrapit.jig.contours import Contour, arrow_head
from wrapit.jig.lettering import engraved_text, text_size_mm
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# Engraved lines keep this distance from edges: more than the beam is wide, so that none runs into a cut. With
# 0.18 mm the leaf has 2 % more engraved, and room for the one number that is left out.
CLEAR_MM = 0.25
# Heights and places of wire numbers, the next where there is no room for the one before.
NUMBER_PLACES = ((2.5, "start"), (2.0, "start"), (1.6, "start"), (2.0, "anywhere"), (1.6, "anywhere"))
# A part's own label; larger ones only take the laser longer.
LARGEST_LABEL_MM = 4.0
# A wire's line on the plate ends within STEP of where it leaves it; shorter remains than SHORTEST are dots.
_STEP_MM = 0.05
_SHORTEST_MM = 0.5
# An arrow head is as long and wide as two wires of 1 mm, so that it is seen beside one; it stands as near to
# the wire's start as there is room for all of it.
_HEAD_MM, _HEAD_STEP_MM = 2.0, 0.5
# Points that numbers keep off are so near to one another that no number's box lies between them.
_GRID_MM = 0.25


def engraved_wires(wires: Sequence[Wire], plate: Region) -> tuple[Contour, ...]:
    """Wire paths on the plate, clear of its edges, each with an arrow head.

    What is run along twice is engraved once.
    """
    area = polygon_of(plate).buffer(-CLEAR_MM)
    runs = [Contour("ENGRAVE", (part,)) for chain in _runs(wires) for part in parts_inside(chain, area)]
    heads = [head for wire in wires if (head := _arrow_head(wire, area)) is not None]
    return (*runs, *heads)


def _arrow_head(wire: Wire, area: BaseGeometry) -> Contour | None:
    """Two strokes that point the way of the wire, as near to its start as both have room; None without."""
    from shapely import LineString

    dense = chain_of(wire.centreline).sampled(0.02)
    reach = lengths(dense)
    for at in np.arange(0.0, reach[-1] - _HEAD_MM, _HEAD_STEP_MM):
        back, tip = at_lengths(dense, reach, np.array([at, at + _HEAD_MM]))
        corners = arrow_head(point_of(back), point_of(tip), _HEAD_MM)
        if area.contains(LineString(corners)):
            return Contour("ENGRAVE", tuple(Line(a, b) for a, b in itertools.pairwise(corners)))
    return None


def wire_numbers(wires: Sequence[Wire], plate: Region) -> tuple[tuple[Contour, ...], tuple[Wire, ...]]:
    """The wires' numbers beside their starts, or beside their paths; wires left without."""
    from shapely import box

    area = polygon_of(plate).buffer(-CLEAR_MM)
    # A box that holds none of these points doesn't reach out of the area.
    outside = _points_outside(area.buffer(-_GRID_MM * math.sqrt(2)))
    ink = np.vstack([*(chain_of(wire.centreline).sampled(0.5) for wire in wires), outside])
    strokes: list[Contour] = []
    left = tuple(wires)
    placed: tuple[Label, ...] = ()
    for size_mm, near in NUMBER_PLACES:
        anchors = [wire.ends[:1] if near == "start" else wire.centreline.at(_spread(wire)) for wire in left]
        wanted = [(str(wire.number), points) for wire, points in zip(left, anchors, strict=True)]
        labels = place_labels(wanted, ink, size_mm, placed)
        fits = [area.contains(box(*_corners(label))) for label in labels]
        for label in itertools.compress(labels, fits):
            strokes += engraved_text(label.text, label.centre, size_mm)
            placed = (*placed, label)
        left = tuple(wire for wire, fit in zip(left, fits, strict=True) if not fit)
    return tuple(strokes), left


def _spread(wire: Wire) -> FloatArray:
    """Parameters all along the wire."""
    return np.linspace(*wire.centreline.domain, 40)


def _corners(label: Label) -> tuple[float, float, float, float]:
    (x, y), (half_x, half_y) = label.centre, label.half_size
    return x - half_x, y - half_y, x + half_x, y + half_y


def label_on(part: Region, text: str, *, least_mm: float, force: bool = False) -> tuple[Contour, ...]:
    """The text in the widest place of a part, as large as fits; nothing below `least_mm` unless forced."""
    from shapely import maximum_inscribed_circle

    radius_line = maximum_inscribed_circle(polygon_of(part), 0.02)
    centre = radius_line.coords[0]
    width, height = text_size_mm(text, 1.0)
    fitting_mm = 2 * (radius_line.length - CLEAR_MM) / float(np.hypot(width, height))
    if fitting_mm < least_mm and not force:
        return ()
    size_mm = float(np.clip(fitting_mm, least_mm, LARGEST_LABEL_MM))
    return engraved_text(text, (float(centre[0]), float(centre[1])), size_mm)


def parts_inside(chain: BezierChain, area: BaseGeometry) -> list[BezierChain]:
    """The parts of the chain that lie inside the area, ends within a twentieth of a millimetre."""
    from shapely import contains_xy, prepare

    prepare(area)
    stations = np.linspace(0.0, chain.length, max(2, round(chain.length / _STEP_MM)) + 1)
    within = contains_xy(area, _points(chain, stations))
    parts = []
    for is_inside, run in itertools.groupby(range(len(stations)), key=lambda index: bool(within[index])):
        indices = list(run)
        start, end = float(stations[indices[0]]), float(stations[indices[-1]])
        if is_inside and end - start >= _SHORTEST_MM:
            parts.append(piece(chain, start, end))
    return parts


def _runs(wires: Sequence[Wire]) -> list[BezierChain]:
    """Each wire's path, without segments that have been run along before (by this wire or another)."""
    seen: set[int] = set()
    runs = []
    for wire in wires:
        chain = chain_of(wire.centreline)
        spans = []
        for traversal, span in zip(wire.traversals, wire.segment_spans_mm, strict=True):
            if traversal.segment not in seen:
                spans.append(span)
            seen.add(traversal.segment)
        runs += [piece(chain, start, end) for start, end in _merged(spans) if end - start > _STEP_MM]
    return runs


def _merged(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    merged: list[tuple[float, float]] = []
    for start, end in spans:
        if merged and abs(merged[-1][1] - start) < 1e-6:
            merged[-1] = merged[-1][0], end
        else:
            merged.append((start, end))
    return merged


def _points_outside(area: BaseGeometry) -> FloatArray:
    """Points (n, 2) on a grid in the area's box and a little around it, but not in it."""
    from shapely import contains_xy

    left, bottom, right, top = area.bounds
    x, y = np.meshgrid(np.arange(left - 3, right + 3, _GRID_MM), np.arange(bottom - 3, top + 3, _GRID_MM))
    points = np.column_stack([x.ravel(), y.ravel()])
    return points[~contains_xy(area, points)]


def _points(chain: BezierChain, stations: FloatArray) -> FloatArray:
    """Points (m, 2) at arc lengths (m,), near enough to tell inside from outside."""
    dense = chain.sampled(0.02)
    reach = lengths(dense)
    return at_lengths(dense, reach, stations * reach[-1] / stations[-1])
