"""One command from a config to a folder of files."""

from __future__ import annotations

import dataclasses
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wrapit.config import named_after
from wrapit.config.loading import load
from wrapit.errors import DrawingError, Finding, UnheldError
from wrapit.pipeline import report as reports
from wrapit.pipeline.cache.place import FOLDER, usual_store
from wrapit.pipeline.cache.remembering import UnreadableEntry
from wrapit.pipeline.output.folder import followed, prepare, put_in_place, renamed_beside_others, staged
from wrapit.pipeline.output.ownership import REPORT, artifacts_in, is_whole, own_report, sha256
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.textfile import write_text
from wrapit.pipeline.trying.offering import with_offers
from wrapit.pipeline.trying.remedies import what_would_do
from wrapit.pipeline.work import STAGES, AfterStage, Progress, Stage, Work
from wrapit.pipeline.worker import seldom_collected


@dataclass(frozen=True)
class Build:
    """What a build made; `folder` is None when nothing was written.

    `sources` are the files that it read, `asked` the stage that it was to reach; `up_to_date` says that the
    folder held it all already. `cached` are stages that made nothing anew, for all came from the cache.
    """

    report: dict[str, Any]
    timings_s: dict[str, float]
    folder: Path | None
    sources: tuple[Path, ...]
    asked: Stage
    up_to_date: bool = False
    cached: tuple[str, ...] = ()

    @property
    def timings(self) -> dict[str, Any]:
        """Seconds by stage, and as `cached` the stages that came from the cache."""
        return {**self.timings_s, "cached": list(self.cached)}


@seldom_collected()
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
    Files of somebody else stay as they are. With `force` all is made anew, whatever is there or in the cache.

    Raises the WrapItError of the stage that fails; then the earlier content of the folder stays.
    """
    work, sources = _start(config_path, overrides, until, progress, alternatives)
    work.after = after
    work.store = usual_store(reading=not force)
    target = target if target is not None else Path("build") / work.config.name
    folder = followed(target)
    prepare(folder)
    earlier = _earlier_build(folder, work)
    if earlier is not None:
        if not force and _covers(earlier, folder, work):
            return Build(earlier, {}, target, sources, until, up_to_date=True)
        work.until = max(work.until, earlier["until"], key=STAGES.index)
    with staged(folder) as partial:
        work = _run(work, partial)
        renamed, kept = renamed_beside_others(partial, folder)
        work.findings += kept
        work.report["until"] = work.until
        work.report["artifacts"] = reports.artifact_list(artifacts_in(partial, renamed))
        work.report["findings"] = reports.findings_list(work.findings)
        write_text(partial / REPORT, reports.to_json(work.report))
        put_in_place(partial, folder)
    return _built(work, target, sources, until)


@seldom_collected()
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
    work.store = usual_store()
    with tempfile.TemporaryDirectory(prefix="wrapit-check-") as folder:
        work = _run(work, Path(folder))
    work.report["findings"] = reports.findings_list(work.findings)
    return _built(work, None, sources, "exports")


def _built(work: Work, folder: Path | None, sources: tuple[Path, ...], asked: Stage) -> Build:
    """What a build made. What `fit` would do and that nothing could be kept is told, but is no matter of
    the piece as it is: no file says it."""
    findings = with_offers(work)
    work.store.trim()
    if work.store.trouble:
        untold = Finding(
            "note",
            "cache",
            str(work.store.folder or FOLDER),
            f"nothing is kept there for the next build ({work.store.trouble})",
            "free space, or name another folder in WRAPIT_CACHE (`off` for none)",
        )
        findings = [*findings, untold]
    report = {**work.report, "findings": reports.findings_list(findings)}
    return Build(report, work.timings_s, folder, sources, asked, cached=tuple(work.cached))


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
    work = Work(config, drawing_path, until, progress, alternatives, drawing_sha256=sha256(drawing_path))
    work.report.update(reports.head(config, work.drawing_sha256), until=until, alternatives=alternatives)
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


def _run(work: Work, folder: Path) -> Work:
    """Runs the stages; returns the work that they filled."""
    unread = dataclasses.replace(
        work, findings=[*work.findings], report={**work.report}, timings_s={}, cached=[], outcomes={}
    )
    try:
        run_stages(work, folder)
    except UnreadableEntry:
        for path in folder.iterdir():
            path.unlink()
        unread.store = work.store.unread()
        run_stages(unread, folder)
        return unread
    except UnheldError as unheld:
        work.progress("looking for a size that would do")
        remedy = what_would_do(work.config, work.drawing_path)
        raise UnheldError(unheld.problem, work.config.name, remedy) from None
    return work


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
