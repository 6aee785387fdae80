"""Measures what the laser will draw: closed contours, distances of cuts, webs, lengths."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wrapit.errors import Finding
from wrapit.geometry import Arc, BezierChain, Edge, Loop
from wrapit.jig.contours import Contour
from wrapit.jig.sheet.model import LaserChecks, LaserPart, LaserSheet

if TYPE_CHECKING:
    from shapely import LinearRing

# What a shop would ask about; all three bound findings alone, no part changes with them.
# Cut lines nearer than this char the sheet between them.
LEAST_CUT_DISTANCE_MM = 0.5
# Webs below this are mentioned; they hold once the plate is glued down.
THIN_WEB_MM = 1.5
# Webs below this break when the part is lifted off the laser's bed.
LEAST_WEB_MM = 0.8
# Farther apart than this, distances don't matter: more than three times what is mentioned.
_REACH_MM = 5.0
# How near a measured outline's points keep to its arcs; other curves have one each 0.02 mm, which is
# 0.02²/(8 · 0.2) = 2.5e-4 mm at a radius of 0.2 mm. With 0.005 two arcs 2.1 mm apart were told to be 2.095.
_FLAT_MM = 2e-4


@dataclass(frozen=True)
class _Near:
    """Two cuts and their distance; `at` is a point between them in the coordinates of the sheet."""

    first: int
    second: int
    distance_mm: float
    at: tuple[float, float]


def check_sheets(
    parts: Sequence[LaserPart], sheets: Sequence[LaserSheet], kerf_mm: float
) -> tuple[LaserChecks, tuple[Finding, ...]]:
    """Measurements over all sheets and parts, with a finding for everything a shop would ask about."""
    findings: list[Finding] = []
    closed = 0
    distances: list[float] = []
    cut_mm = engraved_mm = 0.0
    for sheet in sheets:
        cuts = [contour for contour in sheet.contours if contour.is_cut]
        closed += sum(contour.closed for contour in cuts)
        findings += _broken(sheet, cuts)
        nearest = min(_near_pairs(cuts), key=lambda near: near.distance_mm, default=None)
        if nearest is not None:
            distances.append(nearest.distance_mm)
            findings += _too_near(sheet, nearest)
        cut_mm += sum(map(length_mm, cuts))
        engraved = (contour for contour in sheet.contours if contour.is_worked and not contour.is_cut)
        engraved_mm += sum(map(length_mm, engraved))
    webs = [web for part in parts if (web := _web(part, kerf_mm)) is not None]
    findings += [finding for _, finding in webs if finding is not None]
    return (
        LaserChecks(
            closed_contours=closed,
            min_cut_distance_mm=min(distances, default=None),
            min_web_mm=min((width_mm for width_mm, _ in webs), default=None),
            cut_length_mm=cut_mm,
            engraved_length_mm=engraved_mm,
        ),
        tuple(findings),
    )


def length_mm(contour: Contour) -> float:
    """How far the laser travels along a contour."""
    return sum(map(_edge_length_mm, contour.edges))


def _edge_length_mm(edge: Edge) -> float:
    if isinstance(edge, Arc):
        return abs(edge.sweep_rad) * edge.radius_mm
    return edge.length if isinstance(edge, BezierChain) else math.dist(edge.start, edge.end)


def _ring(contour: Contour) -> LinearRing:
    from shapely import LinearRing

    return LinearRing(Loop(contour.edges).sampled(_FLAT_MM))


def _broken(sheet: LaserSheet, cuts: Sequence[Contour]) -> list[Finding]:
    """Cuts that are open or cross themselves."""
    findings = []
    for contour in cuts:
        x, y = contour.edges[0].start
        where = f"sheet {sheet.number} at ({x:.1f}, {y:.1f})"
        if not contour.closed:
            findings.append(
                Finding("error", "open-cut", where, "a cut is not closed", "please report this drawing")
            )
        elif not _ring(contour).is_simple:
            findings.append(
                Finding("error", "crossing-cut", where, "a cut crosses itself", "change the size a little")
            )
    return findings


def _near_pairs(cuts: Sequence[Contour]) -> list[_Near]:
    """Pairs of cuts within reach of one another."""
    from shapely import STRtree, prepare, shortest_line

    rings = [_ring(contour) for contour in cuts if contour.closed]
    pairs = STRtree(rings).query(rings, predicate="dwithin", distance=_REACH_MM).T if rings else ()
    prepare(rings)  # shortest_line then takes a tenth of the time
    found = []
    for first, second in sorted((int(a), int(b)) for a, b in pairs if a < b):
        line = shortest_line(rings[first], rings[second])
        (x, y), (u, v) = line.coords
        found.append(_Near(first, second, line.length, ((x + u) / 2, (y + v) / 2)))
    return found


def _too_near(sheet: LaserSheet, near: _Near) -> list[Finding]:
    if near.distance_mm >= LEAST_CUT_DISTANCE_MM:
        return []
    where = f"sheet {sheet.number} at ({near.at[0]:.1f}, {near.at[1]:.1f})"
    if near.distance_mm < 1e-6:
        return [
            Finding("error", "crossing-cut", where, "two cuts cross or touch", "change the size a little")
        ]
    message = f"two cuts are only {near.distance_mm:.2f} mm apart; the sheet chars between them"
    return [Finding("warning", "cuts-too-near", where, message, "make the piece larger, or reduce plate.fit")]


def _web(part: LaserPart, kerf_mm: float) -> tuple[float, Finding | None] | None:
    """Narrowest web between two openings, or between an opening and the edge, of the finished part."""
    cuts = [contour for contour in part.contours if contour.is_cut]
    pairs = _near_pairs(cuts)
    if not pairs:
        return None
    narrow = [near for near in pairs if near.distance_mm - kerf_mm < THIN_WEB_MM]
    nearest = min(pairs, key=lambda near: near.distance_mm)
    web_mm = nearest.distance_mm - kerf_mm
    if not narrow:
        return web_mm, None
    where = f"{part.jig}, part {part.label} at ({nearest.at[0]:.1f}, {nearest.at[1]:.1f})"
    count = f"{len(narrow)} webs are" if len(narrow) > 1 else "a web is"
    message = f"{count} narrower than {THIN_WEB_MM} mm, the narrowest {web_mm:.2f} mm; handle with care"
    remedy = "glue this plate down before the pieces, or enlarge the piece"
    return web_mm, Finding(
        "warning" if web_mm < LEAST_WEB_MM else "note", "narrow-web", where, message, remedy
    )
