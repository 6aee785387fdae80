"""The stages of a build, one after the other; the kernel's work in a process of its own beside them."""

from __future__ import annotations

import contextlib
from pathlib import Path

from wrapit.config import lock_text
from wrapit.jig.made import MIRRORED
from wrapit.pipeline import report as reports
from wrapit.pipeline.exporting import (
    write_alternatives,
    write_guide,
    write_views,
)
from wrapit.pipeline.jigs import make_jigs, wires_beside
from wrapit.pipeline.solids import PRELOAD
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import Worker
from wrapit.wires.mirror import mirrored
from wrapit.wires.model import Wire


def run_stages(work: Work, folder: Path | None) -> None:
    """Runs the stages that are asked for; their files go to `folder`, unless there is none.

    Raises the WrapItError of the stage that fails.
    """
    with contextlib.ExitStack() as stack:
        worker = stack.enter_context(Worker(PRELOAD)) if _needs_kernel(work) else None
        _trace(work, folder)
        if work.reaches("decomposition"):
            _decompose(work, folder)
        if work.reaches("wires"):
            _draw_wires(work, folder)
        if work.reaches("jig"):
            make_jigs(work, worker, folder if work.reaches("exports") else None)
        if work.reaches("exports") and folder is not None:
            _export(work, worker, folder)
    if folder is not None:
        write_text(folder / "config.lock.yaml", lock_text(work.config))


def _needs_kernel(work: Work) -> bool:
    """Whether solids are made: those of a jig, or the wires' own."""
    from wrapit.jig.kinds import JIGS

    solid = any(JIGS[kind].solid for kind in work.config.jigs)
    return (solid and work.reaches("jig")) or ("step" in work.config.outputs and work.reaches("exports"))


def _trace(work: Work, folder: Path | None) -> None:
    with work.stage("drawing"):
        from wrapit.decomposition.bridges import with_bridges
        from wrapit.drawing.json_file import drawing_json
        from wrapit.drawing.stage import trace
        from wrapit.exports.drawing_svg import drawing_svg

        work.drawing, findings = trace(work.drawing_path, work.config.tracing, work.config.size)
        work.findings += findings
        shown = with_bridges(work.drawing) if work.config.decomposition.bridges else work.drawing
        work.report["drawing"] = reports.drawing_numbers(work.drawing, shown)
        if folder is not None:
            write_text(folder / "drawing.json", drawing_json(shown))
            write_text(folder / "drawing.svg", drawing_svg(shown))


def _decompose(work: Work, folder: Path | None) -> None:
    assert work.drawing is not None
    with work.stage("decomposition"):
        from wrapit.decomposition.graph import fewest_possible_wires, graph_of
        from wrapit.decomposition.json_file import decomposition_json
        from wrapit.decomposition.stage import decompose
        from wrapit.exports.decomposition_svg import decomposition_svg
        from wrapit.wires.stage import draw_wires

        work.solution, findings = decompose(work.drawing, work.config.decomposition)
        work.findings += findings
        fewest = fewest_possible_wires(graph_of(work.drawing))
        work.report["decomposition"] = reports.decomposition_numbers(work.solution, fewest)
        if folder is not None:
            write_text(folder / "decomposition.json", decomposition_json(work.solution))
            if not work.reaches("wires"):
                wires, _ = draw_wires(work.solution, work.config)
                write_text(folder / "decomposition.svg", decomposition_svg(work.solution, wires))
            if work.alternatives:
                write_alternatives(folder, work.drawing, work.config, work.alternatives)


def _draw_wires(work: Work, folder: Path | None) -> None:
    assert work.solution is not None
    with work.stage("wires"):
        from wrapit.exports.decomposition_svg import decomposition_svg
        from wrapit.wires.jump_ring import jump_ring
        from wrapit.wires.stage import draw_wires

        work.wires, findings = draw_wires(work.solution, work.config)
        work.findings += findings
        work.report["wires"] = reports.wire_numbers(work.wires)
        work.laid = _laid(work)
        work.ring, placed = jump_ring(work.wires, work.solution.decomposition.drawing, work.config)
        work.findings += placed
        if work.config.bail is not None:
            work.report["bail"] = reports.bail_numbers(work.wires, work.ring)
        if folder is not None:
            write_text(folder / "decomposition.svg", decomposition_svg(work.solution, work.wires))


def _laid(work: Work) -> tuple[Wire, ...]:
    if work.config.jig.springback == "report":
        return work.wires
    from wrapit.jig.overbending import overbend_wires

    bent, findings = overbend_wires(work.wires, work.config)
    work.findings += findings
    work.report["springback"] = reports.springback_numbers(bent)
    return tuple(each.wire for each in bent)


def _export(work: Work, worker: Worker | None, folder: Path) -> None:
    assert work.solution is not None
    jigs = list(work.made.values())
    with work.stage("exports"):
        with wires_beside(work, worker, folder):
            write_views(folder, work.wires, jigs[0])
            if {"html", "pdf"} & set(work.config.outputs):
                guide, told = write_guide(
                    folder, work.solution, work.wires, jigs, work.mirrored, work.ring, work.config
                )
                work.report["guide"] = reports.guide_numbers(guide)
                work.findings += told
        if work.mirrored is not None:
            with wires_beside(work, worker, folder, MIRRORED):
                write_views(folder, mirrored(work.wires), work.mirrored, MIRRORED)
