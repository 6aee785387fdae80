"""Locks on folders where the system locks files only, as Windows does: bytes of a file, one for each folder.

The file lies with the temporary files of the user. It is and stays empty; a lock ends with the process
that holds it, however that ends.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Final

# The file whose bytes are locked: those behind a file's end can be, too.
_FILE: Final = "wrapit-locks"
# Windows takes a place of 31 bits: of 1000 builds at once, two would wait for each other without need once in
# 4000 times.
_PLACES: Final = 2**31 - 1
# The system itself would wait for a second between two tries; a build holds a folder for some milliseconds.
_AGAIN_S: Final = 0.02


def locked_byte(folder: Path, *, wait: bool) -> int | None:
    """A lock on a folder; None where it is taken and we don't wait.

    Raises OSError where there is no such folder.
    """
    handle = os.open(Path(tempfile.gettempdir()) / _FILE, os.O_RDWR | os.O_CREAT)
    try:
        os.lseek(handle, _place(folder), os.SEEK_SET)
        while not _taken(handle):
            if not wait:
                os.close(handle)
                return None
            time.sleep(_AGAIN_S)
        folder.stat()
    except BaseException:
        os.close(handle)
        raise
    return handle


def let_go(handle: int) -> None:
    """Gives up a lock at once; closing alone would do so when the system has time."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(handle, msvcrt.LK_UNLCK, 1)
    os.close(handle)


def _place(folder: Path) -> int:
    """The folder's byte. A temporary folder keeps its own when `.partial` becomes `.ready`."""
    path = Path(os.path.normcase(os.path.realpath(folder)))
    named = path.with_suffix("") if path.suffix in (".partial", ".ready") else path
    return int.from_bytes(hashlib.sha256(os.fsencode(named)).digest()[:8]) % _PLACES


def _taken(handle: int) -> bool:
    """Whether the byte at the handle's place was free, and is ours now."""
    if sys.platform == "win32":
        import msvcrt

        try:
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        return True
    raise AssertionError("systems that lock folders do so")
