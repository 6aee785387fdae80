"""Whose files an output folder holds: wrapit's are those that its report lists, with the bytes it lists."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

# What tells that a folder is wrapit's: a report of this name and format.
REPORT: Final = "report.json"
FORMAT: Final = "wrapit-report/1"
# Of a name between two slashes, on all common systems.
LONGEST_NAME_BYTES: Final = 255


@dataclass(frozen=True)
class Artifact:
    """A written file, by its name in the output folder.

    `instead_of` is the name that it would have, were there not a file of somebody else's.
    """

    path: str
    kind: str
    bytes: int
    sha256: str
    instead_of: str | None = None


def artifacts_in(folder: Path, renamed: dict[str, str]) -> tuple[Artifact, ...]:
    """Every file in a folder but the report; `renamed` gives the usual name of those that don't have it."""
    return tuple(
        Artifact(path.name, kind(path), path.stat().st_size, sha256(path), renamed.get(path.name))
        for path in sorted(folder.iterdir())
        if path.name != REPORT
    )


def kind(path: Path) -> str:
    """What a file is: its suffix."""
    return path.suffix.lstrip(".")


def sha256(path: Path) -> str:
    """Hash of a file's bytes."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def own_report(folder: Path) -> dict[str, Any] | None:
    """The report that wrapit wrote into a folder; None where there is none, or somebody else's."""
    path = folder / REPORT
    try:
        report = json.loads(path.read_text(encoding="utf-8")) if is_plain_file(path) else None
    except (OSError, ValueError, RecursionError):
        return None
    return report if isinstance(report, dict) and report.get("format") == FORMAT else None


def listed_files(report: dict[str, Any] | None) -> dict[str, str]:
    """Names and hashes that a report lists; a name that leads out of its folder is no file of ours."""
    artifacts = (report or {}).get("artifacts")
    if not isinstance(artifacts, list):
        return {}
    pairs = [(a.get("path"), a.get("sha256")) for a in artifacts if isinstance(a, dict)]
    return {
        name: digest
        for name, digest in pairs
        if isinstance(name, str) and isinstance(digest, str) and is_plain_name(name)
    }


def is_plain_name(name: str) -> bool:
    """Whether a name stays in its folder and can be one: no separator, no `..`, not empty, not too long.

    A colon separates too, on Windows: drives, and streams of a file.
    """
    try:
        possible = 0 < len(os.fsencode(name)) <= LONGEST_NAME_BYTES
    except UnicodeError:
        return False
    return possible and name not in (".", "..", REPORT) and not set(name) & set("/\\:\0")


def is_plain_file(path: Path) -> bool:
    """Whether there is a file itself, not a link to one."""
    return path.is_file() and not path.is_symlink()


def is_unchanged(path: Path, digests: Iterable[str | None]) -> bool:
    """Whether a file has the bytes of one of these hashes."""
    return is_plain_file(path) and sha256(path) in set(digests)


def own_files(folder: Path) -> set[str]:
    """Names of the files in a folder that wrapit wrote and nobody changed since, the report among them."""
    report = own_report(folder)
    if report is None:
        return set()
    listed = listed_files(report)
    return {REPORT, *(name for name, digest in listed.items() if is_unchanged(folder / name, [digest]))}


def is_whole(folder: Path, report: dict[str, Any]) -> bool:
    """Whether every file that a report lists is there as written, and none was renamed without need."""
    artifacts, listed = report.get("artifacts"), listed_files(report)
    if not isinstance(artifacts, list) or not listed or len(listed) != len(artifacts):
        return False  # somebody changed the report
    renamed = [name for artifact in artifacts if (name := artifact.get("instead_of"))]
    return all(is_unchanged(folder / name, [digest]) for name, digest in listed.items()) and all(
        isinstance(name, str) and os.path.lexists(folder / name) for name in renamed
    )
