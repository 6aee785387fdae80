"""The page of the guide that says how to cut the laser-cut jig and glue it together."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wrapit.geometry import Region
from wrapit.geometry.bspline import chain_of
from wrapit.jig.bench.from_above import LINE, bounds_of
from wrapit.jig.bench.pin_list import pin_blocks
from wrapit.jig.made import GuidePage
from wrapit.jig.sheet.model import LaserJig, LaserPart
from wrapit.pages.model import (
    Block,
    Caution,
    Figure,
    Heading,
    Length,
    Mark,
    Paragraph,
    Picture,
    Points,
    Shape,
    Style,
    Table,
    Text,
    either,
    listed,
    text,
)
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from shapely import Polygon


@dataclass(frozen=True)
class GluedGroup:
    """Parts of one role that are glued into the same place; `inside` is empty for the pocket plate."""

    role: str
    inside: str
    labels: tuple[str, ...]


def gluing_page(laser: LaserJig, files: Mapping[int, Sequence[str]], *, pair: bool) -> GuidePage:
    """What the guide says of this jig, stack by stack; `files` has those of each sheet by its number."""
    blocks: list[Block] = [Paragraph(text("glue-how")), _sheets(laser, files), Paragraph(text("glue-leave"))]
    if pair:
        blocks.append(Caution(text("glue-pair")))
    stacks = [(jig, tuple(parts)) for jig, parts in itertools.groupby(laser.parts, lambda part: part.jig)]
    for jig, parts in stacks:
        blocks += _stack(jig, parts, laser, alone=len(stacks) == 1)
    return GuidePage("laser", text("glue-title"), (*blocks, *pin_blocks(laser.pins)))


def _sheets(laser: LaserJig, files: Mapping[int, Sequence[str]]) -> Table:
    head = tuple(text(f"glue-head-{each}") for each in ("sheet", "thickness", "size", "parts", "file"))
    rows = []
    for sheet in laser.sheets:
        labels = dict.fromkeys(placed.part.label for placed in sheet.placed)
        mine = files.get(sheet.number, ())
        rows.append(
            (
                text("number", value=sheet.number),
                text("length", value=Length(sheet.thickness_mm)),
                text("size-flat", x=Length(sheet.width_mm), y=Length(sheet.height_mm)),
                text("plain", value=", ".join(labels)),
                text("file-one-of", files=either(mine)) if mine else text("file-none-flat"),
            )
        )
    return Table(text("glue-sheets"), head, tuple(rows))


def _stack(jig: str, parts: Sequence[LaserPart], laser: LaserJig, *, alone: bool) -> Iterator[Block]:
    bottom, plate = (next(part for part in parts if part.role == role) for role in ("bottom", "pocket plate"))
    inlays = [part for part in parts if part.role in ("wall", "island")]
    wires = laser.laid[jig]
    if not alone:
        numbers = listed(wire.number for wire in wires)
        yield Heading(text("jig-for", jig=jig, wires=numbers, count=len(wires)))
    yield Figure(_map(plate, inlays, wires), text("glue-picture", jig=jig), text("glue-caption"))
    copies = max(part.copies for part in parts)
    steps = [text("glue-bottom", part=bottom.label), text("glue-plate", part=plate.label)]
    steps += [_glued(group, copies) for group in gluing_order(inlays)]
    steps.append(text("glue-dry", height=Length(laser.wall_height_mm)))
    yield Points(tuple(steps), numbered=True)


def _glued(group: GluedGroup, copies: int) -> Text:
    """`Glue wall pieces 3 and 4, number up, into their pockets.`"""
    return text(
        "glue-island" if group.role == "island" else "glue-wall",
        parts=listed(group.labels),
        count=len(group.labels),
        where="in" if group.inside else "plate",
        inside=group.inside,
        copies=copies,
        more=copies - 1,
    )


def _map(plate: LaserPart, inlays: Sequence[LaserPart], wires: Sequence[Wire]) -> Picture:
    """Where each piece goes; plate and islands are drawn as outlines, for pockets show where pieces go."""
    from shapely import maximum_inscribed_circle

    low, high, text_mm = bounds_of(plate.shape)
    shapes = [Shape(Region(plate.shape.outer), "plate")]
    marks = []
    for part in inlays:
        style: Style = "plate" if part.role == "island" else "wall"
        shapes.append(Shape(part.shape, style))
        widest = maximum_inscribed_circle(_polygon(part.shape), 0.05)
        x, y = widest.coords[0]
        marks.append(Mark(part.label, (float(x), float(y)), "bare"))
    lines = [Shape(chain_of(wire.centreline), "wire", wire.colour, LINE * text_mm) for wire in wires]
    return Picture(low, high, text_mm, (*shapes, *lines), tuple(marks))


def gluing_order(inlays: Sequence[LaserPart]) -> tuple[GluedGroup, ...]:
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


def _polygon(region: Region) -> Polygon:
    from shapely import Polygon

    return Polygon(region.outer.sampled(0.02), [hole.sampled(0.02) for hole in region.holes])
