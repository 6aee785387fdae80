"""What a build holds on to: locks on folders, which end with the process, and signals that have to wait."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

ENDING: Final = ("SIGINT", "SIGTERM", "SIGHUP")


def lock_on(folder: Path, *, wait: bool) -> int | None:
    """A lock on a folder, which ends with the process; None where it is taken and we don't wait.

    Raises OSError where there is no such folder.
    """
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


def unlock(lock: int | None) -> None:
    """Gives up a lock, if there is one."""
    if lock is not None:
        os.close(lock)


@contextmanager
def signals_held(names: Sequence[str] = ENDING) -> Iterator[None]:
    """Signals that end the program wait until the block is done."""
    if sys.platform == "win32":
        yield
        return
    earlier = signal.pthread_sigmask(signal.SIG_BLOCK, [getattr(signal, name) for name in names])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, earlier)
