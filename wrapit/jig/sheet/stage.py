"""Builds the laser-cut jig: walls wide enough for sheet, the inlay's parts, their sheets, the checks."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.geometry.outlines.loops import circle
from wrapit.geometry.outlines.offsets import offset_region
from wrapit.jig.channel import Channels
from wrapit.jig.findings import form_findings, stray_findings
from wrapit.jig.made import Each, one_by_one
from wrapit.jig.model import Course, Hold, Hole, Pin, SameShape, TurnSupport, Wall, straying
from wrapit.jig.openings.holes import hole_rims, start_holes
from wrapit.jig.openings.pins import pin_discs, pin_holes
from wrapit.jig.paired.no_room import bead_findings
from wrapit.jig.parting.grouping import parted
from wrapit.jig.sheet.checks import LEAST_WEB_MM, THIN_WEB_MM, check_sheets
from wrapit.jig.sheet.handles import FRONT_MM, joined, small_pieces, with_handles
from wrapit.jig.sheet.model import LaserJig, LaserPart
from wrapit.jig.sheet.nesting import nest
from wrapit.jig.sheet.parts import copies_needed, stack_parts
from wrapit.jig.sheet.shops import check_shop
from wrapit.jig.support import really_held, refuse_unheld, turn_support
from wrapit.jig.wall_face import plain_finding, wall_face
from wrapit.jig.walls_and_pins import standing_walls
from wrapit.jig.wrapping.hemmed import hemmed_findings
from wrapit.jig.wrapping.needs import planned_walls
from wrapit.jig.wrapping.passage import passage
from wrapit.wires.model import Turn, Wire

# Sheet between a start hole and the pocket beside it, in the finished plate: the narrowest web of most pieces
# (leaf: 1.20 mm; with 0.84 it is 0.84, and the butterfly's walls have 1 % more area).
HOLE_WEB_MM = 1.2
# Sheet between two pockets that no wire parts: what doesn't break when the plate is lifted
# (`checks.LEAST_WEB_MM`), but never so much that a face along a wire would be cut back: FACE less than the
# channel's width. 30 % up or down changes nothing on leaf and butterfly.
WALL_WEB_MM = LEAST_WEB_MM
_FACE_MM = 0.05


def build_laser_jig(
    wires: tuple[Wire, ...], jig_config: JigConfig, config: PlateConfig, each: Each = one_by_one
) -> tuple[LaserJig, tuple[Finding, ...]]:
    """The laser-cut jig of these wires, in one stack or several where one would hold a wire badly.

    Raises JigError when there are no wires, UnheldError when walls cut from sheet would hold too little of
    them.
    """
    plans, forms, findings = plan_stacks(wires, jig_config, config, each)
    refuse_unheld((one for plan in plans.values() for one in plan.held), jig_config)
    laser, more = laser_jig(plans, forms, jig_config, config, each)
    return laser, (*findings, *more)


def plan_stacks(
    wires: tuple[Wire, ...], jig_config: JigConfig, config: PlateConfig, each: Each = one_by_one
) -> tuple[dict[str, LaserPlan], tuple[SameShape, ...], tuple[Finding, ...]]:
    """The plan of each stack, by its name; wires that another's serves; what the maker should know.

    Which wires share a stack is decided with the widths of printed walls: a piece that is made in both ways
    has the same wires in each. Raises JigError when there are no wires.
    """
    if not wires:
        raise JigError("there are no wires to make a jig for")
    parting = parted(wires, jig_config, lambda mine, name, others: _Grouped.of(mine, name, jig_config))
    findings = [*bead_findings(wires), *parting.findings, *form_findings(parting.forms)]
    plan = functools.partial(plan_stack, jig_config=jig_config, config=config)
    planned = each(plan, [group.wires for group in parting.jigs])
    plans = {group.name: plan for group, (plan, _) in zip(parting.jigs, planned, strict=True)}
    findings += (finding for _, more in planned for finding in more)
    return plans, parting.forms, tuple(findings)


def laser_jig(
    plans: Mapping[str, LaserPlan],
    forms: tuple[SameShape, ...],
    jig_config: JigConfig,
    config: PlateConfig,
    each: Each = one_by_one,
) -> tuple[LaserJig, tuple[Finding, ...]]:
    """The parts of planned stacks, laid out on sheets and measured.

    Findings name walls that can't be cut, webs and cuts that are too near, and parts larger than the sheet.
    """
    parts: list[LaserPart] = []
    findings: list[Finding] = []
    for number, (name, plan) in enumerate(plans.items(), start=1):
        prefix = f"{number}." if len(plans) > 1 else ""
        holes = (*plan.holes, *(_hole_for(pin) for pin in plan.pins))
        stack, faults = stack_parts(
            name, prefix, plan.wires, plan.walls, holes, jig_config, config, offset_region, each
        )
        parts += stack
        findings += [*faults, *small_pieces(name, stack, config.handle)]
    sheets, unfit = nest(parts, config)
    checks, faults = check_sheets(parts, sheets, config.kerf)
    copies = max(
        copies_needed(wire.layers, wire.diameter_mm, config) for plan in plans.values() for wire in plan.wires
    )
    jig_model = LaserJig(
        parts=tuple(parts),
        laid={name: plan.wires for name, plan in plans.items()},
        taut={name: straying(plan.laid) for name, plan in plans.items()},
        forms=forms,
        sheets=sheets,
        kerf_mm=config.kerf,
        fit_mm=config.fit,
        wall_height_mm=copies * config.wall_sheet - config.sheet,
        pins=tuple(pin for plan in plans.values() for pin in plan.pins),
        checks=checks,
    )
    return jig_model, (*findings, *_stacked(copies, config), *unfit, *faults, *check_shop(sheets, config))


@dataclass(frozen=True, eq=False)
class _Grouped:
    """Wires that may share a stack, and what walls as wide as printed ones would hold of each."""

    name: str
    wires: tuple[Wire, ...]
    how_well: dict[str, Hold]

    @staticmethod
    def of(wires: tuple[Wire, ...], name: str, config: JigConfig) -> _Grouped:
        return _Grouped(name, wires, standing_walls(wires, config).how_well)


@dataclass(frozen=True, eq=False)
class LaserPlan:
    """What one stack is made of: exact wall faces, start holes, pins in turns too tight for a wall.

    `held` is the support of each turn, pins counted; `laid` is how the wires lie in it under tension.
    """

    wires: tuple[Wire, ...]
    walls: tuple[Region, ...]
    holes: tuple[Hole, ...]
    pins: tuple[Pin, ...]
    held: tuple[TurnSupport, ...]
    laid: tuple[Course, ...]


def plan_stack(
    wires: tuple[Wire, ...], jig_config: JigConfig, config: PlateConfig
) -> tuple[LaserPlan, tuple[Finding, ...]]:
    """The plan of one stack, with a finding for each wire whose turns get neither wall nor pin.

    Walls keep away from holes so that a web stays between hole and pocket.
    """
    import shapely

    wide = jig_config.model_copy(
        update={"min_wall_width": config.min_wall_width, "min_wall_area": config.min_wall_area}
    )
    channels = Channels.of(wires, wide)
    holes = start_holes(channels, wide)
    rims = hole_rims(holes)
    clear = rims.buffer(HOLE_WEB_MM + config.fit, quad_segs=16)
    planned = planned_walls(channels, wide, clear)
    bare = shapely.union_all([polygon for polygon, _ in planned.polygons])
    pins = pin_holes(channels, wide, rims, bare)
    if pins:
        discs = pin_discs(pins)
        clear = shapely.union_all([rims, *discs]).buffer(HOLE_WEB_MM + config.fit, quad_segs=16)
        planned = planned_walls(channels, wide, clear, discs)
    openings = shapely.union_all([rims, *pin_discs(pins)]).buffer(THIN_WEB_MM + config.fit, quad_segs=16)
    kept = passage(channels, planned.held, wide).union(openings)
    room = channels.area.buffer(FRONT_MM).union(planned.room or shapely.Polygon())
    web_mm = THIN_WEB_MM + 2 * config.fit
    pieces = list(planned.polygons)
    if config.handle > 0:
        pieces = joined(pieces, kept.union(room), wide.min_wall_width, web_mm)
    least_mm = min(WALL_WEB_MM + 2 * config.fit, 2 * channels.reach_mm - _FACE_MM)
    apart = kept_apart([polygon for polygon, _ in pieces], least_mm)
    handy = with_handles(apart, kept, room, wide.min_wall_width, config.handle, web_mm)
    faces = tuple(
        wall_face(channels, Wall(turns, polygon, config.wall_sheet))
        for polygon, (_, turns) in zip(handy, pieces, strict=True)
    )
    walls = tuple(face.region for face in faces)
    held = really_held(turn_support(channels, walls), pins, planned.laid)
    loose = [finding for wire in wires if (finding := _unheld(wire, channels.turns, held)) is not None]
    plan = LaserPlan(wires, walls, holes, pins, held, planned.laid)
    wrapping = [*stray_findings(planned.laid), *hemmed_findings(channels, handy)]
    here = [dataclasses.replace(each, where=f"laser-cut jig, {each.where}") for each in wrapping]
    return plan, (*planned.findings, *plain_finding(faces, "laser-cut jig"), *loose, *here)


def kept_apart(polygons: Sequence[Any], least_mm: float) -> list[Any]:
    """The polygons, with the smaller of two that nearly touch cut back, so that a web stays between them.

    The distance is less than the width of a channel: faces along wires are never cut.
    """
    import shapely

    kept = list(polygons)
    if not kept:
        return kept
    pairs = shapely.STRtree(kept).query(kept, predicate="dwithin", distance=least_mm).T
    for first, second in sorted((int(a), int(b)) for a, b in pairs if a < b):
        small, large = sorted((first, second), key=lambda index: (kept[index].area, index))
        rest = kept[small].difference(kept[large].buffer(least_mm, quad_segs=16))
        kept[small] = max(shapely.get_parts(rest), key=lambda part: part.area, default=kept[small])
    return kept


def _unheld(wire: Wire, turns: Iterable[Turn], held: Iterable[TurnSupport]) -> Finding | None:
    mine = [turn for turn in turns if turn.wire == wire.name]
    loose = [one.turn for one in held if one.turn in mine and one.share == 0]
    if not loose:
        return None
    places = tuple((turn.start_mm + turn.end_mm) / 2 for turn in loose)
    return Finding(
        "warning",
        "turn-without-wall",
        f"{wire.name} at {', '.join(f'{at_mm:.0f}' for at_mm in places)} mm",
        f"{len(loose)} of {len(mine)} turns and stretches leave no room for a wall cut from sheet",
        "bend there by hand, make the piece larger, or print the jig",
        wire=wire.name,
        places_mm=places,
    )


def _hole_for(pin: Pin) -> Hole:
    return Hole(pin.centre, pin.diameter_mm, (pin.turn.wire,), circle(pin.centre, pin.diameter_mm / 2))


def _stacked(copies: int, config: PlateConfig) -> list[Finding]:
    if copies == 1:
        return []
    return [
        Finding(
            "note",
            "stacked-walls",
            "laser-cut jig",
            f"each wall is {copies} pieces of {config.wall_sheet:g} mm glued upon one another",
            "set plate.wall_sheet to a thicker sheet to need only one",
        )
    ]
