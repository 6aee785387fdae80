"""Python as wrapit finds it on Windows, imitated on Linux: put this folder on PYTHONPATH.

What wrapit's own modules ask for (`sys.platform`, names of `os` and `signal`, POSIX modules) is as on
Windows; libraries see the system that they run on. For all alike, text files are cp1252 with
\\r\\n unless they are opened otherwise, and files that a process has open can't be replaced, renamed or
deleted, nor their folders.
"""

from __future__ import annotations

import builtins
import contextlib
import ctypes
import errno
import fcntl
import io
import os
import signal
import struct
import subprocess  # noqa: F401  it asks for msvcrt, so it has to come before that is there
import sys
import types
from pathlib import Path
from typing import Any

POSIX_MODULES = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty"}
# Of Windows' Python 3.11; https://docs.python.org/3/library/signal.html and os.html say which.
SIGNALS = {"SIGABRT", "SIGBREAK", "SIGFPE", "SIGILL", "SIGINT", "SIGSEGV", "SIGTERM", "SIG_DFL", "SIG_IGN"}
POSIX_SIGNAL_FUNCTIONS = {
    "alarm", "getitimer", "pause", "pthread_kill", "pthread_sigmask", "setitimer", "siginterrupt",
    "sigpending", "sigtimedwait", "sigwait", "sigwaitinfo",
}  # fmt: skip
POSIX_OS = {
    "chown", "chroot", "confstr", "fchdir", "fchmod", "fchown", "fork", "forkpty", "getegid", "geteuid",
    "getgid", "getgroups", "getloadavg", "getpgid", "getpgrp", "getpriority", "getsid", "getuid",
    "initgroups", "killpg", "lchown", "lockf", "mkfifo", "mknod", "nice", "openpty", "pathconf",
    "posix_fadvise", "posix_fallocate", "posix_spawn", "pread", "pwrite", "register_at_fork",
    "sched_getaffinity", "sendfile", "setgid", "setpgid", "setsid", "setuid", "statvfs", "sync",
    "sysconf", "uname", "wait", "wait3", "wait4", "WIFSIGNALED", "WTERMSIG", "O_CLOEXEC", "O_DIRECTORY",
    "O_DSYNC", "O_NOCTTY", "O_NOFOLLOW", "O_NONBLOCK", "O_SYNC", "WNOHANG",
}  # fmt: skip


class Seen(types.ModuleType):
    """A module as wrapit's modules see it: without what Windows' lacks, with what it has instead."""

    def __init__(self, real: Any, instead: dict[str, Any], lacks: Any) -> None:
        super().__init__(real.__name__)
        object.__setattr__(self, "_seen", (real, instead, lacks))

    def __getattribute__(self, name: str) -> Any:
        real, instead, lacks = object.__getattribute__(self, "_seen")
        if name in instead:
            return instead[name]
        if lacks(name):
            raise AttributeError(f"module {real.__name__!r} has no attribute {name!r} on Windows")
        return getattr(real, name)

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(object.__getattribute__(self, "_seen")[0], name, value)


def _locking(handle: int, mode: int, count: int) -> None:
    """`msvcrt.locking` by Linux' locks of bytes, which belong to a handle as those of Windows do."""
    kind = fcntl.F_UNLCK if mode == 0 else fcntl.F_WRLCK
    order = struct.pack("hhqqi4x", kind, os.SEEK_CUR, 0, count, 0)
    try:
        fcntl.fcntl(handle, fcntl.F_OFD_SETLK, order)
    except BlockingIOError:
        raise PermissionError(errno.EACCES, "Permission denied") from None


def _library(name: str | None) -> Any:
    if name is None:
        raise TypeError("LoadLibrary() argument 1 must be str, not None")
    return ctypes.CDLL(None if name == "ucrtbase" else name)


_msvcrt = types.ModuleType("msvcrt")
vars(_msvcrt).update(LK_UNLCK=0, LK_NBLCK=2, locking=_locking)
_SEEN = {
    "msvcrt": _msvcrt,
    "os": Seen(os, {"name": "nt"}, POSIX_OS.__contains__),
    "sys": Seen(sys, {"platform": "win32"}, {"abiflags"}.__contains__),
    "signal": Seen(
        signal,
        {"SIGBREAK": signal.SIGQUIT},
        lambda name: (
            name in POSIX_SIGNAL_FUNCTIONS
            or (name.startswith("SIG") and name.isupper() and name not in SIGNALS)
        ),
    ),
    "ctypes": Seen(ctypes, {"CDLL": _library}, ("pythonapi_posix",).__contains__),
}
_import, _open = builtins.__import__, io.open


def _imported(name: str, globals: Any = None, *others: Any, **named: Any) -> Any:
    asking = str((globals or {}).get("__name__", ""))
    if asking.partition(".")[0] == "wrapit":
        if name.partition(".")[0] in POSIX_MODULES:
            raise ModuleNotFoundError(f"No module named {name!r} on Windows", name=name)
        if name in _SEEN:
            return _SEEN[name]
    return _import(name, globals, *others, **named)


def _opened(
    file: Any, mode: str = "r", buffering: int = -1, encoding: Any = None, errors: Any = None,
    newline: Any = None, closefd: bool = True, opener: Any = None,
) -> Any:  # fmt: skip
    if "b" not in mode:
        encoding = "cp1252" if encoding in (None, "locale") else encoding
        writes = bool(set(mode) & set("wax+"))
        newline = "\r\n" if newline is None and writes and "+" not in mode else newline
    return _open(file, mode, buffering, encoding, errors, newline, closefd, opener)


def _open_files() -> set[str]:
    """What any process has open."""
    found = set()
    for process in Path("/proc").iterdir():
        handles: list[Path] = []
        with contextlib.suppress(OSError):  # it has ended, or is somebody else's
            handles = list((process / "fd").iterdir()) if process.name.isdecimal() else []
        for handle in handles:
            with contextlib.suppress(OSError):  # it was closed, as that of this list itself
                found.add(str(handle.readlink()))
    return found


def _refuse_open(*paths: Any) -> None:
    taken = _open_files()
    for path in paths:
        place = os.path.realpath(path)
        if any(each == place or each.startswith(f"{place}/") for each in taken):
            raise PermissionError(errno.EACCES, "Permission denied", os.fspath(path))


def _refusing(does: Any, *, taken_place: bool = False) -> Any:
    def done(path: Any, *others: Any, **named: Any) -> Any:
        if not named:
            _refuse_open(path, *others)
            if (
                taken_place
                and os.path.lexists(others[0])
                and os.path.realpath(path) != os.path.realpath(others[0])
            ):
                raise FileExistsError(errno.EEXIST, "File exists", os.fspath(others[0]))
        return does(path, *others, **named)

    return done


if __name__ == "sitecustomize":  # else a test looks at the lists above
    os.replace, os.unlink, os.remove = map(_refusing, (os.replace, os.unlink, os.remove))
    os.rename = _refusing(os.rename, taken_place=True)
    builtins.open = io.open = _opened
    builtins.__import__ = _imported
