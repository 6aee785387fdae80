"""An output folder is the user's: a build puts its files there whole or not at all, and touches no others.

The files are made in a temporary folder (`.NAME.xxxxxxxx.partial`) and moved into place at the end. A process
holds a lock on its temporary folder while it lives, so a later build knows which ones are left over from
a killed one. The moves themselves can be interrupted by SIGKILL alone; then the folder is called `.ready`,
and the next build finishes them.
"""

from __future__ import annotations

import contextlib
import os
import re
import secrets
import shutil
import signal
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from wrapit.errors import ConfigError, ExportError, Finding
from wrapit.pipeline.ownership import (
    REPORT,
    is_unchanged,
    listed_files,
    own_files,
    own_report,
)

OTHER_FOLDER = "choose another folder with -o"
# Longer names would leave no room for the random part within the 255 bytes that a name may have.
_LONGEST_PREFIX_BYTES = 120
_LONGEST_NAME_BYTES = 255
_HELD = ("SIGINT", "SIGTERM", "SIGHUP")


def followed(target: Path) -> Path:
    """The output folder itself, where `target` is a link to it.

    Raises ConfigError when no folder can be there: a file, something under a file, a link to itself, a name
    that is too long.
    """
    try:
        folder = Path(os.path.realpath(target))
        if any(len(os.fsencode(part)) > _LONGEST_NAME_BYTES for part in folder.parts):
            raise ConfigError("the folder's name is too long", _shortened(target), OTHER_FOLDER)
        if not stat.S_ISDIR(folder.stat().st_mode):
            raise ConfigError("is a file, not a folder", str(target), OTHER_FOLDER)
    except FileNotFoundError:
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

    Raises ExportError when its place can't be written.
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
    finally:
        with _signals_held():
            shutil.rmtree(partial, ignore_errors=True)
            _unlock(lock)
            _remove_empty(made)


def _made_and_locked(partial: Path) -> int | None:
    while True:
        partial.mkdir()
        with contextlib.suppress(FileNotFoundError):
            lock = _lock(partial, wait=True)
            if partial.exists():
                return lock
            _unlock(lock)
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

    Raises ExportError when something of somebody else's appeared in their place meanwhile.
    """
    with _signals_held():
        if not folder.exists():
            with contextlib.suppress(FileExistsError):  # another build was faster
                partial.rename(folder)
                return
        lock = _lock(folder, wait=True)
        try:
            _refuse_strangers(partial, folder)
            _move_in(partial.rename(partial.with_suffix(".ready")), folder)
        finally:
            _unlock(lock)


def _refuse_strangers(ready: Path, folder: Path) -> None:
    """Raises ExportError where a new file's place is taken by one that neither report lists as it is."""
    old, new = listed_files(own_report(folder)), listed_files(own_report(ready))
    for path in sorted(ready.iterdir()):
        place = folder / path.name
        own = path.name == REPORT and own_report(folder) is not None
        if os.path.lexists(place) and not own:
            if is_unchanged(place, [old.get(path.name), new.get(path.name)]):
                continue
            problem = "somebody wrote this file meanwhile, so the new one was not put in its place"
            raise ExportError(problem, str(place), "move it away and build again")


def _move_in(ready: Path, folder: Path) -> None:
    """Each file is the old or the new one at any time; done again after a kill, it goes on where it was.

    The report comes last: until then the old one tells which of the old files are wrapit's.
    """
    old, new = listed_files(own_report(folder)), listed_files(own_report(ready))
    for path in sorted(ready.iterdir()):
        if path.name != REPORT:
            path.replace(folder / path.name)
    for name in sorted(old.keys() - new.keys()):
        if is_unchanged(folder / name, [old[name]]):
            (folder / name).unlink()
    (ready / REPORT).replace(folder / REPORT)
    ready.rmdir()


def _clear_leftovers(folder: Path) -> None:
    pattern = _leftover_pattern(folder)
    for place in (folder.parent, folder):
        for path in sorted(place.iterdir()) if place.is_dir() else ():
            match = pattern.fullmatch(path.name)
            if match is None or path.is_symlink() or not path.is_dir():
                continue
            lock = _lock(path, wait=False)
            if lock is None:
                continue  # its build is alive
            try:
                if match["state"] == "ready" and folder.is_dir() and own_report(path) is not None:
                    _refuse_strangers(path, folder)
                    with _signals_held():
                        _move_in(path, folder)
                shutil.rmtree(path, ignore_errors=True)
            finally:
                _unlock(lock)


def _prefix(folder: Path) -> str:
    name = folder.name.encode()[:_LONGEST_PREFIX_BYTES].decode(errors="ignore")
    return f".{name}."


def _leftover_pattern(folder: Path) -> re.Pattern[str]:
    return re.compile(rf"{re.escape(_prefix(folder))}[a-z0-9_]{{8}}\.(?P<state>partial|ready)")


def _staging_place(folder: Path) -> Path:
    """Beside the folder, so that it appears at once; inside where it is a disk of its own."""
    parent = folder.parent
    beside = not folder.exists() or (
        os.access(parent, os.W_OK) and folder.stat().st_dev == parent.stat().st_dev
    )
    return parent if beside else folder


def _lock(folder: Path, *, wait: bool) -> int | None:
    """A lock on a folder, which ends with the process; None where it is taken and we don't wait."""
    if sys.platform == "win32":
        return None  # nothing tells there whether another build lives, so its folder is left to it
    import fcntl

    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except BlockingIOError:
        os.close(handle)
        return None
    return handle


def _unlock(lock: int | None) -> None:
    if lock is not None:
        os.close(lock)


@contextmanager
def _signals_held() -> Iterator[None]:
    """Signals that end the program wait until the block is done."""
    if sys.platform == "win32":
        yield
        return
    earlier = signal.pthread_sigmask(signal.SIG_BLOCK, [getattr(signal, name) for name in _HELD])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, earlier)


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
    reason = (error.strerror or str(error)).lower()
    return ExportError(f"can't write here ({reason})", str(folder), f"free space, or {OTHER_FOLDER}")


def _shortened(path: Path) -> str:
    text = str(path)
    return text if len(text) <= 120 else f"{text[:60]}…{text[-40:]}"
