"""The stages of a build, one after the other; the kernel's work in a process of its own beside them."""

from __future__ import annotations

import contextlib
import dataclasses
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Literal, get_args

from wrapit.config import Config, lock_text
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.jig.model import JigSet
from wrapit.pipeline import report as reports
from wrapit.pipeline.exporting import (
    write_alternatives,
    write_guide,
    write_plate,
    write_previews,
)
from wrapit.pipeline.solids import PRELOAD, make_solids
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.worker import Worker
from wrapit.wires.model import JumpRing, Wire

Stage = Literal["drawing", "decomposition", "wires", "jig", "exports"]
STAGES: Final[tuple[Stage, ...]] = get_args(Stage)
Progress = Callable[[str], None]
MIRRORED: Final = "-mirrored"
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


@dataclass
class Work:
    """What the stages have made so far."""

    config: Config
    drawing_path: Path
    until: Stage
    progress: Progress
    alternatives: int
    timings_s: dict[str, float] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    drawing: Drawing | None = None
    solution: Solution | None = None
    wires: tuple[Wire, ...] = ()
    laid: tuple[Wire, ...] = ()
    """The wires as they lie in the jig: bent further than drawn where it makes up for springback."""

    ring: JumpRing | None = None
    jigs: JigSet | None = None
    report: dict[str, Any] = field(default_factory=dict)

    @contextlib.contextmanager
    def stage(self, name: str) -> Iterator[None]:
        self.progress(name)
        start = time.perf_counter()
        yield
        self.timings_s[name] = round(time.perf_counter() - start, 4)

    def reaches(self, stage: Stage) -> bool:
        return STAGES.index(self.until) >= STAGES.index(stage)


def run_stages(work: Work, folder: Path | None) -> None:
    """Runs the stages that are asked for; their files go to `folder`, unless there is none.

    Raises the WrapItError of the stage that fails.
    """
    with contextlib.ExitStack() as stack:
        worker = stack.enter_context(Worker(PRELOAD)) if work.reaches("jig") else None
        _trace(work, folder)
        if work.reaches("decomposition"):
            _decompose(work, folder)
        if work.reaches("wires"):
            _draw_wires(work, folder)
        if worker is not None:
            _build_jig(work, worker, folder)
    if work.reaches("exports") and folder is not None:
        _export(work, folder)
    if folder is not None:
        write_text(folder / "config.lock.yaml", lock_text(work.config))


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
    from wrapit.wires.springback import overbend_wires

    bent, findings = overbend_wires(work.wires, work.config)
    work.findings += findings
    work.report["springback"] = reports.springback_numbers(bent)
    return tuple(each.wire for each in bent)


def _build_jig(work: Work, worker: Worker, folder: Path | None) -> None:
    with work.stage("jig"):
        limit_s = work.config.jig.time_limit or 120 + 60 * len(work.wires)
        files = folder if work.reaches("exports") else None
        work.jigs, findings = worker.run(
            f"{work.config.name}: jig",
            limit_s,
            make_solids,
            work.wires,
            work.laid,
            work.ring,
            work.config,
            files,
        )
        work.findings += findings
        work.report["jig"] = reports.jig_numbers(work.jigs, work.laid)
        if work.config.pair:
            _build_mirrored_jig(work, worker, limit_s, files)


def _build_mirrored_jig(work: Work, worker: Worker, limit_s: float, folder: Path | None) -> None:
    from wrapit.jig.printed.seats import mirrored_seats
    from wrapit.wires.mirror import mirrored, mirrored_ring

    wires, laid, ring = mirrored(work.wires), mirrored(work.laid), mirrored_ring(work.ring)
    config = work.config.model_copy(update={"jig": mirrored_seats(work.config.jig)})
    where = f"{config.name}: mirrored jig"
    jigs, findings = worker.run(where, limit_s, make_solids, wires, laid, ring, config, folder, MIRRORED)
    work.findings += [dataclasses.replace(f, where=f"mirrored: {f.where}") for f in findings]
    work.report["jig"]["mirrored"] = reports.jig_numbers(jigs, laid)
    if folder is not None:
        write_previews(folder, wires, laid, jigs, MIRRORED)
        if "dxf" in work.config.outputs:
            work.findings.append(ONE_PLATE)


def _export(work: Work, folder: Path) -> None:
    assert work.solution is not None
    assert work.jigs is not None
    config, laser = work.config, None
    with work.stage("exports"):
        write_previews(folder, work.wires, work.laid, work.jigs)
        if "dxf" in config.outputs:
            laser, findings = write_plate(folder, work.laid, work.jigs, config)
            work.findings += findings
            if config.jig.seats:
                work.findings.append(SEATS_PRINTED)
            work.report["plate"] = reports.plate_numbers(laser)
        if "guide" in config.outputs:
            write_guide(folder, work.solution, work.wires, work.jigs, laser, work.ring, config)
