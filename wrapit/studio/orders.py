"""What the process beside the server does: builds, and looks for other wires; it tells of each step.

Every message is a dict of plain values. Here, and in what is imported here, heavy libraries are loaded; the
server only knows the name of this module.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from wrapit.config import Config, load_config
from wrapit.drawing.model import Drawing
from wrapit.errors import UnheldError
from wrapit.pipeline.build import Build, build
from wrapit.pipeline.output.ownership import REPORT, listed_files, sha256
from wrapit.pipeline.report import fewer_wires_numbers
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.work import STAGES, Stage, Work
from wrapit.studio.comparing import helped_by_fit
from wrapit.studio.showing import alternative_documents, placed, shown_after

Tell = Callable[[dict[str, Any]], None]


def build_piece(tell: Tell, config_path: Path, output: Path | None) -> None:
    """Builds as `wrapit build` does, and tells what a page shows after each stage and at the end.

    Raises what `build` raises.
    """
    seen: dict[str, Work] = {}

    def progress(stage: str) -> None:
        tell({"building": stage, "stages": list(STAGES)})

    def after(stage: str, work: Work) -> None:
        seen["work"] = work
        tell({"done": stage, **shown_after(stage, work)})

    try:
        result = build(config_path, output, progress=progress, after=after)
    except UnheldError as unheld:
        if "work" in seen:
            tell({"helped": helped_by_fit(seen["work"], {unheld.code})})
        raise
    if "work" not in seen or not seen["work"].wires:
        run_stages(_work(config_path, result.sources[1], "wires", progress, after), None)
    tell(_outcome(result, seen["work"]))
    codes = {each["code"] for each in result.report["findings"]}
    tell({"helped": helped_by_fit(seen["work"], codes)})


def find_alternatives(tell: Tell, config_path: Path, count: int) -> None:
    """Tells the best ways to divide the drawing into wires, so many of them.

    Raises what the stages raise.
    """
    from wrapit.decomposition.stage import alternatives
    from wrapit.wires.beside.side_by_side import room_of
    from wrapit.wires.stage import draw_wires

    config, drawing = _read(config_path)
    choices = alternatives(drawing, config.decomposition, count, room_of(config))
    shown = [(choice, draw_wires(choice, config)[0]) for choice in choices]
    tell({"found": alternative_documents(shown)})


def find_fewer_wires(tell: Tell, config_path: Path) -> None:
    """Tells what fewer wires cost, as the report does.

    Raises what the stages raise.
    """
    from wrapit.decomposition.stage import front
    from wrapit.wires.beside.side_by_side import room_of

    config, drawing = _read(config_path)
    tell({"found": fewer_wires_numbers(front(drawing, config.decomposition, room_of(config)))})


def _read(config_path: Path) -> tuple[Config, Drawing]:
    """The config, and the drawing that is divided."""
    config = load_config(config_path)
    seen: dict[str, Work] = {}
    work = _work(
        config_path,
        config_path.parent / config.drawing,
        "drawing",
        lambda stage: None,
        lambda stage, work: seen.update(work=work),
    )
    run_stages(work, None)
    assert work.drawing is not None, "the first stage traces it"
    return config, work.drawing


def _work(
    config_path: Path,
    drawing_path: Path,
    until: Stage,
    progress: Callable[[str], None],
    after: Callable[[str, Work], None],
) -> Work:
    return Work(load_config(config_path), drawing_path, until, progress, 0, after=after)


def _outcome(result: Build, work: Work) -> dict[str, Any]:
    assert result.folder is not None, "a build has a folder"
    folder = result.folder.resolve()
    files = {**listed_files(result.report), REPORT: sha256(folder / REPORT)}
    timings = result.timings_s or work.timings_s
    return {
        "folder": str(folder),
        "shown": {
            "report": result.report,
            "files": {name: digest[:12] for name, digest in sorted(files.items())},
            "stage": result.asked,
            "timings_s": dict(timings),
        },
        "findings": placed(result.report["findings"], work),
    }
