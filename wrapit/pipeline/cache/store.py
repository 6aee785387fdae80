"""Entries by key in a folder: whole or not at all, bounded, and never a reason for a build to fail."""

from __future__ import annotations

import contextlib
import dataclasses
import errno
import os
import shutil
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from wrapit.pipeline.cache.sealed import Entry, opened, sealed

# What the files are called that hold entries, and those that are being written.
_KEPT, _PARTIAL = ".entry", ".partial"
# So much stays free, for the files that a build writes: the largest of our pieces has 12 MB of them.
LEAST_FREE_BYTES: Final = 64 << 20
# Writing an entry takes seconds at most: what is older than this was left by a killed process.
_LEFT_OVER_S: Final = 3600.0


@dataclass
class Store:
    """Entries in `folder`, which is made when it is needed; without one nothing is kept or found.

    `trouble` says why nothing is kept, if that is so. Unpickling runs what an entry says, so the folder has
    to be the user's own.
    """

    folder: Path | None = None
    most_bytes: int = 0
    reading: bool = True
    trouble: str = ""
    _trimmed: bool = True

    def unread(self) -> Store:
        """The same folder, where everything is made anew and kept instead of what is there."""
        return dataclasses.replace(self, reading=False)

    def has(self, key: str) -> bool:
        """Whether there seems to be an entry; `get` may find it spoilt."""
        if not self.reading or self.folder is None:
            return False
        try:
            return self._place(key).is_file()
        except OSError as error:  # nobody may look into the folder, or its name is too long
            self._note(error)
            return False

    def get(self, key: str) -> Entry | None:
        """The entry of a key, which counts as used now; a spoilt one is thrown away."""
        if not self.has(key):
            return None
        path = self._place(key)
        try:
            _refuse_others(path.parent)
            data = path.read_bytes()
        except FileNotFoundError:
            return None  # another build has just trimmed it away
        except OSError as error:
            self._note(error)
            return None
        try:
            entry = opened(key, data)
        except ValueError:
            with contextlib.suppress(OSError):  # another process may hold or have removed it
                path.unlink()
            return None
        with contextlib.suppress(OSError):  # it goes a little earlier then
            os.utime(path)
        return entry

    def put(self, key: str, entry: Entry) -> None:
        """Keeps an entry, if it can."""
        if self.folder is None or self.trouble:
            return
        data = sealed(key, entry)
        if len(data) > self.most_bytes:  # it alone would push out all others
            self._trimmed = False  # but the bound may be a new one that those exceed
            return
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            _refuse_others(self.folder)
            if shutil.disk_usage(self.folder).free < len(data) + LEAST_FREE_BYTES:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            _write_whole(self._place(key), data)
            self._trimmed = False
        except OSError as error:
            self._note(error)

    def trim(self) -> None:
        """Takes away what was used longest ago, down to `most_bytes`, and what killed processes left."""
        if self.folder is None or self._trimmed:
            return
        aged: list[tuple[float, int, Path]] = []
        with contextlib.suppress(OSError), os.scandir(self.folder) as found:
            for file in found:
                with contextlib.suppress(OSError):  # another process was faster
                    about = file.stat()
                    if file.name.endswith(_KEPT):
                        aged.append((about.st_mtime, about.st_size, Path(file.path)))
                    elif file.name.endswith(_PARTIAL) and time.time() - about.st_mtime > _LEFT_OVER_S:
                        Path(file.path).unlink()
        excess = sum(size for _, size, _ in aged) - self.most_bytes
        for _, size, path in sorted(aged):
            if excess <= 0:
                return
            with contextlib.suppress(OSError):  # held open by another process: the next time
                path.unlink()
                excess -= size

    def _place(self, key: str) -> Path:
        assert self.folder is not None
        return self.folder / f"{key}{_KEPT}"

    def _note(self, error: OSError) -> None:
        self.trouble = self.trouble or (error.strerror or str(error)).lower()


def _refuse_others(folder: Path) -> None:
    """Raises PermissionError where somebody else may write into the folder, or owns it."""
    if not hasattr(os, "getuid"):
        return  # a user's folders are the user's own there
    about = folder.stat()
    if about.st_uid != os.getuid() or about.st_mode & 0o022:
        raise PermissionError(errno.EPERM, "others may write there")


def _write_whole(path: Path, data: bytes) -> None:
    handle, name = tempfile.mkstemp(_PARTIAL, f".{path.stem[:16]}-", path.parent)
    partial = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        try:
            partial.replace(path)
        except PermissionError:
            if not path.exists():  # else it is open elsewhere, which Windows minds: it stays as it is
                raise
    finally:
        partial.unlink(missing_ok=True)
