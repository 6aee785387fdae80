"""Walls and their pockets: finished shapes, and the cuts half a kerf beside them."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wrapit.config import PlateConfig
from wrapit.errors import Finding
from wrapit.geometry import Line, Loop, Region
from wrapit.geometry.outlines.loops import oriented, reversed_loop
from wrapit.jig.contours import Contour
from wrapit.jig.made import Each

if TYPE_CHECKING:
    from shapely import Polygon

# What a region becomes when its outline moves outward by mm (inward if negative): none, one or more.
Offset = Callable[[Region, float], tuple[Region, ...]]
# Largest distance (mm) between an offset outline and its check by polygons: a fifth of the usual fit. 30 % up
# or down changes nothing on leaf and butterfly.
OFFSET_TOLERANCE_MM = 0.01
# Between points of outlines that are flattened; a tenth of it where the result is cut, not only looked at.
_FLAT_MM = 0.004
_BY_LINES = "an outline of this wall is cut along short lines, within 0.001 mm, not along exact curves"
_KERF_REMEDY = "measure the kerf with `wrapit coupon` and set plate.kerf, or make the piece larger"


@dataclass(frozen=True, eq=False)
class Inlay:
    """A wall piece and its pocket. Loops are counter-clockwise.

    `wall` is the planned shape (the beam rounds its corners a little), `pocket` the finished one, whose
    holes are islands of plate inside a ring wall. `piece_cuts` cut the piece, `pocket_cut` opens the
    pocket, `island_cuts` free each island.
    """

    number: int
    wall: Region
    pocket: Region
    piece_cuts: tuple[Contour, ...]
    pocket_cut: Loop
    island_cuts: tuple[Loop, ...]


@dataclass(frozen=True)
class Moved:
    """An outline after an offset; not exact means lines within a thousandth of a millimetre."""

    loop: Loop
    exact: bool


class _Swallowed(Exception):  # noqa: N818  not an error of the program, but of the wish
    """An outline that doesn't survive its offset."""


def make_inlays(
    jig: str, walls: Sequence[Region], config: PlateConfig, offset: Offset, each: Each
) -> tuple[tuple[Inlay, ...], tuple[Finding, ...]]:
    """An inlay for each wall, numbered from 1; walls that can't be cut are left out with a finding.

    The piece's cut lies half a kerf outside of it, the pocket's half a kerf inside of the pocket, so that
    pocket minus piece is `fit` all around.
    """
    inlays: list[Inlay] = []
    findings: list[Finding] = []
    shapes = [oriented(wall) for wall in walls]
    made = each(functools.partial(_inlay, config=config, offset=offset), shapes)
    for wall, found in zip(shapes, made, strict=True):
        point = polygon_of(wall).representative_point()
        where = f"{jig}, wall at ({point.x:.1f}, {point.y:.1f})"
        if isinstance(found, str):
            findings.append(Finding("warning", "kerf-too-wide", where, found, _KERF_REMEDY))
            continue
        inlay, exact = found
        inlays.append(dataclasses.replace(inlay, number=len(inlays) + 1))
        if not exact:
            findings.append(Finding("note", "offset-by-lines", where, _BY_LINES))
    return tuple(inlays), tuple(findings)


def polygon_of(region: Region) -> Polygon:
    """The region as a polygon, within a hundredth of a millimetre."""
    from shapely import Polygon

    return Polygon(region.outer.sampled(_FLAT_MM), [hole.sampled(_FLAT_MM) for hole in region.holes])


def _inlay(wall: Region, config: PlateConfig, offset: Offset) -> tuple[Inlay, bool] | str:
    """The inlay, not numbered yet, and whether all its outlines are exact; why it can't be cut."""
    try:
        return _cut(wall, config, offset)
    except _Swallowed as reason:
        return str(reason)


def _cut(wall: Region, config: PlateConfig, offset: Offset) -> tuple[Inlay, bool]:
    half_mm, fit_mm = config.kerf / 2, config.fit
    exact = []

    def moved(loop: Loop, distance_mm: float, what: str) -> Loop:
        result = moved_outline(loop, distance_mm, offset)
        if result is None:
            raise _Swallowed(f"{what} is too narrow for the laser's kerf; the wall is left out")
        exact.append(result.exact)
        return result.loop

    def mated(loop: Loop, hollow_mm: float, solid_mm: float, what: str) -> tuple[Loop, Loop]:
        """Cuts of a hollow and of the solid that fills it, which lie these distances beside the loop.

        The beam is round: hollows can't have sharper outer corners than half a kerf, solids no sharper
        inner ones. Each is derived from the other, so that what one can't have, the other hasn't.
        """
        apart_mm = config.kerf - fit_mm
        if fit_mm >= half_mm:
            solid = moved(loop, solid_mm, what)
            return moved(solid, -apart_mm, what), solid
        hollow = moved(loop, hollow_mm, what)
        solid = moved(hollow, apart_mm, what)
        return (hollow if _comes_back(hollow, apart_mm) else moved(solid, -apart_mm, what)), solid

    pocket_cut, outer = mated(wall.outer, fit_mm - half_mm, half_mm, "this wall")
    rings = [
        mated(reversed_loop(hole), -half_mm, half_mm - fit_mm, "the hole inside this wall")
        for hole in wall.holes
    ]
    inlay = Inlay(
        0,
        wall,
        Region(
            _finished(pocket_cut, half_mm),
            tuple(reversed_loop(_finished(island, -half_mm)) for _, island in rings),
        ),
        (
            *(Contour("CUT_INNER", reversed_loop(hollow).edges) for hollow, _ in rings),
            Contour("CUT_OUTER", outer.edges),
        ),
        pocket_cut,
        tuple(island for _, island in rings),
    )
    return inlay, all(exact)


def _comes_back(loop: Loop, distance_mm: float) -> bool:
    """Whether the outline is the same after it has gone outward and inward again (no inner corners)."""
    from shapely import Polygon

    flat = Polygon(loop.sampled(_FLAT_MM / 10))
    back = flat.buffer(distance_mm, quad_segs=32).buffer(-distance_mm, quad_segs=32)
    return bool(abs(back.area - flat.area) < 2e-5 * flat.length)


def _finished(cut: Loop, half_mm: float) -> Loop:
    """What the beam leaves beside a cut, as lines; only pictures and measurements need it."""
    from shapely import Polygon

    return _lines(Polygon(cut.sampled(_FLAT_MM / 10)).buffer(half_mm, quad_segs=16))


def _lines(polygon: Polygon) -> Loop:
    """The polygon's outer ring, counter-clockwise, without needless points."""
    ring = polygon.simplify(_FLAT_MM / 4).exterior.normalize().coords[:-1]
    edges = tuple(Line(a, b) for a, b in zip(ring, (*ring[1:], ring[0]), strict=True))
    return oriented(Region(Loop(edges))).outer


def moved_outline(loop: Loop, distance_mm: float, offset: Offset) -> Moved | None:
    """The outline moved outward; None if it vanishes, falls apart or closes upon itself.

    The exact result is checked against polygons; where it fails the check, the polygon itself is taken.
    """
    from shapely import Polygon

    if abs(distance_mm) < 1e-9:
        return Moved(loop, exact=True)
    expected = Polygon(loop.sampled(_FLAT_MM / 10)).buffer(distance_mm, quad_segs=64)
    if expected.is_empty or expected.geom_type != "Polygon" or expected.interiors:
        return None
    try:
        results = [oriented(region) for region in offset(Region(loop), distance_mm)]
    except (ValueError, IndexError, ArithmeticError):  # no outline could be put together
        results = []
    if len(results) == 1 and not results[0].holes and _agrees(results[0].outer, expected):
        return Moved(results[0].outer, exact=True)
    return Moved(_lines(expected), exact=False)


def _agrees(loop: Loop, expected: Polygon) -> bool:
    """Whether each outline stays within the tolerance of the other."""
    from shapely import Polygon, dwithin, get_coordinates, points, prepare

    places = loop.sampled(_FLAT_MM / 10)
    if len(places) < 3:  # there and back along one line
        return False
    found = Polygon(places)
    if not found.is_valid:
        return False
    # Of the many points of a curve those that tell where it goes: a tenth of the tolerance.
    rims = [
        polygon.exterior.simplify(OFFSET_TOLERANCE_MM / 10, preserve_topology=False)
        for polygon in (found, expected)
    ]
    for one, other in (rims, reversed(rims)):
        prepare(other)
        if not dwithin(other, points(get_coordinates(one.segmentize(0.1))), OFFSET_TOLERANCE_MM).all():
            return False
    return True
