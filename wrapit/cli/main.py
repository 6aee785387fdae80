"""Entry point: whatever happens ends in one line for the person, one document with --json, one exit code."""

from __future__ import annotations

import errno
import io
import json
import os
import signal
import sys
import threading
from types import FrameType
from typing import Any, NoReturn

from wrapit.calling import PROGRAM, pasted

# Imported, they register what they hold.
from wrapit.cli import batch_command, commands, facts, starting, studio_command  # noqa: F401
from wrapit.cli.app import app, say
from wrapit.cli.ending import Terminated, came
from wrapit.errors import WrapItError

# What shells give a program that Ctrl-C ended: 128 + SIGINT.
INTERRUPTED = 130
# Set by a shell that asks for completions; it names no arguments then.
_COMPLETION = f"_{PROGRAM.upper()}_COMPLETE"
# System errors whose remedy isn't "check the path".
_DISK = {errno.ENOSPC: "free space on the disk", errno.EDQUOT: "free space on the disk"}
# Once more after a signal came where Python throws exceptions away: long enough to be out of there.
_AGAIN_S = 0.01


def main() -> NoReturn:
    """Runs the command in `sys.argv` and exits."""
    _arm()
    sys.unraisablehook = _not_lost
    _replace_closed_streams()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    sys.exit(_exit_code(sys.argv[1:]))


def _ending() -> list[int]:
    """Signals that end the program, but those that it was started to ignore, as by nohup."""
    names = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    known = [getattr(signal, name) for name in names if hasattr(signal, name)]
    return [signum for signum in known if signal.getsignal(signum) is not signal.SIG_IGN]


def _replace_closed_streams() -> None:
    """What a shell closed (`>&-`) is read from and written to nowhere.

    Left closed, its number would be given to the next file that is opened, and what libraries print would
    end up in that.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest free number, which is this one
    if sys.stdout is None:
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115  lives as long as the program
    if sys.stderr is None:
        sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115  lives as long as the program


def _arm() -> None:
    for signum in _ending():
        signal.signal(signum, _terminate)


def _terminate(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001  the signature is Python's
    came.append(signum)
    for each in _ending():
        signal.signal(each, signal.SIG_IGN)  # clearing away is under way, and isn't to be ended half-way
    raise Terminated(signum)


def _not_lost(unraisable: sys.UnraisableHookArgs) -> None:
    """Signals that come amid a finaliser or an import's own callbacks come again a moment later."""
    ended = unraisable.exc_value
    if not isinstance(ended, Terminated):
        sys.__unraisablehook__(unraisable)
        return
    signal.signal(ended.signum, _terminate)
    again = threading.Timer(_AGAIN_S, _signal_main, [ended.signum])
    again.daemon = True
    again.start()


def _signal_main(signum: int) -> None:
    main_thread = threading.main_thread().ident
    if sys.platform == "win32" or main_thread is None:
        signal.raise_signal(signum)
    else:
        signal.pthread_kill(main_thread, signum)  # so that it also ends what the main thread waits for


def _exit_code(arguments: list[str]) -> int:
    try:
        if not arguments and _COMPLETION not in os.environ:
            app(["--help"], prog_name=PROGRAM, standalone_mode=False)
            return 2
        code = int(app(arguments, prog_name=PROGRAM, standalone_mode=False) or 0)
        sys.stdout.flush()
        if code == INTERRUPTED:
            raise KeyboardInterrupt
        return code
    except (Terminated, KeyboardInterrupt) as ended:
        code = ended.exit_code if isinstance(ended, Terminated) else INTERRUPTED
        return _interrupted(code, arguments)
    except BrokenPipeError:
        _drop_stdout()  # the reader has seen enough, as `| head` has
        return 1
    except Exception as error:  # noqa: BLE001  the last line of defence: one line, not a traceback
        if came:  # native modules amid their loading make ImportErrors of what a signal raised
            return _interrupted(128 + came[0], arguments)
        if "-vv" in arguments:
            import traceback

            traceback.print_exc()
        return _failed(error, arguments)


def _interrupted(exit_code: int, arguments: list[str]) -> int:
    return _report("interrupted", "interrupted; earlier files are untouched", "", "", exit_code, arguments)


def _failed(error: Exception, arguments: list[str]) -> int:
    if isinstance(error, WrapItError):
        return _report(error.code, error.problem, error.where, error.remedy, error.exit_code, arguments)
    if hasattr(error, "format_message"):  # what the parser of the command line raises
        context = getattr(error, "ctx", None)
        command = pasted(*_subcommand(context), "--help")
        problem = error.format_message().rstrip(".")
        return _report("usage", f"{problem[:1].lower()}{problem[1:]}", "", f"see {command}", 2, arguments)
    if isinstance(error, OSError):
        reason = (error.strerror or str(error) or type(error).__name__).lower()
        remedy = _DISK.get(error.errno or 0, "check the path, its permissions and the disk")
        return _report("system", f"can't be read or written ({reason})", _place(error), remedy, 1, arguments)
    if isinstance(error, MemoryError):
        remedy = "close other programs, or make the drawing smaller"
        return _report("memory", "memory ran out", "", remedy, 1, arguments)
    summary = " ".join(f"{type(error).__name__}: {error}".split()).rstrip(": ")[-300:]
    remedy = "run again with -vv and report it"
    return _report("unexpected", f"unexpected ({summary})", "", remedy, 1, arguments)


def _subcommand(context: Any) -> list[str]:
    """The names of the commands in front of which the parser stumbled, without the program's own."""
    return [*_subcommand(context.parent), context.info_name] if context and context.parent else []


def _place(error: OSError) -> str:
    return str(error.filename) if error.filename is not None else "output"


def _report(code: str, problem: str, where: str, remedy: str, exit_code: int, arguments: list[str]) -> int:
    """One line on stderr; with --json also one document on stdout, if that can be written to at all."""
    say(f"error: {WrapItError(problem, where, remedy)}")
    if "--json" in arguments:
        told = {"code": code, "problem": problem, "where": where, "remedy": remedy, "exit_code": exit_code}
        try:
            print(json.dumps({"error": told}))
            sys.stdout.flush()
        except OSError:
            _drop_stdout()
    else:
        _flush_or_drop()
    return exit_code


def _flush_or_drop() -> None:
    try:
        sys.stdout.flush()
    except OSError:
        _drop_stdout()


def _drop_stdout() -> None:
    """Points stdout at nothing, so that Python doesn't try once more at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
