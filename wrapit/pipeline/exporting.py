"""The files that need no kernel: pictures, the laser-cut jig, the guide, choices."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from wrapit.config import Config
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.jig.model import JigSet
from wrapit.jig.sheet.model import LaserJig
from wrapit.pipeline.textfile import write_text
from wrapit.wires.model import JumpRing, Wire


def write_previews(
    folder: Path, wires: Sequence[Wire], laid: Sequence[Wire], jigs: JigSet, suffix: str = ""
) -> None:
    """`preview{suffix}.png`: the jig with the wires laid in; the piece and each jig where one isn't all.

    `laid` are the wires as they lie in the jig, overbent perhaps; `wires` as they are in the piece.
    """
    from wrapit.exports.preview_png import write_preview

    first = jigs.jigs[0]
    if len(first.wires) == len(laid):
        write_preview(folder / f"preview{suffix}.png", laid, first.walls, first.plate)
        return
    write_preview(folder / f"preview{suffix}.png", wires)
    for jig in jigs.jigs:
        mine = [wire for wire in laid if wire.name in jig.wires]
        write_preview(folder / f"preview-{jig.name}{suffix}.png", mine, jig.walls, jig.plate)


def write_plate(
    folder: Path, wires: Sequence[Wire], jigs: JigSet, config: Config
) -> tuple[LaserJig, tuple[Finding, ...]]:
    """`plate.dxf`, `plate.svg`: the laser-cut jig."""
    from wrapit.exports.plate_files import write_plate_files
    from wrapit.jig.sheet.stage import build_laser_jig

    laser, findings = build_laser_jig(wires, jigs, config.jig, config.plate)
    write_plate_files(folder, laser, config.plate)
    return laser, findings


def write_guide(
    folder: Path,
    solution: Solution,
    wires: Sequence[Wire],
    jigs: JigSet,
    laser: LaserJig | None,
    ring: JumpRing | None,
    config: Config,
) -> None:
    """`guide.html`."""
    from wrapit.instructions.stage import write_instructions

    page = write_instructions(
        solution, wires, config.guide, config.wire, name=config.name, jigset=jigs, laser=laser, ring=ring
    )
    write_text(folder / "guide.html", page)


def write_alternatives(folder: Path, drawing: Drawing, config: Config, count: int) -> None:
    """`alternatives.svg`: the best decompositions side by side."""
    from wrapit.decomposition.stage import alternatives
    from wrapit.exports.alternatives_svg import alternatives_svg
    from wrapit.wires.stage import draw_wires

    choices = alternatives(drawing, config.decomposition, count)
    shown = [(choice, draw_wires(choice, config)[0]) for choice in choices]
    write_text(folder / "alternatives.svg", alternatives_svg(shown))
