"""One command from a config to a folder of files."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Literal, get_args

from wrapit.config import Config, load_config, lock_text
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import DrawingError, Finding
from wrapit.jig.model import JigSet
from wrapit.pipeline import report as reports
from wrapit.pipeline.exporting import (
    write_alternatives,
    write_guide,
    write_plate,
    write_previews,
    write_text,
)
from wrapit.pipeline.folder import REPORT, artifacts_in, check_target, replaced_whole, sha256
from wrapit.pipeline.solids import PRELOAD, make_solids
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


@dataclass(frozen=True)
class Build:
    """What a build made; `folder` is None when nothing was written."""

    report: dict[str, Any]
    timings_s: dict[str, float]
    folder: Path | None
    up_to_date: bool = False


@dataclass
class _Work:
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


def build(
    config_path: Path,
    target: Path | None = None,
    overrides: Sequence[str] = (),
    until: Stage = "exports",
    force: bool = False,
    alternatives: int = 0,
    progress: Progress = lambda stage: None,
) -> Build:
    """Builds a piece into `target` (default `build/<name>`), unless what is there is already the same.

    With `alternatives`, so many of the best decompositions are also drawn side by side.

    Raises the WrapItError of the stage that fails; then the earlier content of the folder stays.
    """
    work = _start(config_path, overrides, until, progress, alternatives)
    target = target if target is not None else Path("build") / work.config.name
    check_target(target)
    if not force and (earlier := _same_build(target, work)) is not None:
        return Build(earlier, {}, target, up_to_date=True)
    with replaced_whole(target) as folder:
        _run(work, folder)
        work.report["artifacts"] = reports.artifact_list(artifacts_in(folder))
        work.report["findings"] = reports.findings_list(work.findings)
        (folder / REPORT).write_text(reports.to_json(work.report), encoding="utf-8")
    return Build(work.report, work.timings_s, target)


def check(config_path: Path, overrides: Sequence[str] = (), progress: Progress = lambda stage: None) -> Build:
    """Runs every stage up to the jig and writes nothing."""
    work = _start(config_path, overrides, "jig", progress)
    _run(work, None)
    work.report["findings"] = reports.findings_list(work.findings)
    return Build(work.report, work.timings_s, None)


def _start(
    config_path: Path, overrides: Sequence[str], until: Stage, progress: Progress, alternatives: int = 0
) -> _Work:
    config = load_config(config_path, overrides)
    drawing_path = config_path.parent / config.drawing
    if not drawing_path.is_file():
        raise DrawingError(
            "no such drawing" if not drawing_path.exists() else "the drawing is not a file",
            str(drawing_path),
            f"`drawing:` in {config_path.name} is relative to the config",
        )
    work = _Work(config, drawing_path, until, progress, alternatives)
    work.report.update(reports.head(config, sha256(drawing_path)), until=until, alternatives=alternatives)
    return work


def _same_build(target: Path, work: _Work) -> dict[str, Any] | None:
    """The report of an earlier build of the same input, if every file it names is still as written."""
    try:
        earlier = json.loads((target / REPORT).read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return None
    if any(earlier.get(key) != value for key, value in work.report.items()):
        return None
    whole = all(
        (path := target / artifact["path"]).is_file() and sha256(path) == artifact["sha256"]
        for artifact in earlier.get("artifacts", [])
    )
    return earlier if whole else None


def _run(work: _Work, folder: Path | None) -> None:
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


def _trace(work: _Work, folder: Path | None) -> None:
    with work.stage("drawing"):
        from wrapit.decomposition.bridges import with_bridges
        from wrapit.drawing.files import drawing_json
        from wrapit.drawing.stage import trace
        from wrapit.exports.drawing_svg import drawing_svg

        work.drawing, findings = trace(work.drawing_path, work.config.tracing, work.config.size)
        work.findings += findings
        shown = with_bridges(work.drawing) if work.config.decomposition.bridges else work.drawing
        work.report["drawing"] = reports.drawing_numbers(work.drawing, shown)
        if folder is not None:
            write_text(folder / "drawing.json", drawing_json(shown))
            write_text(folder / "drawing.svg", drawing_svg(shown))


def _decompose(work: _Work, folder: Path | None) -> None:
    assert work.drawing is not None
    with work.stage("decomposition"):
        from wrapit.decomposition.files import decomposition_json
        from wrapit.decomposition.graph import fewest_possible_wires, graph_of
        from wrapit.decomposition.stage import decompose

        work.solution, findings = decompose(work.drawing, work.config.decomposition)
        work.findings += findings
        fewest = fewest_possible_wires(graph_of(work.drawing))
        work.report["decomposition"] = reports.decomposition_numbers(work.solution, fewest)
        if folder is not None:
            write_text(folder / "decomposition.json", decomposition_json(work.solution))
            if work.alternatives:
                write_alternatives(folder, work.drawing, work.config, work.alternatives)


def _draw_wires(work: _Work, folder: Path | None) -> None:
    assert work.solution is not None
    with work.stage("wires"):
        from wrapit.exports.decomposition_svg import decomposition_svg
        from wrapit.wires.ring import jump_ring
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


def _laid(work: _Work) -> tuple[Wire, ...]:
    if work.config.jig.springback == "report":
        return work.wires
    from wrapit.wires.springback import overbend_wires

    bent, findings = overbend_wires(work.wires, work.config)
    work.findings += findings
    work.report["springback"] = reports.springback_numbers(bent)
    return tuple(each.wire for each in bent)


def _build_jig(work: _Work, worker: Worker, folder: Path | None) -> None:
    with work.stage("jig"):
        limit_s = 120 + 60 * len(work.wires)
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


def _build_mirrored_jig(work: _Work, worker: Worker, limit_s: float, folder: Path | None) -> None:
    from wrapit.jig.seats import mirrored_seats
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


def _export(work: _Work, folder: Path) -> None:
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
