"""The parts of the inlay: a bottom plate, a plate with wall-shaped pockets, wall pieces glued into them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding
from wrapit.geometry import Loop, Region
from wrapit.geometry.outlines.loops import circle, oriented, reversed_loop, rounded_rectangle
from wrapit.jig.contours import Contour
from wrapit.jig.lettering import engraved_text
from wrapit.jig.made import Each
from wrapit.jig.model import Hole
from wrapit.jig.sheet.engraving import engraved_wires, label_on, wire_numbers
from wrapit.jig.sheet.frame import Frame, frame_around
from wrapit.jig.sheet.inlays import Inlay, Offset, make_inlays, moved_outline, polygon_of
from wrapit.jig.sheet.model import LaserPart
from wrapit.jig.wall_height import glued_height_mm
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from shapely import Polygon

# Sheet left between a start hole and a pocket; `stage.HOLE_WEB_MM` keeps walls off, this catches the rest
# (30 % up or down changes no part of leaf and butterfly).
LEAST_HOLE_WEB_MM = 0.5
# Height of a plate's own label, which fits the strip along its lower edge.
LABEL_MM = 2.5
# What tolerances of sheet thickness may take away from a wall's height.
_SHEET_TOLERANCE_MM = 0.1


def copies_needed(layers: int, diameter_mm: float, config: PlateConfig) -> int:
    """How many wall pieces are stacked, so that walls are as high as the wires' layers, two at least."""
    needed_mm = config.sheet + glued_height_mm(layers, diameter_mm) - _SHEET_TOLERANCE_MM
    return max(1, math.ceil(needed_mm / config.wall_sheet))


def stack_parts(
    jig: str,
    prefix: str,
    wires: Sequence[Wire],
    walls: Sequence[Region],
    holes: Sequence[Hole],
    jig_config: JigConfig,
    config: PlateConfig,
    offset: Offset,
    each: Each,
) -> tuple[tuple[LaserPart, ...], tuple[Finding, ...]]:
    """All parts of one jig, where they lie in it: bottom, pocket plate, its islands, wall pieces.

    `walls` are finished shapes; `prefix` tells the labels of several jigs apart. Findings name walls and
    start holes that can't be cut.
    """
    inlays, findings = make_inlays(jig, walls, config, offset, each)
    kept, hole_findings = _clear_holes(jig, holes, inlays)
    frame = frame_around(wires, [inlay.wall for inlay in inlays], kept, jig_config, config)
    pins = [Hole(pin, config.pin, (), circle(pin, config.pin / 2)) for pin in frame.pins]
    cuts = [(hole, _hole_cut(hole, config, offset)) for hole in (*pins, *kept)]
    through = tuple(_Opening(hole, cut) for hole, cut in cuts if cut is not None)
    swallowed = [_swallowed(jig, hole) for hole, cut in cuts if cut is None]
    copies = copies_needed(max(wire.layers for wire in wires), max(w.diameter_mm for w in wires), config)
    numbers, numberless = wire_numbers(wires, _bare(frame, through, inlays))
    parts = (
        _bottom(jig, prefix, frame, through, inlays, config),
        *_pocket_plates(jig, prefix, frame, through, inlays, wires, numbers, config),
        *(_piece(jig, prefix, inlay, copies, config) for inlay in inlays),
    )
    unnumbered = [_numberless(jig, wire) for wire in numberless]
    return parts, (*findings, *hole_findings, *swallowed, *unnumbered)


@dataclass(frozen=True, eq=False)
class _Opening:
    """A hole through both plates and its cut."""

    hole: Hole
    cut: Loop


def _hole_cut(hole: Hole, config: PlateConfig, offset: Offset) -> Loop | None:
    outline = oriented(Region(hole.outline)).outer
    moved = moved_outline(outline, -config.kerf / 2, offset)
    return moved.loop if moved is not None else None


def _bare(frame: Frame, through: Sequence[_Opening], inlays: Sequence[Inlay]) -> Region:
    """What is left of the plate beside pockets (with all that lies in them), holes and the part's label."""
    x, y = frame.label_place
    label = rounded_rectangle(x - 1.5 * LABEL_MM, y - LABEL_MM, x + 1.5 * LABEL_MM, y + LABEL_MM, 0.0)
    pockets = [reversed_loop(inlay.pocket.outer) for inlay in inlays]
    return Region(frame.outline(), (*pockets, *map(_rim, through), reversed_loop(label)))


def _swallowed(jig: str, hole: Hole) -> Finding:
    return Finding(
        "warning",
        "kerf-too-wide",
        f"{jig}, hole at ({hole.centre[0]:.1f}, {hole.centre[1]:.1f})",
        f"a hole of {hole.diameter_mm:.1f} mm is narrower than the laser's kerf; it is left out",
        "drill it by hand, or measure the kerf with `wrapit coupon` and set plate.kerf",
    )


def _numberless(jig: str, wire: Wire) -> Finding:
    return Finding(
        "note",
        "number-without-room",
        f"{jig}, start of {wire.name}",
        "there is no room on the plate for the wire's number",
        "write it on by hand",
    )


def _clear_holes(
    jig: str, holes: Sequence[Hole], inlays: Sequence[Inlay]
) -> tuple[list[Hole], list[Finding]]:
    """Start holes with enough sheet between them and the pockets."""
    pockets = [polygon_of(inlay.pocket) for inlay in inlays]
    kept, findings = [], []
    for hole in holes:
        rim = polygon_of(Region(hole.outline))
        if min((pocket.distance(rim) for pocket in pockets), default=math.inf) >= LEAST_HOLE_WEB_MM:
            kept.append(hole)
            continue
        findings.append(
            Finding(
                "warning",
                "hole-in-wall",
                f"{jig}, {', '.join(hole.wires)} at ({hole.centre[0]:.1f}, {hole.centre[1]:.1f})",
                f"a hole of {hole.diameter_mm:.1f} mm has no room beside the wall; it is left out",
                "hold the tail with tape there, or make the piece larger",
            )
        )
    return kept, findings


def _bottom(
    jig: str,
    prefix: str,
    frame: Frame,
    through: Sequence[_Opening],
    inlays: Sequence[Inlay],
    config: PlateConfig,
) -> LaserPart:
    """The floor: each wall's number stands where its pocket comes to lie."""
    numbers = [
        stroke
        for inlay in inlays
        for stroke in label_on(inlay.wall, f"{prefix}{inlay.number}", least_mm=1.0, force=True)
    ]
    return LaserPart(
        label=f"{prefix}B",
        role="bottom",
        jig=jig,
        shape=Region(frame.outline(), tuple(map(_rim, through))),
        thickness_mm=config.sheet,
        contours=(
            *engraved_text(f"{prefix}B", frame.label_place, LABEL_MM),
            *numbers,
            *_cuts(through),
            Contour("CUT_OUTER", frame.outline(config.kerf / 2).edges),
        ),
    )


def _pocket_plates(
    jig: str,
    prefix: str,
    frame: Frame,
    through: Sequence[_Opening],
    inlays: Sequence[Inlay],
    wires: Sequence[Wire],
    numbers: Sequence[Contour],
    config: PlateConfig,
) -> list[LaserPart]:
    """The plate around all pockets, and an island for each hole of a ring-shaped wall."""
    fields = [(frame.outline(), frame.outline(config.kerf / 2))]
    for inlay in inlays:
        cores = map(reversed_loop, inlay.pocket.holes)
        fields += zip(cores, inlay.island_cuts, strict=True)
    areas = [polygon_of(Region(finished)) for finished, _ in fields]
    inside: list[list[Inlay | _Opening]] = [[] for _ in fields]
    features_of_all: tuple[Inlay | _Opening, ...] = (*inlays, *through)
    for feature in features_of_all:
        point = (
            polygon_of(feature.wall).representative_point().coords[0]
            if isinstance(feature, Inlay)
            else feature.hole.centre
        )
        inside[_innermost(areas, point)].append(feature)
    parts = []
    for index, ((finished, cut), features) in enumerate(zip(fields, inside, strict=True)):
        pockets = [feature for feature in features if isinstance(feature, Inlay)]
        holes = [feature for feature in features if isinstance(feature, _Opening)]
        outlines = [reversed_loop(inlay.pocket.outer) for inlay in pockets]
        shape = Region(finished, (*outlines, *map(_rim, holes)))
        label = f"{prefix}P{index or ''}"
        engraving = list(engraved_wires(wires, shape))
        if index == 0:
            engraving += engraved_text(label, frame.label_place, LABEL_MM)
            engraving += numbers
        else:
            engraving += label_on(shape, label, least_mm=1.0, force=True)
        cuts = [Contour("CUT_INNER", reversed_loop(inlay.pocket_cut).edges) for inlay in pockets]
        parts.append(
            LaserPart(
                label,
                "island" if index else "pocket plate",
                jig,
                shape,
                config.sheet,
                (*engraving, *cuts, *_cuts(holes), Contour("CUT_OUTER", cut.edges)),
            )
        )
    return parts


def _innermost(areas: Sequence[Polygon], point: Sequence[float]) -> int:
    from shapely import Point

    around = [index for index, area in enumerate(areas) if area.contains(Point(*point))]
    return min(around, key=lambda index: areas[index].area, default=0)


def _piece(jig: str, prefix: str, inlay: Inlay, copies: int, config: PlateConfig) -> LaserPart:
    """A wall piece, its number on it, or just below it in the waste if it is too small for that."""
    label = f"{prefix}{inlay.number}"
    engraving = label_on(inlay.wall, label, least_mm=1.2)
    if not engraving:
        low = inlay.wall.outer.sampled(0.05)
        foot = (float(low[:, 0].mean()), float(low[:, 1].min()) - config.kerf - 1.5)
        engraving = engraved_text(label, foot, 1.5)
    return LaserPart(
        label, "wall", jig, inlay.wall, config.wall_sheet, (*engraving, *inlay.piece_cuts), copies
    )


def _rim(opening: _Opening) -> Loop:
    return reversed_loop(oriented(Region(opening.hole.outline)).outer)


def _cuts(openings: Sequence[_Opening]) -> list[Contour]:
    return [Contour("CUT_INNER", reversed_loop(opening.cut).edges) for opening in openings]
