"""Laser-cut jigs of small pieces, and their files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from shapely import Polygon

from tests.exports.pieces_for_tests import eye, spiral, woven
from tests.jig.metal import arcs, wires_of
from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding
from wrapit.exports.flat_files import write_flat_files
from wrapit.geometry import Loop
from wrapit.jig.sheet.drawings import sheet_drawings
from wrapit.jig.sheet.model import LaserJig, LaserPart
from wrapit.jig.sheet.stage import laser_jig, plan_stack
from wrapit.wires.model import Wire
from wrapit.wires.turns import find_turns

JIG = JigConfig()


def hairpin() -> tuple[Wire, ...]:
    """A wire that turns back on a radius of 4 mm, wide enough for a wall of sheet, between legs of 25 mm."""
    return wires_of([arcs((0, 0), 0, (25, 0), (4, 180), (25, 0))])


PIECES: dict[str, Callable[[], tuple[Wire, ...]]] = {
    "eye": lambda: eye()[1],
    "hairpin": hairpin,
    "spiral": spiral,
    "woven": lambda: woven(4),
}


def write_plate(folder: Path, laser: LaserJig, config: PlateConfig) -> None:
    for drawing in sheet_drawings(laser):
        write_flat_files(folder, drawing, config, ("dxf", "svg"))


def laser_of(
    wires: tuple[Wire, ...], config: PlateConfig, jig: JigConfig = JIG, *, split: bool = False
) -> tuple[LaserJig, tuple[Finding, ...]]:
    """The jig of these wires, with the turns and stretches that its rule finds; a stack each if `split`."""
    wires = tuple(replace(wire, turns=find_turns(wire.name, wire.centreline, jig)[0]) for wire in wires)
    groups = [(wire.name,) for wire in wires] if split else [tuple(wire.name for wire in wires)]
    plans, findings = {}, []
    for names in groups:
        mine = tuple(wire for wire in wires if wire.name in names)
        plans[f"jig-{names[0]}"], more = plan_stack(mine, jig, config)
        findings += more
    laser, more = laser_jig(plans, (), jig, config)
    return laser, (*findings, *more)


def finished(part: LaserPart, kerf_mm: float) -> Polygon:
    """The part after cutting: the drawn cuts less half a kerf."""
    cuts = {layer: [c for c in part.contours if c.layer == layer] for layer in ("CUT_OUTER", "CUT_INNER")}
    (outer,) = cuts["CUT_OUTER"]
    drawn = Polygon(
        Loop(outer.edges).sampled(0.005), [Loop(c.edges).sampled(0.005) for c in cuts["CUT_INNER"]]
    )
    return drawn.buffer(-kerf_mm / 2, quad_segs=16).simplify(2e-4)
