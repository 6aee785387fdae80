"""The page that says how to glue the laser-cut jig together."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from wrapit.geometry import Region
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.sheet.model import LaserJig, LaserPart
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from shapely import Polygon


@dataclass(frozen=True)
class SheetLine:
    """One sheet to cut: `parts` are its labels in order."""

    number: int
    thickness_mm: float
    size_mm: tuple[float, float]
    parts: tuple[str, ...]


@dataclass(frozen=True)
class MapPart:
    """A part on the map of a stack: path data, its label and where that stands."""

    label: str
    role: str
    path: str
    x: str
    y: str
    text_mm: str


@dataclass(frozen=True)
class GluedGroup:
    """Parts of one role that are glued into the same place; `inside` is empty for the pocket plate."""

    role: str
    inside: str
    labels: tuple[str, ...]


@dataclass(frozen=True)
class StackPage:
    """How one stack is glued, group by group from the outside to the inside."""

    jig: str
    bottom: str
    plate: str
    copies: int
    groups: tuple[GluedGroup, ...]
    view_box: str
    parts: tuple[MapPart, ...]
    wires: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class LaserPage:
    """The whole page; `pins` are (wire, at mm, diameter)."""

    sheets: tuple[SheetLine, ...]
    stacks: tuple[StackPage, ...]
    wall_height_mm: float
    pins: tuple[tuple[str, float, float], ...]


def plan_laser_page(laser: LaserJig) -> LaserPage:
    """What the page says and shows, for every stack of the jig."""
    stacks = [
        _stack(jig, list(parts), laser.laid[jig])
        for jig, parts in itertools.groupby(laser.parts, lambda part: part.jig)
    ]
    sheets = [
        SheetLine(
            sheet.number,
            sheet.thickness_mm,
            (sheet.width_mm, sheet.height_mm),
            tuple(dict.fromkeys(placed.part.label for placed in sheet.placed)),
        )
        for sheet in laser.sheets
    ]
    pins = [(pin.turn.wire, (pin.turn.start_mm + pin.turn.end_mm) / 2, pin.diameter_mm) for pin in laser.pins]
    return LaserPage(tuple(sheets), tuple(stacks), laser.wall_height_mm, tuple(pins))


def _stack(jig: str, parts: Sequence[LaserPart], wires: Sequence[Wire]) -> StackPage:
    bottom, plate = (next(part for part in parts if part.role == role) for role in ("bottom", "pocket plate"))
    inlays = [part for part in parts if part.role in ("wall", "island")]
    outline = plate.shape.outer.sampled(0.1)
    frame = SvgFrame.around(outline.min(axis=0), outline.max(axis=0), 1.0)
    text_mm = float(np.ptp(outline, axis=0).max()) / 36
    return StackPage(
        jig=jig,
        bottom=bottom.label,
        plate=plate.label,
        copies=max(part.copies for part in parts),
        groups=_gluing_order(inlays),
        view_box=frame.view_box,
        parts=tuple(_on_map(part, frame, text_mm) for part in (plate, *inlays)),
        wires=tuple((frame.path(chain_of(wire.centreline)), wire.colour) for wire in wires),
    )


def _gluing_order(inlays: Sequence[LaserPart]) -> tuple[GluedGroup, ...]:
    """Parts that lie in nothing but the plate first, then those in their rings, and so on."""
    from shapely import Polygon

    filled = {part.label: Polygon(part.shape.outer.sampled(0.02)) for part in inlays}
    # A point of the part itself, not of the pockets in it, in which other parts lie.
    points = {part.label: _polygon(part.shape).representative_point() for part in inlays}
    inside = {
        part.label: [
            other.label
            for other in inlays
            if other is not part and filled[other.label].contains(points[part.label])
        ]
        for part in inlays
    }
    ordered = sorted(inlays, key=lambda part: len(inside[part.label]))

    def place(part: LaserPart) -> tuple[str, str]:
        return part.role, min(inside[part.label], key=lambda label: filled[label].area, default="")

    return tuple(
        GluedGroup(role, where, tuple(part.label for part in parts))
        for (role, where), parts in itertools.groupby(ordered, place)
    )


def _on_map(part: LaserPart, frame: SvgFrame, text_mm: float) -> MapPart:
    from shapely import maximum_inscribed_circle

    # Island and plate are drawn as outlines only; the pockets show where the pieces go.
    shape = Region(part.shape.outer) if part.role == "pocket plate" else part.shape
    widest = maximum_inscribed_circle(_polygon(shape), 0.05)
    x, y = frame.at(widest.coords[0])
    fitting_mm = min(text_mm, 1.5 * widest.length)
    return MapPart(part.label, part.role, frame.region(shape), number(x), number(y), number(fitting_mm))


def _polygon(region: Region) -> Polygon:
    from shapely import Polygon

    return Polygon(region.outer.sampled(0.02), [hole.sampled(0.02) for hole in region.holes])
