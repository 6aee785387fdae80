"""The stages of a build, one after the other; the kernel's work in a process of its own beside them.

A stage takes steps (`reads` says what each depends on). A step is a function that returns an `Outcome`, and
it isn't called where the cache holds what it would return.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from wrapit.config import lock_text
from wrapit.pipeline.cache.remembering import Outcome
from wrapit.pipeline.cache.store import Store
from wrapit.pipeline.exporting import write_alternatives, write_fewer_wires, write_guide, write_sketch
from wrapit.pipeline.jigs import (
    begin_wires,
    each_beside,
    jig_key,
    jig_step,
    kinds_of,
    make_jigs,
    mirrored_key,
    show_jig,
    wires_key,
)
from wrapit.pipeline.output.ownership import sha256
from wrapit.pipeline.reads import takes_fit
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import OnCall, Worker


def run_stages(work: Work, folder: Path | None) -> None:
    """Runs the stages that are asked for; their files go to `folder`, unless there is none.

    Raises the WrapItError of the stage that fails, UnreadableEntry where the cache holds what can't be read.
    """
    with OnCall(_worker, work.config.name, work.config.jig.time_limit) as kernel:
        if _needs_kernel(work, files=folder is not None):
            kernel.worker()  # it loads while other stages run
        _trace(work, folder)
        if work.reaches("decomposition"):
            _decompose(work, folder)
        if work.reaches("wires"):
            _draw_wires(work, folder)
        files = folder if work.reaches("exports") else None
        # Solids of wires are made while jigs are planned: they hang on nothing that is.
        finish_wires = begin_wires(work, kernel, files) if files is not None else None
        if work.reaches("jig"):
            make_jigs(work, kernel, files)
        if files is not None and finish_wires is not None:
            _export(work, kernel, files, finish_wires)
    if folder is not None:
        write_text(folder / "config.lock.yaml", lock_text(work.config))


def _worker() -> Worker:
    from wrapit.pipeline.solids import PRELOAD

    return Worker(PRELOAD)


def _needs_kernel(work: Work, *, files: bool) -> bool:
    """Whether solids will be made that the cache doesn't hold: those of a jig, or the wires' own."""
    if not work.reaches("jig"):
        return False
    files = files and work.reaches("exports")
    sides = ((False, True) if work.config.pair else (False,)) if "step" in work.config.outputs else ()
    if files and not all(work.store.has(wires_key(work, mirror=mirror)) for mirror in sides):
        return True
    missing = [kind for kind in kinds_of(work) if not work.store.has(jig_key(work, kind, files=files))]
    if work.config.pair and not work.store.has(mirrored_key(work, files=files)):
        missing = list(kinds_of(work))
    if not missing:
        return False
    from wrapit.jig.kinds import JIGS

    return any(JIGS[kind].solid for kind in missing)


def _trace(work: Work, folder: Path | None) -> None:
    def traced() -> Outcome:
        from wrapit.drawing.stage import trace

        drawing, findings = trace(work.drawing_path, work.config.reading, work.config.size)
        if sha256(work.drawing_path) != work.drawing_sha256:
            work.store = Store()  # somebody saved it meanwhile: this is the drawing of no key
        return Outcome(drawing, findings=findings)

    def made_fit() -> Outcome:
        from wrapit.fit.stage import make_fit
        from wrapit.pipeline.report import fit_numbers

        assert work.drawing is not None
        fitted, findings = make_fit(work.drawing, work.config)
        return Outcome(fitted, {"fit": fit_numbers(fitted, work.config.fit)}, findings)

    def drawn() -> Outcome:
        from wrapit.decomposition.bridges import with_bridges
        from wrapit.drawing.json_file import drawing_json
        from wrapit.exports.drawing_svg import drawing_svg
        from wrapit.pipeline.report import drawing_numbers

        assert work.drawing is not None
        shown = with_bridges(work.drawing) if work.config.decomposition.bridges else work.drawing
        files = {}
        if folder is not None:
            files = {"drawing.json": drawing_json(shown), "drawing.svg": drawing_svg(shown, work.fitted)}
            for name, text in files.items():
                write_text(folder / name, text)
        return Outcome(None, {"drawing": drawing_numbers(work.drawing, shown)}, files=tuple(files))

    with work.stage("drawing"):
        work.take("trace", work.remember(work.key("trace"), traced, None))
        if takes_fit(work.config):
            work.take("fit", work.remember(work.key("fit"), made_fit, None))
        work.take("drawing", work.remember(work.key("drawing", folder is not None), drawn, folder))


def _decompose(work: Work, folder: Path | None) -> None:
    def decomposed() -> Outcome:
        from wrapit.decomposition.graph import fewest_possible_wires, graph_of
        from wrapit.decomposition.json_file import decomposition_json
        from wrapit.decomposition.stage import decompose
        from wrapit.pipeline.report import decomposition_numbers
        from wrapit.wires.beside.side_by_side import room_of

        assert work.drawing is not None
        solution, findings = decompose(work.drawing, work.config.decomposition, room_of(work.config))
        numbers = decomposition_numbers(solution, fewest_possible_wires(graph_of(work.drawing)))
        if folder is not None:
            write_text(folder / "decomposition.json", decomposition_json(solution))
        files = ("decomposition.json",) if folder is not None else ()
        return Outcome(solution, {"decomposition": numbers}, findings, files)

    with work.stage("decomposition"):
        key = work.key("decomposition", folder is not None)
        work.take("decomposition", work.remember(key, decomposed, folder))
        if folder is not None and not work.reaches("wires"):
            work.remember(work.key("sketch"), lambda: write_sketch(work, folder), folder)
        if folder is not None and work.alternatives:
            key = work.key("alternatives", work.alternatives)
            work.remember(key, lambda: write_alternatives(work, folder), folder)
            key = work.key("fewer wires")
            work.take("fewer wires", work.remember(key, lambda: write_fewer_wires(work, folder), folder))


def _draw_wires(work: Work, folder: Path | None) -> None:
    def drawn() -> Outcome:
        from wrapit.exports.decomposition_svg import decomposition_svg
        from wrapit.pipeline.report import bail_numbers, wire_numbers
        from wrapit.wires.jump_ring import jump_ring
        from wrapit.wires.stage import draw_wires

        assert work.solution is not None
        wires, findings = draw_wires(work.solution, work.config, work.beads)
        blocks: dict[str, Any] = {"wires": wire_numbers(wires)}
        ring, placed = jump_ring(wires, work.solution.decomposition.drawing, work.config)
        if work.config.bail is not None:
            blocks["bail"] = bail_numbers(wires, ring)
        if folder is not None:
            write_text(folder / "decomposition.svg", decomposition_svg(work.solution, wires))
        files = ("decomposition.svg",) if folder is not None else ()
        return Outcome((wires, ring), blocks, (*findings, *placed), files)

    def laid() -> Outcome:
        from wrapit.jig.overbending import overbend_wires
        from wrapit.pipeline.report import springback_numbers

        bent, findings = overbend_wires(work.wires, work.config)
        return Outcome(tuple(each.wire for each in bent), {"springback": springback_numbers(bent)}, findings)

    with work.stage("wires"):
        work.take("wires", work.remember(work.key("wires", folder is not None), drawn, folder))
        if work.config.jig.springback == "compensate":
            work.take("laid", work.remember(work.key("laid"), laid, None))


def _export(work: Work, kernel: OnCall, folder: Path, finish_wires: Callable[[], None]) -> None:
    with work.stage("exports"):
        show_jig(work, folder)
        if {"html", "pdf"} & set(work.config.outputs):
            key = work.key("guide", upon=map(jig_step, kinds_of(work)))
            each = each_beside(work, kernel, "guide")
            work.take("guide", work.remember(key, lambda: write_guide(work, folder, each), folder))
        finish_wires()
        if work.has_mirrored:
            finish_mirrored = begin_wires(work, kernel, folder, mirror=True)
            show_jig(work, folder, mirror=True)
            finish_mirrored()
