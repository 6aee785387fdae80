"""The files that need no kernel: pictures, flat drawings, the guide, choices."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from wrapit.config import Config, GuideConfig
from wrapit.pipeline.cache.remembering import Outcome
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.work import Work

if TYPE_CHECKING:
    from wrapit.errors import Finding
    from wrapit.instructions.model import Guide
    from wrapit.jig.made import Each, Made, View, Wires

T = TypeVar("T")

ALTERNATIVES = "alternatives.svg"
"""The picture of the best decompositions side by side."""
FEWER_WIRES = "fewer-wires.svg"
"""That of the best for each number of wires."""


def write_views(folder: Path, views: Sequence[View], wires: Wires, suffix: str = "") -> Outcome:
    """`preview{suffix}.png`, `view{suffix}.png`: a jig with its wires from above and at an angle.

    Where one jig isn't all, each has its own beside the piece's preview. `wires` are as they are in the
    piece; in the jig they may be overbent.
    """
    from wrapit.exports.preview_png import write_preview
    from wrapit.exports.view_png import write_view

    files = []
    for view in views:
        files.append(f"{view.stem}{suffix}.png")
        laid = wires if view.plate is None else view.wires
        write_preview(folder / files[-1], laid, view.walls, view.plate, view.taut)
        if view.plate is not None and view.plate_mm > 0:
            files.append(f"{view.stem.replace('preview', 'view', 1)}{suffix}.png")
            write_view(folder / files[-1], view)
    return Outcome(files=files)


def write_drawings(folder: Path, made: Made, config: Config) -> tuple[str, ...]:
    """`plate.dxf`, `plate.svg` and so on: a jig's flat drawings; returns their names."""
    from wrapit.exports.flat_files import write_flat_files

    return tuple(
        path.name
        for drawing in made.drawings
        for path in write_flat_files(folder, drawing, config.plate, config.outputs)
    )


def write_guide(work: Work, folder: Path, each: Each) -> Outcome:
    """`guide.html`, `guide.pdf`, and what they tell.

    The steps are of the first jig that holds wires, and of its mirror image.
    """
    from wrapit.instructions.plan import Held, plan_guide
    from wrapit.jig.bench.mirrored_bench import mirrored_handling
    from wrapit.pipeline.report import guide_numbers

    assert work.solution is not None
    config, jigs, mirrored = work.config, list(work.made.values()), work.mirrored
    first = next((made for made in jigs if made.handling is not None), jigs[0])
    held, other = Held(first.handling, first.findings), None
    if mirrored is not None and first.block == mirrored.block:
        other = Held(mirrored.handling, mirrored.findings)
    elif config.pair:
        other = Held(held.handling and mirrored_handling(held.handling), held.findings)
    guide = plan_guide(
        work.wires,
        config.guide,
        config.wire,
        name=config.name,
        held=held,
        other=other,
        pages=[made.page for made in jigs if made.page is not None],
        ring=work.ring,
        bridges=frozenset(work.solution.bridges_used),
    )
    media = {"html": _write_page, "pdf": _write_print}
    telling = [
        functools.partial(write, guide, config.guide, folder / f"guide.{kind}")
        for kind, write in media.items()
        if kind in config.outputs
    ]
    said = each(_called, telling)
    return Outcome(
        blocks={"guide": guide_numbers(guide)},
        findings=[finding for findings in said for finding in findings],
        files=[f"guide.{kind}" for kind in media if kind in config.outputs],
    )


def _called(function: Callable[[], T]) -> T:
    return function()


def _write_page(guide: Guide, config: GuideConfig, path: Path) -> tuple[Finding, ...]:
    from wrapit.instructions.stage import write_page

    write_text(path, write_page(guide, config))
    return ()


def _write_print(guide: Guide, config: GuideConfig, path: Path) -> tuple[Finding, ...]:
    from wrapit.instructions.stage import write_print

    printed, findings = write_print(guide, config)
    path.write_bytes(printed)
    return findings


def write_sketch(work: Work, folder: Path) -> Outcome:
    """`decomposition.svg` of a build that ends there: wires as they would be."""
    from wrapit.exports.decomposition_svg import decomposition_svg
    from wrapit.wires.stage import draw_wires

    assert work.solution is not None
    wires, _ = draw_wires(work.solution, work.config, work.beads)
    write_text(folder / "decomposition.svg", decomposition_svg(work.solution, wires))
    return Outcome(files=("decomposition.svg",))


def write_alternatives(work: Work, folder: Path) -> Outcome:
    """`alternatives.svg`: the best decompositions side by side."""
    from wrapit.decomposition.stage import alternatives
    from wrapit.exports.alternatives_svg import alternatives_svg
    from wrapit.wires.beside.side_by_side import room_of
    from wrapit.wires.stage import draw_wires

    assert work.drawing is not None
    choices = alternatives(work.drawing, work.config.decomposition, work.alternatives, room_of(work.config))
    shown = [(choice, draw_wires(choice, work.config, work.beads)[0]) for choice in choices]
    write_text(folder / ALTERNATIVES, alternatives_svg(shown))
    return Outcome(files=(ALTERNATIVES,))


def write_fewer_wires(work: Work, folder: Path) -> Outcome:
    """`fewer-wires.svg`: the best decomposition for each number of wires, and what they cost."""
    from wrapit.decomposition.stage import front
    from wrapit.exports.alternatives_svg import fewer_wires_svg
    from wrapit.pipeline.report import fewer_wires_numbers, lengths_mm
    from wrapit.wires.beside.side_by_side import room_of
    from wrapit.wires.stage import draw_wires

    assert work.drawing is not None
    members = front(work.drawing, work.config.decomposition, room_of(work.config))
    shown = [(member, draw_wires(member, work.config, work.beads)[0]) for member in members]
    write_text(folder / FEWER_WIRES, fewer_wires_svg(shown))
    numbers = [
        numbers | {"lengths_mm": lengths_mm(wires)}
        for numbers, (_, wires) in zip(fewer_wires_numbers(members), shown, strict=True)
    ]
    return Outcome(blocks={"fewer_wires": numbers}, files=(FEWER_WIRES,))
