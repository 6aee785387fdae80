"""Curves that cross and touch, cut into a planar graph: exact crossings, joints, corners."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.assembly import Piece
from wrapit.drawing.svg.cutting import corners, moved, stretches
from wrapit.drawing.svg.intersections import Contact, crossings, touches
from wrapit.drawing.svg.newton import points_at
from wrapit.drawing.svg.shared_places import Places
from wrapit.drawing.svg.steps import Steps, steps_of
from wrapit.drawing.svg.tidying import rejoined, without_doubles, without_nubs, without_stubs
from wrapit.geometry import BezierChain, FloatArray

# What is a stub behind a joint? In reaches, which are stroke widths: a stroke that ends in another's ink
# runs on for up to half a width, and a little more in a corner.
_STUB = 0.63
# How far behind a joint is a corner no corner? What lies so much off a centre line is still under its ink.
_NUB = 0.3
# Which places are one, and which pieces? In reaches as well: far less than ink is wide, far more than
# rounding.
_ONE_PLACE = 0.08
_ONE_PIECE = 0.1


@dataclass(frozen=True, eq=False)
class Curve:
    """Cubics (n, 4, 2) that follow one another, closed or open."""

    cubics: FloatArray
    closed: bool


@dataclass(frozen=True, eq=False)
class Planar:
    """Places by number, pieces between them, and free stubs (middle, length) that were left out."""

    places: dict[int, FloatArray]
    pieces: list[Piece]
    stubs: list[tuple[FloatArray, float]]


def planar(curves: list[Curve], reach: float, corner_rad: float, where: str = "drawing") -> Planar:
    """The graph of curves cut where they cross, touch, end, or turn by more than `corner_rad`.

    Ends closer than `reach` to another curve are joined to it; free stubs shorter than two thirds of
    that are left out. Raises DrawingError, which names `where`, if the curves cross too often.
    """
    marks = [_marks(curve, corner_rad) for curve in curves]
    cubics = [curve.cubics for curve in curves]
    closed = [curve.closed for curve in curves]
    steps = steps_of(cubics)
    contacts = [*crossings(steps, closed, where), *touches(cubics, closed, reach, steps)]
    for contact in contacts:
        for curve, at in contact.on:
            marks[curve].append((at, contact.point))
    places = _places(contacts, steps, _ONE_PLACE * reach)
    pieces: list[Piece] = []
    for each, own in zip(curves, marks, strict=True):
        pieces += _pieces(each, own, places, reach)
    pieces = without_doubles(pieces, _ONE_PIECE * reach)
    pieces, stubs = without_stubs(pieces, _STUB * reach)
    pieces, nubs = without_nubs(pieces, places.all(), _NUB * reach)
    return Planar(places.all(), rejoined(pieces, corner_rad), stubs + nubs)


def _places(contacts: list[Contact], steps: Steps, tolerance: float) -> Places:
    """The places of contacts, each with what its curves have there."""
    places = Places(tolerance)
    on = [pair for contact in contacts for pair in contact.on]
    curve = np.array([number for number, _ in on], dtype=np.int64)
    points = points_at(steps, curve, np.array([at for _, at in on], dtype=np.float64))
    for contact, own in zip(contacts, points.reshape(-1, 2, 2), strict=True):
        places.join([contact.point, *own], contact.point)
    return places


def _marks(curve: Curve, corner_rad: float) -> list[tuple[float, FloatArray]]:
    """Where a curve is cut without any other: its ends and its corners, as (parameter, place)."""
    count = len(curve.cubics)
    marks = [] if curve.closed else [(0.0, curve.cubics[0, 0]), (float(count), curve.cubics[-1, 3])]
    for joint in corners(curve.cubics, curve.closed, corner_rad).tolist():
        marks.append((float(joint), curve.cubics[joint, 0]))
    return marks


def _pieces(curve: Curve, marks: list[tuple[float, FloatArray]], places: Places, reach: float) -> list[Piece]:
    count = len(curve.cubics)
    if not marks:
        marks = [(0.0, curve.cubics[0, 0])]
    # Close marks are one: an end that touches a crossing, a corner that another stroke meets.
    ordered = sorted(((at % count if curve.closed else at, places.find(place)) for at, place in marks))
    kept = [
        mark
        for k, mark in enumerate(ordered)
        if k == 0 or mark[1] != ordered[k - 1][1] or _far(curve, ordered[k - 1][0], mark[0], reach)
    ]
    if curve.closed:
        if (
            len(kept) > 1
            and kept[0][1] == kept[-1][1]
            and not _far(curve, kept[-1][0], kept[0][0] + count, reach)
        ):
            kept.pop()
        kept.append((kept[0][0] + count, kept[0][1]))
    parts = stretches(curve.cubics, [at for at, _ in kept[:-1]], [at for at, _ in kept[1:]])
    return [
        Piece(first, last, moved(cubics, places.place(first), places.place(last)))
        for cubics, (_, first), (_, last) in zip(parts, kept, kept[1:], strict=False)
        if cubics is not None
    ]


def _far(curve: Curve, start: float, end: float, reach: float) -> bool:
    cubics = stretch(curve, start, end)
    return cubics is not None and BezierChain(cubics).length > reach


def stretch(curve: Curve, start: float, end: float) -> FloatArray | None:
    """The cubics between two parameters; beyond the end a closed curve goes round."""
    return stretches(curve.cubics, [start], [end])[0]
