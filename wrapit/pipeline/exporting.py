"""The files that need no kernel: pictures, flat drawings, the guide, choices."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from wrapit.config import Config
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.jig.made import Made
from wrapit.pipeline.textfile import write_text
from wrapit.wires.model import JumpRing, Wire

if TYPE_CHECKING:
    from wrapit.instructions.model import Guide

ALTERNATIVES = "alternatives.svg"
"""The picture of the best decompositions side by side."""


def write_views(folder: Path, wires: Sequence[Wire], made: Made, suffix: str = "") -> None:
    """`preview{suffix}.png`, `view{suffix}.png`: a jig with its wires from above and at an angle.

    Where one jig isn't all, each has its own beside the piece's preview. `wires` are as they are in the
    piece; in the jig they may be overbent.
    """
    from wrapit.exports.preview_png import write_preview
    from wrapit.exports.view_png import write_view

    for view in made.views:
        laid = wires if view.plate is None else view.wires
        write_preview(folder / f"{view.stem}{suffix}.png", laid, view.walls, view.plate, view.taut)
        if view.plate is not None and view.plate_mm > 0:
            write_view(folder / f"{view.stem.replace('preview', 'view', 1)}{suffix}.png", view)


def write_drawings(folder: Path, made: Made, config: Config) -> None:
    """`plate.dxf`, `plate.svg` and so on: a jig's flat drawings."""
    from wrapit.exports.flat_files import write_flat_files

    for drawing in made.drawings:
        write_flat_files(folder, drawing, config.plate, config.outputs)


def write_guide(
    folder: Path,
    solution: Solution,
    wires: Sequence[Wire],
    jigs: Sequence[Made],
    mirrored: Made | None,
    ring: JumpRing | None,
    config: Config,
) -> tuple[Guide, tuple[Finding, ...]]:
    """`guide.html`, `guide.pdf`, and what they tell.

    The steps are of the first jig that holds wires, and of its mirror image.
    """
    from wrapit.instructions.plan import Held, plan_guide
    from wrapit.instructions.stage import write_page, write_print
    from wrapit.jig.bench.mirrored_bench import mirrored_handling

    first = next((made for made in jigs if made.handling is not None), jigs[0])
    held, other = Held(first.handling, first.findings), None
    if mirrored is not None and first.block == mirrored.block:
        other = Held(mirrored.handling, mirrored.findings)
    elif config.pair:
        other = Held(held.handling and mirrored_handling(held.handling), held.findings)
    guide = plan_guide(
        wires,
        config.guide,
        config.wire,
        name=config.name,
        held=held,
        other=other,
        pages=[made.page for made in jigs if made.page is not None],
        ring=ring,
        bridges=frozenset(solution.bridges_used),
    )
    if "html" in config.outputs:
        write_text(folder / "guide.html", write_page(guide, config.guide))
    if "pdf" not in config.outputs:
        return guide, ()
    printed, findings = write_print(guide, config.guide)
    (folder / "guide.pdf").write_bytes(printed)
    return guide, findings


def write_alternatives(folder: Path, drawing: Drawing, config: Config, count: int) -> None:
    """`alternatives.svg`: the best decompositions side by side."""
    from wrapit.decomposition.stage import alternatives
    from wrapit.exports.alternatives_svg import alternatives_svg
    from wrapit.wires.stage import draw_wires

    choices = alternatives(drawing, config.decomposition, count)
    shown = [(choice, draw_wires(choice, config)[0]) for choice in choices]
    write_text(folder / ALTERNATIVES, alternatives_svg(shown))
