"""The output folder appears whole or not at all; the earlier build stays until the new one is complete."""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from wrapit.errors import ConfigError, ExportError

REPORT = "report.json"


@dataclass(frozen=True)
class Artifact:
    """A written file, relative to the output folder."""

    path: str
    kind: str
    bytes: int
    sha256: str


def artifacts_in(folder: Path) -> tuple[Artifact, ...]:
    """Every file in a folder but the report, by name."""
    return tuple(
        Artifact(str(path.relative_to(folder)), kind(path), path.stat().st_size, sha256(path))
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != REPORT
    )


def kind(path: Path) -> str:
    """What a file is, for people: the stem without numbers and the format, `jig step`."""
    return path.suffix.lstrip(".")


def sha256(path: Path) -> str:
    """Hash of a file's bytes."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def check_target(target: Path) -> None:
    """Raises ConfigError when the target is something that wrapit didn't write."""
    if target.exists() and not target.is_dir():
        raise ConfigError("is a file, not a folder", str(target), "choose another folder with -o")
    if target.is_dir() and any(target.iterdir()) and not (target / REPORT).is_file():
        raise ConfigError(
            "the folder holds files that wrapit didn't write", str(target), "choose another folder with -o"
        )


@contextmanager
def replaced_whole(target: Path) -> Iterator[Path]:
    """A temporary folder beside the target that takes its place on success and vanishes on failure.

    Raises ExportError when the place can't be written.
    """
    check_target(target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".partial", dir=target.parent))
        partial.chmod(0o755)
    except OSError as error:
        raise ExportError(
            f"can't write here ({error.strerror})", str(target.parent), "choose another folder with -o"
        ) from None
    try:
        yield partial
        _swap(partial, target)
    except OSError as error:
        raise ExportError(
            f"can't write the files ({error.strerror})",
            str(target),
            "free space, or choose another folder with -o",
        ) from error
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def _swap(partial: Path, target: Path) -> None:
    if not target.exists():
        partial.rename(target)
        return
    earlier = partial.with_suffix(".earlier")
    target.rename(earlier)
    try:
        partial.rename(target)
    except OSError:
        earlier.rename(target)
        raise
    shutil.rmtree(earlier, ignore_errors=True)
