"""What a build holds on to: locks on folders, which end with the process, and signals that have to wait."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

# Signals that end a program and can be held: Ctrl-C, being asked to end, closing a terminal; and Ctrl-Break,
# which Windows has.
_ENDING: Final = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")


def lock_on(folder: Path, *, wait: bool) -> int | None:
    """A lock on a folder, which ends with the process; None where it is taken and we don't wait.

    Raises OSError where there is no such folder.
    """
    if sys.platform == "win32":
        from wrapit.pipeline.output.byte_locks import locked_byte

        return locked_byte(folder, wait=wait)
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
    if lock is None:
        return
    if sys.platform == "win32":
        from wrapit.pipeline.output.byte_locks import let_go

        let_go(lock)
    else:
        os.close(lock)


@contextmanager
def signals_held() -> Iterator[None]:
    """Signals that end the program wait until the block is done; so do those to processes started in it.

    Python answers signals in its main thread alone, so elsewhere there is nothing to hold.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    earlier = {signum: signal.getsignal(signum) for signum in _ending()}
    held = [signum for signum, handler in earlier.items() if handler not in (signal.SIG_IGN, None)]
    mask = _block([])
    try:
        for signum in held:  # a mask isn't enough: a thread of some library may take the signal
            signal.signal(signum, lambda which, frame: came.append(which))
        _block(held)
        yield
    finally:
        for signum in held:
            signal.signal(signum, earlier[signum])
        _restore(mask)
        for signum in came:
            signal.raise_signal(signum)


def _block(signals: Iterable[int]) -> set[int]:
    """Returns those that were blocked before."""
    if sys.platform == "win32":
        return set()
    return {int(signum) for signum in signal.pthread_sigmask(signal.SIG_BLOCK, signals)}


def _restore(mask: set[int]) -> None:
    if sys.platform != "win32":
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


def let_through() -> None:
    """Signals come again in a process that was started while they were held."""
    if sys.platform != "win32":
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ending())


def _ending() -> list[int]:
    return [getattr(signal, name) for name in _ENDING if hasattr(signal, name)]
