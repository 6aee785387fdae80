"""Pieces as bytes: sent to a machine that shares no disk, built there, and put in place here."""

from __future__ import annotations

import io
import json
import os
import tempfile
import time
import zipfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any, Final

from wrapit import __version__
from wrapit.batch.model import Ended, Piece
from wrapit.batch.processes import Processes
from wrapit.errors import DrawingError, ExportError

# What goes wrong with the machine rather than with the piece: then its name helps.
_OF_THE_MACHINE: Final = ("killed", "export", "system", "memory", "kernel", "unexpected")


def packed(piece: Piece, overrides: Sequence[str]) -> dict[str, Any]:
    """A piece as plain values, for `build_parcel`.

    Raises DrawingError where the drawing can't be read, or its place means nothing on another machine.
    """
    assert piece.config is not None, "only what could be loaded is sent"
    drawing = piece.config.drawing
    if PurePosixPath(drawing).is_absolute() or PureWindowsPath(drawing).anchor:
        problem = "a drawing at an absolute place can't be sent to other machines"
        raise DrawingError(problem, str(piece.config_path), "write `drawing:` relative to the config")
    path = piece.config_path.parent / drawing
    try:
        drawn, written = path.read_bytes(), piece.config_path.read_bytes()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        remedy = f"`drawing:` in {piece.config_path.name} is relative to the config"
        raise DrawingError(f"can't be read ({reason})", str(error.filename), remedy) from None
    return {
        "version": __version__,
        "name": piece.name,
        "config_name": piece.config_path.name,
        "config": written,
        "drawing_name": drawing,
        "drawing": drawn,
        "overrides": list(overrides),
    }


def build_parcel(parcel: dict[str, Any], machine: str, scratch: str | None = None) -> dict[str, Any]:
    """On the other machine: exit code, error, seconds, and on success the files as a zip.

    The build has a process of its own, for threads and daemons can't start the kernel's.
    """
    if parcel["version"] != __version__:
        return {"exit_code": 2, "error": _other_version(parcel["version"], machine)}
    start_s = time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="wrapit-piece-", dir=scratch) as name:
        folder = Path(name).resolve()
        config, made = _unpacked(parcel, folder / "given"), folder / parcel["name"]
        ended = Processes().build(config, made, parcel["overrides"])
        error = None
        if ended.error is not None:
            error = {key: _without(text, config.parent, folder) for key, text in ended.error.items()}
            if error["code"] in _OF_THE_MACHINE:
                error["problem"] += f" (on {machine})"
        return {
            "exit_code": ended.exit_code,
            "error": error,
            "timings_s": dict(ended.timings_s),
            "seconds": time.perf_counter() - start_s,
            "files": _zipped(made) if error is None else b"",
        }


def put_here(archive: bytes, folder: Path) -> None:
    """Puts files that were built elsewhere into an output folder, as a build here would.

    Raises ConfigError where the folder is somebody else's, ExportError where it can't be written.
    """
    from wrapit.pipeline import report as reports
    from wrapit.pipeline.output.folder import prepare, put_in_place, renamed_beside_others, staged
    from wrapit.pipeline.output.ownership import REPORT, artifacts_in, is_plain_name
    from wrapit.pipeline.textfile import write_text

    prepare(folder)
    with zipfile.ZipFile(io.BytesIO(archive)) as files, staged(folder) as partial:
        report = json.loads(files.read(REPORT))
        for name in files.namelist():
            if name != REPORT and not is_plain_name(name):
                raise ExportError(f"a worker sent a file called {name!r}", str(folder), "check the cluster")
            if name != REPORT:
                (partial / name).write_bytes(files.read(name))
        renamed, kept = renamed_beside_others(partial, folder)
        report["artifacts"] = reports.artifact_list(artifacts_in(partial, renamed))
        report["findings"] += reports.findings_list(kept)
        write_text(partial / REPORT, reports.to_json(report))
        put_in_place(partial, folder)


def arrived(answer: dict[str, Any], piece: Piece) -> Ended:
    """How a build elsewhere ended, its places named as they are here."""
    error = answer["error"]
    if error is not None:
        here = str(piece.config_path.parent / "_")[:-1]
        error = {key: text.replace(_HERE, here) for key, text in error.items()}
    return Ended(answer["exit_code"], error, answer.get("timings_s", {}))


# Stands for the config's folder in texts on their way back; no name of a file can hold it.
_HERE: Final = "\0here\0"


def _without(text: str, given: Path, folder: Path) -> str:
    for place, shown in ((given, _HERE), (folder, "")):
        text = text.replace(f"{place}{os.sep}", shown)
    return text


def _unpacked(parcel: dict[str, Any], folder: Path) -> Path:
    """The config's path; the drawing lies where the config says, be it some folders further up."""
    drawing = PurePosixPath(
        parcel["drawing_name"].replace("\\", "/") if os.name == "nt" else parcel["drawing_name"]
    )
    above = sum(part == ".." for part in drawing.parts)
    place = folder.joinpath(*["_"] * above)
    place.mkdir(parents=True)
    config = place / parcel["config_name"]
    config.write_bytes(parcel["config"])
    (place / drawing).parent.mkdir(parents=True, exist_ok=True)
    (place / drawing).write_bytes(parcel["drawing"])
    return config


def _zipped(folder: Path) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(folder.iterdir()):
            archive.write(path, path.name)
    return stream.getvalue()


def _other_version(wanted: str, machine: str) -> dict[str, str]:
    return {
        "code": "version",
        "problem": f"the worker has wrapit {__version__}, this machine has {wanted}",
        "where": machine,
        "remedy": f'install it there: pip install "wrapit[cluster]=={wanted}"',
    }
