"""Builds the laser-cut jig: walls wide enough for sheet, the inlay's parts, their sheets, the checks."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass
from typing import Any

from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.geometry.outlines.loops import circle
from wrapit.geometry.outlines.offsets import offset_region
from wrapit.jig.channel import Course
from wrapit.jig.holes import hole_rims, start_holes
from wrapit.jig.model import Hole, JigSet, Pin, Wall
from wrapit.jig.pins import pin_holes
from wrapit.jig.sheet.checks import check_sheets
from wrapit.jig.sheet.model import LaserJig, LaserPart
from wrapit.jig.sheet.nesting import nest
from wrapit.jig.sheet.parts import copies_needed, stack_parts
from wrapit.jig.wall_face import plain_finding, wall_face
from wrapit.jig.wall_ground import wall_polygons
from wrapit.wires.model import Turn, Wire

# Sheet between a start hole and the pocket beside it, in the finished plate.
HOLE_WEB_MM = 1.2
# Sheet between two pockets that no wire parts.
WALL_WEB_MM = 0.8
_FACE_MM = 0.05


def build_laser_jig(
    wires: Sequence[Wire], jigset: JigSet, jig_config: JigConfig, config: PlateConfig
) -> tuple[LaserJig, tuple[Finding, ...]]:
    """The laser-cut jig, with as many stacks as the printed one has jigs (same wires in each).

    Walls are planned anew, as wide as sheet needs. Findings name walls that can't be cut, webs and cuts
    that are too near, and parts larger than the sheet. Raises JigError when there are no wires.
    """
    if not wires:
        raise JigError("there are no wires to make a jig for")
    parts: list[LaserPart] = []
    pins: list[Pin] = []
    findings: list[Finding] = []
    laid = {jig.name: tuple(wire for wire in wires if wire.name in jig.wires) for jig in jigset.jigs}
    for number, (name, mine) in enumerate(laid.items(), start=1):
        prefix = f"{number}." if len(jigset.jigs) > 1 else ""
        plan, more = plan_stack(mine, jig_config, config)
        holes = (*plan.holes, *(_hole_for(pin) for pin in plan.pins))
        stack, faults = stack_parts(name, prefix, mine, plan.walls, holes, jig_config, config, offset_region)
        parts += stack
        pins += plan.pins
        findings += [*more, *faults]
    sheets, unfit = nest(parts, config)
    checks, faults = check_sheets(parts, sheets, config.kerf)
    copies = max(copies_needed(wire.layers, wire.diameter_mm, config) for wire in wires)
    jig_model = LaserJig(
        parts=tuple(parts),
        laid=laid,
        sheets=sheets,
        kerf_mm=config.kerf,
        fit_mm=config.fit,
        wall_height_mm=copies * config.wall_sheet - config.sheet,
        pins=tuple(pins),
        checks=checks,
    )
    return jig_model, (*findings, *_stacked(copies, config), *unfit, *faults)


@dataclass(frozen=True, eq=False)
class LaserPlan:
    """What one stack is made of: exact wall faces, start holes, pins in turns too tight for a wall."""

    walls: tuple[Region, ...]
    holes: tuple[Hole, ...]
    pins: tuple[Pin, ...]


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
    course = Course.of(wires, wide)
    holes = start_holes(course, wide)
    rims = hole_rims(holes)
    bare, _ = wall_polygons(course, wide, rims.buffer(HOLE_WEB_MM + config.fit, quad_segs=16))
    pins = pin_holes(course, wide, rims, shapely.union_all([polygon for polygon, _ in bare]))
    discs = [shapely.Point(pin.centre).buffer(pin.diameter_mm / 2, quad_segs=32) for pin in pins]
    clear = shapely.union_all([rims, *discs]).buffer(HOLE_WEB_MM + config.fit, quad_segs=16)
    polygons, dropped = wall_polygons(course, wide, clear)
    least_mm = min(WALL_WEB_MM + 2 * config.fit, 2 * course.reach_mm - _FACE_MM)
    apart = kept_apart([polygon for polygon, _ in polygons], least_mm)
    faces = tuple(
        wall_face(course, Wall(turns, polygon, config.wall_sheet))
        for polygon, (_, turns) in zip(apart, polygons, strict=True)
    )
    held = {turn for _, turns in polygons for turn in turns} | {pin.turn for pin in pins}
    loose = [finding for wire in wires if (finding := _unheld(wire, held)) is not None]
    plan = LaserPlan(tuple(face.region for face in faces), holes, pins)
    return plan, (*dropped, *plain_finding(faces, "laser-cut jig"), *loose)


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


def _unheld(wire: Wire, held: Set[Turn]) -> Finding | None:
    loose = [turn for turn in wire.turns if turn not in held]
    if not loose:
        return None
    places = ", ".join(f"{(turn.start_mm + turn.end_mm) / 2:.0f}" for turn in loose)
    return Finding(
        "warning",
        "turn-without-wall",
        f"{wire.name} at {places} mm",
        f"{len(loose)} of {len(wire.turns)} turns and stretches leave no room for a wall cut from sheet",
        "bend there by hand, make the piece larger, or print the jig",
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
