"""Test pieces: one to cut, which measures the laser's kerf and fit; one to print, for the clearance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import JigError
from wrapit.geometry import Line, Loop, Region
from wrapit.geometry.outlines.loops import reversed_loop, rounded_rectangle
from wrapit.jig.contours import Contour
from wrapit.jig.lettering import engraved_text
from wrapit.jig.wall_height import wall_height_mm

if TYPE_CHECKING:
    from shapely import LinearRing

# What is tried: as many slots and channels as lie side by side on a card of 100 mm, steps that a caliper and
# a finger tell apart, the middle one what the config has now.
SLOTS = 9
KERF_STEP_MM, CLEARANCE_STEP_MM = 0.03, 0.05
FITS_MM = (0.0, 0.025, 0.05, 0.075, 0.1)
# The narrowest slot that a laser cuts as a slot, as two lines.
NARROWEST_SLOT_MM = 0.2
# How the coupons are laid out. Nothing is measured by these; the tests see to it that nothing touches.
_PITCH_MM, _SLOT_MM, _TEXT_MM = 10.0, 12.0, 2.0
_KEY_MM = (12.0, 5.0)
# A raised number's line: one and a half widths of a nozzle of 0.4 mm, three layers of 0.2 mm high.
_RIB_MM, _RIB_HEIGHT_MM = 0.6, 0.6


@dataclass(frozen=True, eq=False)
class CutCoupon:
    """What the laser draws, lower left corner near the origin; `kerfs_mm` are those of the slots in order."""

    contours: tuple[Contour, ...]
    width_mm: float
    height_mm: float
    kerfs_mm: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class PrintedCoupon:
    """A base plate and what stands on it: regions with the height of their tops over the table."""

    base: Region
    base_mm: float
    terraces: tuple[tuple[Region, float], ...]
    clearances_mm: tuple[float, ...]


def kerf_coupon(diameter_mm: float, config: PlateConfig) -> CutCoupon:
    """Nine slots around the wire's diameter, five pockets and a key.

    The slot labelled with the true kerf takes the wire without play: it is drawn that much narrower than
    the wire. The key is cut for the configured kerf; the pocket that it fits gives `plate.fit`.
    Raises JigError when the wire is too thin to measure with.
    """
    kerfs = _spread(config.kerf, KERF_STEP_MM)
    if diameter_mm - kerfs[-1] < NARROWEST_SLOT_MM:
        raise JigError(
            f"a wire of {diameter_mm:.2f} mm is too thin to measure a kerf of {kerfs[-1]:.2f} mm",
            "wire.gauge",
            f"use wire of at least {kerfs[-1] + NARROWEST_SLOT_MM:.1f} mm for the coupon",
        )
    width, height = SLOTS * _PITCH_MM + 8.0, 42.0
    engraved: list[Contour] = []
    cuts: list[Contour] = []
    for index, kerf in enumerate(kerfs):
        x = 4.0 + _PITCH_MM * (index + 0.5)
        cuts.append(_slot(x, height - 8.0, diameter_mm - kerf, _SLOT_MM))
        engraved += engraved_text(f"{kerf:.2f}", (x, height - 4.5), _TEXT_MM)
    for index, fit in enumerate(FITS_MM):
        x = 12.0 + 18.0 * (index + 0.5) - 6.0
        cuts.append(_pocket(x, 10.0, fit, config.kerf))
        engraved += engraved_text(f"{fit:.3f}", (x, 4.5), _TEXT_MM)
    plate = rounded_rectangle(0.0, 0.0, width, height, 2.0)
    key = _key(width + 4.0 + _KEY_MM[0] / 2, 10.0, config.kerf)
    contours = (*engraved, *cuts, Contour("CUT_OUTER", plate.edges), key)
    return CutCoupon(contours, width + 6.0 + _KEY_MM[0], height, kerfs)


def clearance_coupon(diameter_mm: float, config: JigConfig) -> PrintedCoupon:
    """Nine channels between walls, for clearances around the configured one.

    Lay the wire into each: the narrowest that it goes into easily gives `jig.clearance`. The raised number
    in front of a channel is its clearance in hundredths of a millimetre.
    """
    clearances = _spread(config.clearance, CLEARANCE_STEP_MM)
    wall_mm, long_mm, front_mm = 3.5, 20.0, 9.0
    base_mm = config.base_thickness
    top_mm = base_mm + wall_height_mm(1, diameter_mm, config)
    terraces: list[tuple[Region, float]] = []
    x = 2.0
    terraces.append((_block(x, front_mm, x + wall_mm, front_mm + long_mm), top_mm))
    x += wall_mm
    for clearance in clearances:
        channel = diameter_mm + 2 * clearance
        # Numbers are wider than thin channels; each stands before the wall to the right of its channel.
        centre = (x + channel + wall_mm / 2, front_mm / 2 - 0.5)
        terraces += [(rib, base_mm + _RIB_HEIGHT_MM) for rib in _ribs(f"{100 * clearance:.0f}", centre, 2.0)]
        x += channel
        terraces.append((_block(x, front_mm, x + wall_mm, front_mm + long_mm), top_mm))
        x += wall_mm
    base = Region(rounded_rectangle(0.0, 0.0, x + 2.0, front_mm + long_mm + 2.0, 2.0))
    return PrintedCoupon(base, base_mm, tuple(terraces), clearances)


def _spread(middle_mm: float, step_mm: float) -> tuple[float, ...]:
    """Nine values around the middle one, from zero upward if they would start below it."""
    first = max(0.0, middle_mm - (SLOTS // 2) * step_mm)
    return tuple(round(first + index * step_mm, 6) for index in range(SLOTS))


def _slot(x: float, top: float, width_mm: float, length_mm: float) -> Contour:
    half = width_mm / 2
    return Contour("CUT_INNER", _box(x - half, top - length_mm, x + half, top))


def _pocket(x: float, y: float, fit_mm: float, kerf_mm: float) -> Contour:
    grown = fit_mm - kerf_mm / 2
    half_x, half_y = _KEY_MM[0] / 2 + grown, _KEY_MM[1] / 2 + grown
    return Contour("CUT_INNER", _box(x - half_x, y - half_y, x + half_x, y + half_y))


def _key(x: float, y: float, kerf_mm: float) -> Contour:
    """The key, its corners rounded by half a kerf like those of its pockets."""
    half_x, half_y = (side / 2 + kerf_mm / 2 for side in _KEY_MM)
    return Contour(
        "CUT_OUTER", rounded_rectangle(x - half_x, y - half_y, x + half_x, y + half_y, kerf_mm).edges
    )


def _box(left: float, bottom: float, right: float, top: float) -> tuple[Line, ...]:
    loop = reversed_loop(rounded_rectangle(left, bottom, right, top, 0.0))
    return tuple(edge for edge in loop.edges if isinstance(edge, Line))


def _block(left: float, bottom: float, right: float, top: float) -> Region:
    return Region(rounded_rectangle(left, bottom, right, top, 0.0))


def _ribs(text: str, centre: tuple[float, float], height_mm: float) -> list[Region]:
    """The text as flat ribs, wide enough to print."""
    from shapely import MultiLineString, get_parts

    strokes = [
        [contour.edges[0].start, *(edge.end for edge in contour.edges)]
        for contour in engraved_text(text, centre, height_mm)
    ]
    shape = MultiLineString(strokes).buffer(_RIB_MM / 2, quad_segs=4)
    parts = sorted(get_parts(shape), key=lambda part: part.bounds)
    return [Region(_ring(part.exterior), tuple(_ring(ring) for ring in part.interiors)) for part in parts]


def _ring(ring: LinearRing) -> Loop:
    points = [(float(x), float(y)) for x, y in ring.coords[:-1]]
    return Loop(tuple(Line(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)))
