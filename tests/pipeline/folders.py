"""Output folders as these tests look at them: made-up builds, and everything that a folder holds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from wrapit.pipeline.output.folder import prepare, put_in_place, renamed_beside_others, staged
from wrapit.pipeline.output.ownership import FORMAT, REPORT, artifacts_in
from wrapit.pipeline.report import artifact_list, to_json

PIECE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">'
    '<path d="M 35 20 A 15 15 0 0 1 5 20 A 15 15 0 0 1 35 20" fill="none" stroke="black"/></svg>'
)


def written_piece(folder: Path, **settings: Any) -> Path:
    """The config of a ring, which is built soon."""
    (folder / "piece.svg").write_text(PIECE)
    config = folder / "piece.yaml"
    config.write_text(json.dumps({"drawing": "piece.svg", **settings}))
    return config


def put(folder: Path, files: Mapping[str, bytes]) -> None:
    """What a build does with its files."""
    prepare(folder)
    with staged(folder) as partial:
        for name, data in files.items():
            (partial / name).write_bytes(data)
        renamed, _ = renamed_beside_others(partial, folder)
        report = {"format": FORMAT, "artifacts": artifact_list(artifacts_in(partial, renamed))}
        (partial / REPORT).write_text(to_json(report), encoding="utf-8")
        put_in_place(partial, folder)


def held(folder: Path) -> dict[str, bytes | str | None]:
    """Everything below a folder: a file's bytes, where a link leads, None for a folder."""
    entries: dict[str, bytes | str | None] = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            entries[name] = str(path.readlink())
        else:
            entries[name] = None if path.is_dir() else path.read_bytes()
    return entries


def listed(folder: Path) -> list[dict[str, Any]]:
    """The artifacts of the folder's report."""
    artifacts: list[dict[str, Any]] = json.loads((folder / REPORT).read_text(encoding="utf-8"))["artifacts"]
    return artifacts
