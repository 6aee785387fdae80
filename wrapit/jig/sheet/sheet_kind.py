"""The laser-cut jig as a kind: flat drawings, their numbers, and the page on how to glue it."""

from __future__ import annotations

from typing import Final

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.jig.made import GuidePage, JigMaker, Made, View, Wires, handled_in
from wrapit.jig.sheet.model import LaserJig
from wrapit.jig.sheet.sheet_numbers import plate_numbers
from wrapit.jig.support import held_share

# What a laser-cut jig lacks of a printed one, said where it is asked for.
ONE_PLATE: Final = Finding(
    "note",
    "plate-of-one",
    "laser-cut jig",
    "the DXF is for one of the pair",
    "mirror it in the laser's program for the other one",
)
SEATS_PRINTED: Final = Finding(
    "note",
    "seats-in-print-only",
    "laser-cut jig",
    "only the printed jig has seats for beads and stones",
    "hold them by hand in the laser-cut one, or print the jig",
)


def make(wires: Wires, config: Config) -> Made:
    """The laser-cut jig of a piece; see `JigMaker`."""
    from wrapit.jig.sheet.drawings import sheet_drawings
    from wrapit.jig.sheet.gluing_page import plan_laser_page
    from wrapit.jig.sheet.stage import build_laser_jig

    laser, findings = build_laser_jig(wires, config.jig, config.plate)
    said = [*findings]
    if config.pair:
        said.insert(0, ONE_PLATE)
    if config.jig.seats:
        said.append(SEATS_PRINTED)
    return Made(
        block="plate",
        numbers=plate_numbers(laser),
        findings=tuple(said),
        drawings=sheet_drawings(laser),
        views=_views(laser, wires),
        handling=handled_in(
            {wire.name: name for name, mine in laser.laid.items() for wire in mine}, laser.forms
        ),
        page=GuidePage("laser", "Glue the laser-cut jig", "sheet/page.html.jinja", plan_laser_page(laser)),
    )


def held(wires: Wires, config: Config) -> float:
    """The share of the wires that walls cut from sheet would hold."""
    from wrapit.jig.sheet.stage import plan_stacks

    plans, _, _ = plan_stacks(wires, config.jig, config.plate)
    return held_share(one for plan in plans.values() for one in plan.held)


def _views(laser: LaserJig, wires: Wires) -> tuple[View, ...]:
    """The wires alone, then each stack with its own laid in."""
    views = [View("preview", wires)] if len(laser.laid) > 1 else []
    for name, mine in laser.laid.items():
        parts = [part for part in laser.parts if part.jig == name]
        walls = tuple(part.shape for part in parts if part.role == "wall")
        bottom, pockets = (
            next(part for part in parts if part.role == role) for role in ("bottom", "pocket plate")
        )
        views.append(
            View(
                "preview" if len(laser.laid) == 1 else f"preview-{name}",
                mine,
                walls,
                bottom.shape,
                laser.taut[name],
                heights_mm=(laser.wall_height_mm,) * len(walls),
                plate_mm=bottom.thickness_mm + pockets.thickness_mm,
            )
        )
    return tuple(views)


# The kind, as `jig.kinds` lists it.
SHEET: Final = JigMaker("sheet", solid=False, make=make, held=held)
