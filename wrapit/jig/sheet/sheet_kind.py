"""The laser-cut jig as a kind: flat drawings, their numbers, and the page on how to glue it."""

from __future__ import annotations

from typing import Final

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.jig.bench.model import Bench, Handling
from wrapit.jig.bench.touching import bench_of
from wrapit.jig.channel import Channels
from wrapit.jig.made import Each, JigMaker, Made, View, Wires, one_by_one
from wrapit.jig.sheet.drawings import sheet_drawings, sheet_name
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


def make(wires: Wires, config: Config, each: Each = one_by_one) -> Made:
    """The laser-cut jig of a piece; see `JigMaker`."""
    from wrapit.jig.sheet.gluing_page import gluing_page
    from wrapit.jig.sheet.stage import build_laser_jig

    laser, findings = build_laser_jig(wires, config.jig, config.plate, each)
    said = [*findings]
    if config.pair:
        said.insert(0, ONE_PLATE)
    if config.jig.seats or any(wire.beads for wire in wires):
        said.append(SEATS_PRINTED)
    return Made(
        block="plate",
        numbers=plate_numbers(laser),
        findings=tuple(said),
        drawings=sheet_drawings(laser),
        views=_views(laser, wires),
        handling=_handling(laser, config),
        page=gluing_page(laser, _files(laser, config), pair=config.pair),
    )


def held(wires: Wires, config: Config) -> float:
    """The share of the wires that walls cut from sheet would hold."""
    from wrapit.jig.sheet.stage import plan_stacks

    plans, _, _ = plan_stacks(wires, config.jig, config.plate)
    return held_share(one for plan in plans.values() for one in plan.held)


def _files(laser: LaserJig, config: Config) -> dict[int, tuple[str, ...]]:
    """Of each sheet by its number, the files that a laser takes."""
    kinds = [kind for kind in ("dxf", "svg") if kind in config.outputs]
    return {sheet.number: tuple(f"{sheet_name(sheet)}.{kind}" for kind in kinds) for sheet in laser.sheets}


def _handling(laser: LaserJig, config: Config) -> Handling:
    """What lies where in each stack, for the guide's steps."""
    return Handling(tuple(_bench(laser, name, config) for name in laser.laid), laser.forms)


def _bench(laser: LaserJig, name: str, config: Config) -> Bench:
    wires = laser.laid[name]
    parts = [part for part in laser.parts if part.jig == name]
    return bench_of(
        name,
        wires,
        [part.shape for part in parts if part.role == "wall"],
        next(part for part in parts if part.role == "bottom").shape,
        [pin for pin in laser.pins if pin.turn.wire in {wire.name for wire in wires}],
        Channels.of(wires, config.jig).reach_mm,
    )


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
