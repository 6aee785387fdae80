"""One command from a config to a folder of files."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wrapit.config import named_after
from wrapit.config.loading import load
from wrapit.errors import DrawingError, Finding, UnheldError
from wrapit.pipeline import report as reports
from wrapit.pipeline.output.folder import followed, prepare, put_in_place, renamed_beside_others, staged
from wrapit.pipeline.output.ownership import REPORT, artifacts_in, is_whole, own_report, sha256
from wrapit.pipeline.remedies import what_would_do
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.work import STAGES, AfterStage, Progress, Stage, Work


@dataclass(frozen=True)
class Build:
    """What a build made; `folder` is None when nothing was written.

    `sources` are the files that it read, `asked` the stage that it was to reach; `up_to_date` says that the
    folder held it all already.
    """

    report: dict[str, Any]
    timings_s: dict[str, float]
    folder: Path | None
    sources: tuple[Path, ...]
    asked: Stage
    up_to_date: bool = False


def build(
    config_path: Path | Sequence[Path],
    target: Path | None = None,
    overrides: Sequence[str] = (),
    until: Stage = "exports",
    force: bool = False,
    alternatives: int = 0,
    progress: Progress = lambda stage: None,
    after: AfterStage = lambda stage, work: None,
) -> Build:
    """Builds a piece into `target` (default `build/<name>`), unless what is there is already the same.

    Several configs are merged left to right.
    `progress` is told before each stage, `after` after it. With `alternatives`, so many of the best
    decompositions are also drawn side by side. A folder that holds a fuller build of the same input keeps it.
    Files of somebody else stay as they are.

    Raises the WrapItError of the stage that fails; then the earlier content of the folder stays.
    """
    work, sources = _start(config_path, overrides, until, progress, alternatives)
    work.after = after
    target = target if target is not None else Path("build") / work.config.name
    folder = followed(target)
    prepare(folder)
    earlier = _earlier_build(folder, work)
    if earlier is not None:
        if not force and _covers(earlier, folder, work):
            return Build(earlier, {}, target, sources, until, up_to_date=True)
        work.until = max(work.until, earlier["until"], key=STAGES.index)
    with staged(folder) as partial:
        _run(work, partial)
        renamed, kept = renamed_beside_others(partial, folder)
        work.findings += kept
        work.report["until"] = work.until
        work.report["artifacts"] = reports.artifact_list(artifacts_in(partial, renamed))
        work.report["findings"] = reports.findings_list(work.findings)
        write_text(partial / REPORT, reports.to_json(work.report))
        put_in_place(partial, folder)
    return Build(work.report, work.timings_s, target, sources, until)


def check(
    config_path: Path | Sequence[Path],
    overrides: Sequence[str] = (),
    progress: Progress = lambda stage: None,
    exact: bool = False,
) -> Build:
    """Builds a piece and throws the files away, so that it finds what a build would find.

    With `exact` the kernel also cuts the finished jig with each wire and each channel: the report's jig has
    `interference_mm3`, which is 0. Raises what `build` raises, KernelError where that is more than nothing.
    """
    work, sources = _start(config_path, overrides, "exports", progress)
    work.exact = exact
    with tempfile.TemporaryDirectory(prefix="wrapit-check-") as folder:
        _run(work, Path(folder))
    work.report["findings"] = reports.findings_list(work.findings)
    return Build(work.report, work.timings_s, None, sources, "exports")


def _start(
    config_path: Path | Sequence[Path],
    overrides: Sequence[str],
    until: Stage,
    progress: Progress,
    alternatives: int = 0,
) -> tuple[Work, tuple[Path, ...]]:
    """What there is before the first stage, and the files that it was read from."""
    loaded = load(config_path, overrides)
    config, drawing_path = loaded.config, loaded.drawing_path
    if not drawing_path.is_file():
        raise DrawingError(
            "no such drawing" if not drawing_path.exists() else "the drawing is not a file",
            str(drawing_path),
            f"`drawing:` in {loaded.named_by.name} is relative to the config",
        )
    work = Work(config, drawing_path, until, progress, alternatives)
    work.report.update(reports.head(config, sha256(drawing_path)), until=until, alternatives=alternatives)
    named, renamed = named_after(loaded.named_by)
    if renamed and named == config.name:
        work.findings.append(
            Finding(
                "warning",
                "renamed",
                "config",
                f"the config's file name can't be a folder's on every system, so it is called {named!r}",
                "give it a `name:`",
            )
        )
    return work, (*loaded.sources, drawing_path)


def _run(work: Work, folder: Path) -> None:
    try:
        run_stages(work, folder)
    except UnheldError as unheld:
        work.progress("looking for a size that would do")
        remedy = what_would_do(work.config, work.drawing_path)
        raise UnheldError(unheld.problem, work.config.name, remedy) from None


def _earlier_build(folder: Path, work: Work) -> dict[str, Any] | None:
    """The report of an earlier build of the same input."""
    earlier = own_report(folder)
    if earlier is None or earlier.get("until") not in STAGES:
        return None
    same = all(earlier.get(key) == work.report[key] for key in reports.HEAD_KEYS)
    return earlier if same else None


def _covers(earlier: dict[str, Any], folder: Path, work: Work) -> bool:
    """Whether an earlier build went as far as this one is to go, and all its files are still there."""
    reaches = STAGES.index(earlier["until"]) >= STAGES.index(work.until)
    choices = work.alternatives in (0, earlier.get("alternatives"))
    return reaches and choices and is_whole(folder, earlier)
