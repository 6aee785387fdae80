"""What is engraved on the plate: where each wire runs, and its number."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, Loop, Region
from wrapit.geometry.labels import place_labels
from wrapit.geometry.pieces import chain_of, piece
from wrapit.jig.laser_model import Contour
from wrapit.jig.laser_text import engraved_text
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# Engraved lines keep this distance from cuts, so that no flake breaks off between them.
CLEAR_MM = 0.5
NUMBER_MM = 2.5
_STEP_MM = 0.05


def plate_contours(plate: Region, walls: Sequence[Region], wires: Sequence[Wire]) -> tuple[Contour, ...]:
    """Plate and walls as closed contours, wire paths and wire numbers engraved; nothing drawn twice."""
    loops = [loop for wall in walls for loop in (wall.outer, *wall.holes)] + list(plate.holes)
    return (
        *engraved_wires(wires, loops),
        *(Contour("CUT_INNER", loop.edges) for loop in loops),
        Contour("CUT_OUTER", plate.outer.edges),
    )


def engraved_wires(wires: Sequence[Wire], openings: Sequence[Loop]) -> tuple[Contour, ...]:
    """Wire paths and numbers, clear of the openings; what two wires share is engraved once."""
    from shapely import union_all
    from shapely.geometry import Polygon

    keep_out = union_all([Polygon(loop.sampled(0.01)) for loop in openings]).buffer(CLEAR_MM)
    paths = [Contour("ENGRAVE", (part,)) for chain in _runs(wires) for part in outside(chain, keep_out)]
    return (*paths, *_numbers(wires, keep_out))


def outside(chain: BezierChain, area: BaseGeometry) -> list[BezierChain]:
    """The parts of the chain that lie outside the area, ends within a twentieth of a millimetre."""
    from shapely import contains_xy

    total = chain.length
    stations = np.linspace(0.0, total, max(2, round(total / _STEP_MM)) + 1)
    points = _points(chain, stations)
    free = ~contains_xy(area, points)
    parts = []
    for is_free, run in itertools.groupby(range(len(stations)), key=lambda index: bool(free[index])):
        indices = list(run)
        if is_free and indices[-1] - indices[0] > round(CLEAR_MM / _STEP_MM):
            parts.append(piece(chain, float(stations[indices[0]]), float(stations[indices[-1]])))
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
        for start, end in _merged(spans):
            runs.append(piece(chain, start, end))
    return runs


def _merged(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    merged: list[tuple[float, float]] = []
    for start, end in spans:
        if merged and abs(merged[-1][1] - start) < 1e-6:
            merged[-1] = merged[-1][0], end
        else:
            merged.append((start, end))
    return merged


def _numbers(wires: Sequence[Wire], keep_out: BaseGeometry) -> list[Contour]:
    """The wires' numbers beside their starts, clear of openings and of one another."""
    ink = [chain_of(wire.centreline).sampled(0.5) for wire in wires]
    ink.append(_filled(keep_out))
    labels = place_labels([(number_of(wire), wire.ends[:1]) for wire in wires], np.vstack(ink), NUMBER_MM)
    return [stroke for label in labels for stroke in engraved_text(label.text, label.centre, NUMBER_MM)]


def number_of(wire: Wire) -> str:
    """`1` of `wire-01`."""
    return wire.name.rpartition("-")[2].lstrip("0") or wire.name


def _filled(area: BaseGeometry) -> FloatArray:
    """Points (n, 2) half a millimetre apart all over an area."""
    from shapely import contains_xy

    if area.is_empty:
        return np.zeros((0, 2))
    left, bottom, right, top = area.bounds
    x, y = np.meshgrid(np.arange(left, right + 0.5, 0.5), np.arange(bottom, top + 0.5, 0.5))
    points = np.column_stack([x.ravel(), y.ravel()])
    return points[contains_xy(area, points)]


def _points(chain: BezierChain, stations: FloatArray) -> FloatArray:
    """Points (m, 2) at arc lengths (m,), near enough to tell inside from outside."""
    dense = chain.sampled(0.02)
    reach = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(dense, axis=0), axis=1))])
    scaled = stations * reach[-1] / stations[-1]
    return np.column_stack([np.interp(scaled, reach, dense[:, axis]) for axis in (0, 1)])
