"""An output folder is the user's: a build puts its files there whole or not at all, and touches no others.

The files are made in a temporary folder (`.NAME.xxxxxxxx.partial`) and moved into place at the end. A process
holds a lock on its temporary folder while it lives, so a later build knows which ones are left over from
a killed one. The moves themselves can be interrupted by SIGKILL alone; then the folder is called `.ready`,
and the next build finishes them.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import re
import secrets
import shutil
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from wrapit.errors import ConfigError, ExportError, Finding
from wrapit.pipeline.output.guards import lock_on, signals_held, unlock
from wrapit.pipeline.output.moving import held_open, move_in, shut_out
from wrapit.pipeline.output.ownership import (
    LONGEST_NAME_BYTES,
    REPORT,
    is_unchanged,
    listed_files,
    own_files,
    own_report,
)

# What helps wherever a folder can't be used.
OTHER_FOLDER = "choose another folder with -o"
# Of longer names a hash tells the rest: with the random part, a name may have 255 bytes.
_LONGEST_PREFIX_BYTES = 120
# What a writer couldn't write any more stays free: less than one of its buffers.
_NO_ROOM_BYTES = 1 << 16
# Windows as it comes takes paths of 259 characters. A temporary folder's has 18 more than the folder's own,
# and the longest of our usual names, `decomposition.json`, takes 19 with its separator.
_LONG_PATH = 259 - 18 - 19


def followed(target: Path) -> Path:
    """The output folder itself, where `target` is a link to it.

    Raises ConfigError when no folder can be there: a file, something under a file, a link to itself, a name
    that is too long.
    """
    folder = target
    try:
        folder = Path(os.path.realpath(target))
        if any(len(os.fsencode(part)) > LONGEST_NAME_BYTES for part in folder.parts):
            raise ConfigError("the folder's name is too long", _shortened(target), OTHER_FOLDER)
        if not stat.S_ISDIR(folder.stat().st_mode):
            raise ConfigError("is a file, not a folder", str(target), OTHER_FOLDER)
    except FileNotFoundError:
        if not folder.is_absolute():
            problem = "the folder that wrapit was started in is gone"
            raise ConfigError(problem, _shortened(target), "start it in another one") from None
        return folder
    except (OSError, ValueError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise ConfigError(f"no folder can be here ({reason})", _shortened(target), OTHER_FOLDER) from None
    return folder


def prepare(folder: Path) -> None:
    """Clears away what killed builds of this folder left, and finishes one that was killed at its end.

    Raises ConfigError when the folder holds files and none of them says that wrapit wrote it.
    """
    try:
        _clear_leftovers(folder)
        foreign = folder.is_dir() and own_report(folder) is None and any(_others(folder))
    except OSError as error:
        raise _unwritable(error, folder) from None
    if foreign:
        raise ConfigError("the folder holds files that wrapit didn't write", str(folder), OTHER_FOLDER)


def _others(folder: Path) -> Iterator[Path]:
    """What a folder holds besides temporary folders of its own."""
    return (path for path in folder.iterdir() if not _leftover_pattern(folder).fullmatch(path.name))


@contextmanager
def staged(folder: Path) -> Iterator[Path]:
    """A temporary folder for the files of a build, cleared away at the end.

    Raises ExportError when its place can't be written; those of the block name the user's folder.
    """
    made = _missing_parents(folder)
    # Named before it is made: whenever a signal ends this, it is cleared away.
    partial = _staging_place(folder) / f"{_prefix(folder)}{secrets.token_hex(4)}.partial"
    lock = None
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        lock = _made_and_locked(partial)
        yield partial
    except OSError as error:
        raise _unwritable(error, folder) from error
    except ExportError as error:
        raise _as_known(error, partial, folder) from error
    finally:
        with signals_held():
            shutil.rmtree(partial, ignore_errors=True)
            unlock(lock)
            _remove_empty(made)


def _made_and_locked(partial: Path) -> int | None:
    while True:
        partial.mkdir()
        with contextlib.suppress(FileNotFoundError):
            lock = lock_on(partial, wait=True)
            if partial.exists():
                return lock
            unlock(lock)
        # Another build took it for a leftover in the moment before it was locked.


def renamed_beside_others(partial: Path, folder: Path) -> tuple[dict[str, str], tuple[Finding, ...]]:
    """Renames new files whose places in the folder are taken by files that aren't wrapit's (any more).

    `jig.3mf`, which somebody saved again, stays; the new one becomes `jig.new.3mf`. Returns the usual name of
    each renamed file, by its new one, and a finding for each.
    """
    own, renamed, findings = own_files(folder), {}, []
    for path in sorted(partial.iterdir()):
        if path.name in own or not os.path.lexists(folder / path.name):
            continue
        free = next(name for name in _beside(path) if name in own or not os.path.lexists(folder / name))
        path.rename(partial / free)
        renamed[free] = path.name
        findings.append(
            Finding(
                "warning",
                "file-kept",
                path.name,
                f"somebody wrote or changed this file, so it stays as it is; the new one is {free}",
                f"move {path.name} away or delete it, and build again",
            )
        )
    return renamed, tuple(findings)


def _beside(path: Path) -> Iterator[str]:
    yield f"{path.stem}.new{path.suffix}"
    number = 2
    while True:
        yield f"{path.stem}.new-{number}{path.suffix}"
        number += 1


def put_in_place(partial: Path, folder: Path) -> None:
    """Moves the finished files into the folder, and takes away those of the earlier build that are no more.

    Raises ExportError when something of somebody else's appeared in their place meanwhile, or a program keeps
    an earlier file from being replaced.
    """
    with signals_held():
        if not folder.exists():
            try:
                partial.rename(folder)
                return
            except OSError as error:
                if error.errno not in (errno.EEXIST, errno.ENOTEMPTY):
                    raise  # else another build was faster: its files are replaced like any earlier ones
        lock = lock_on(folder, wait=True)
        try:
            _refuse_where_taken(partial, folder)
            move_in(partial.rename(partial.with_suffix(".ready")), folder)
        finally:
            unlock(lock)


def _refuse_where_taken(ready: Path, folder: Path) -> None:
    for path in shut_out(ready, folder):
        problem = "somebody wrote this file meanwhile, so the new one was not put in its place"
        raise ExportError(problem, str(folder / path.name), "move it away and build again")
    for path in held_open(ready, folder):
        remedy = f"close the program that has {path.name} open, and build again"
        raise ExportError("another program keeps this file from being replaced", str(path), remedy)


def _clear_leftovers(folder: Path) -> None:
    pattern = _leftover_pattern(folder)
    for place in (folder.parent, folder):
        for path in sorted(place.iterdir()) if place.is_dir() else ():
            if pattern.fullmatch(path.name) and path.is_dir() and not path.is_symlink():
                _clear(path, folder)


def _clear(leftover: Path, folder: Path) -> None:
    try:
        lock = lock_on(leftover, wait=False)
    except FileNotFoundError:
        return  # its build put it in place since we looked
    if lock is None:
        return  # its build is alive
    try:
        if leftover.suffix == ".ready" and _was_its_place(leftover, folder):
            _finish(leftover, folder)
        shutil.rmtree(leftover, ignore_errors=True)
    finally:
        unlock(lock)


def _was_its_place(ready: Path, folder: Path) -> bool:
    """Whether the folder is still the one that these files were being moved into."""
    if own_report(ready) is None or not folder.is_dir():
        return False
    moved = (
        is_unchanged(folder / name, [digest]) for name, digest in listed_files(own_report(ready)).items()
    )
    return own_report(folder) is not None or any(moved) or not any(_others(folder))


def _finish(ready: Path, folder: Path) -> None:
    """Moves in what isn't yet; a file that somebody wrote since stays, and the next build sees it there."""
    with signals_held():
        lock = lock_on(folder, wait=True)
        try:
            for path in list(shut_out(ready, folder)):
                path.unlink()
            if (ready / REPORT).exists():
                move_in(ready, folder)
        finally:
            unlock(lock)


def _prefix(folder: Path) -> str:
    name = os.fsencode(folder.name)
    if len(name) <= _LONGEST_PREFIX_BYTES:
        return f".{folder.name}."
    beginning = name[:_LONGEST_PREFIX_BYTES].decode(errors="ignore")
    return f".{beginning}-{hashlib.sha256(name).hexdigest()[:16]}."


def _leftover_pattern(folder: Path) -> re.Pattern[str]:
    return re.compile(rf"{re.escape(_prefix(folder))}[a-z0-9_]{{8}}\.(?P<state>partial|ready)")


def _staging_place(folder: Path) -> Path:
    """Beside the folder, so that it appears at once; inside where it is a disk of its own."""
    parent = folder.parent
    beside = not folder.exists() or (
        os.access(parent, os.W_OK) and folder.stat().st_dev == parent.stat().st_dev
    )
    return parent if beside else folder


def _missing_parents(folder: Path) -> list[Path]:
    return [parent for parent in folder.parents if not parent.exists()]


def _remove_empty(folders: list[Path]) -> None:
    """Takes away folders that were made for a build which left nothing in them."""
    for folder in folders:
        try:
            folder.rmdir()
        except OSError:
            return  # it isn't empty (or gone): it stays, and so do those around it


def _unwritable(error: OSError, folder: Path) -> ExportError:
    reason, remedy = (error.strerror or str(error)).lower(), f"free space, or {OTHER_FOLDER}"
    if sys.platform == "win32":
        if isinstance(error, PermissionError):
            remedy = f"close programs that have its files open, or {OTHER_FOLDER}"
        elif isinstance(error, FileNotFoundError) and len(str(folder)) > _LONG_PATH:
            reason, remedy = "the path is too long for this system", f"{OTHER_FOLDER}: a shorter path"
    return ExportError(f"can't write here ({reason})", str(folder), remedy)


def _as_known(error: ExportError, partial: Path, folder: Path) -> ExportError:
    """Where the error names a temporary file, the one that it was to become; and a full disk, if it is."""
    if str(partial) not in error.where:
        return error
    where, problem, remedy = error.where.replace(str(partial), str(folder)), error.problem, error.remedy
    if partial.exists() and shutil.disk_usage(partial).free < _NO_ROOM_BYTES:
        full = os.strerror(errno.ENOSPC)
        problem = problem if full in problem else f"{problem} ({full.lower()})"
        remedy = f"free space, or {OTHER_FOLDER}"
    return ExportError(problem, where, remedy or OTHER_FOLDER)


def _shortened(path: Path) -> str:
    text = str(path)
    return text if len(text) <= 120 else f"{text[:60]}…{text[-40:]}"
