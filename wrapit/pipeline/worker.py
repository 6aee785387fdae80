"""Runs kernel work in a process of its own: it can be stopped, and a crash there is an error here."""

from __future__ import annotations

import contextlib
import gc
import importlib
import multiprocessing
import os
import pickle
import queue
import signal
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from wrapit.errors import KernelError, WrapItError
from wrapit.pipeline.output.guards import let_through, signals_held

# After how many new objects Python looks for rings of them that nobody knows, and after how many such looks
# among older ones. What a build makes has few rings and lives to its end: at Python's own 700, 10 and 10 the
# looking takes 5 % of a build; at this it takes as little as without any, and memory is the same within 1 %.
COLLECTING = (50_000, 50, 50)


@dataclass
class Job:
    """A function that a worker has been given; `where` names it in errors."""

    where: str
    limit_s: float
    given_s: float
    answer: tuple[bool, Any] | None = None


class Worker:
    """A process that has the kernel loaded; entered early, it loads while other stages run.

    `start` gives it a function of this package with arguments, all picklable. It takes one after the other.
    """

    def __init__(self, preload: Sequence[str] = ()) -> None:
        context = multiprocessing.get_context("spawn")
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, tuple(preload)), daemon=True)
        self._theirs = theirs
        self._jobs: deque[Job] = deque()
        self._free_s = 0.0

    def __enter__(self) -> Self:
        try:
            _start_tracker()
            with signals_held():  # an end amid its start would leave it with half an order, and complaining
                self._process.start()
                self._theirs.close()
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop()

    def start(self, where: str, limit_s: float, function: Callable[..., Any], *arguments: Any) -> Job:
        """Gives it a function; `result` waits for what that returns, `limit_s` at most from its turn on."""
        job = Job(where, limit_s, time.monotonic())
        self._jobs.append(job)
        with contextlib.suppress(BrokenPipeError):  # `result` says what became of the process
            self._connection.send((function, arguments))
        return job

    def is_free(self) -> bool:
        """Whether it has done all that it was given."""
        with contextlib.suppress(EOFError, OSError):  # it is gone: `result` says why
            while self._jobs and self._connection.poll():
                self._take()
        return not self._jobs

    def result(self, job: Job) -> Any:
        """What a function returned; its WrapItErrors come through.

        Raises KernelError, naming what is to blame, when the process crashes or a function takes too long,
        OSError when it couldn't write.
        """
        while job.answer is None:
            head = self._jobs[0]
            try:
                left_s = self._turn_s(head) + head.limit_s - time.monotonic()
                if not self._connection.poll(max(0.0, left_s)):
                    self._stop()
                    raise KernelError(
                        f"the solid modeller didn't finish within {head.limit_s:.0f} s",
                        head.where,
                        "simplify the drawing there, or raise jig.time_limit",
                    )
                self._take()
            except (EOFError, BrokenPipeError, ConnectionResetError):
                self._process.join(5)
                raise _ended(self._process.exitcode, head.where) from None
        succeeded, value = job.answer
        if succeeded:
            return value
        if isinstance(value, WrapItError | OSError):
            raise value
        if isinstance(value, MemoryError):
            raise _out_of_memory(job.where)
        raise RuntimeError(value)

    def _take(self) -> None:
        """Reads the answer of the function whose turn it was."""
        *answer, took_s = self._connection.recv()
        job = self._jobs.popleft()
        self._free_s = self._turn_s(job) + took_s
        job.answer = (answer[0], answer[1])

    def _turn_s(self, job: Job) -> float:
        """When the first of its functions had its turn."""
        return max(self._free_s, job.given_s)

    def _stop(self) -> None:
        if self._process.is_alive():
            self._process.terminate()
            self._process.join(2)
            if self._process.is_alive():
                self._process.kill()
        if self._process.pid is not None:  # else it was never started
            self._process.join()
        self._connection.close()


class OnCall:
    """A worker that is started when it is first asked for, if ever.

    Errors name the piece that it works for; each function has `limit_s`, None where that hangs on the piece.
    """

    def __init__(self, hired: Callable[[], Worker], piece: str = "", limit_s: float | None = None) -> None:
        self.piece, self.limit_s = piece, limit_s
        self._hired = hired
        self._worker: Worker | None = None
        self._stack = contextlib.ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.close()

    def worker(self) -> Worker:
        if self._worker is None:
            self._worker = self._stack.enter_context(self._hired())
        return self._worker

    def is_free(self) -> bool:
        """Whether a worker is there and has nothing to do."""
        return self._worker is not None and self._worker.is_free()


def _start_tracker() -> None:
    """Python's own helper process; started later, it would let signals through to the worker's start."""
    if sys.platform != "win32":
        from multiprocessing import resource_tracker

        resource_tracker.ensure_running()


def _ended(exit_code: int | None, where: str) -> KernelError:
    """Why the process is gone: killed from outside is what systems do that run out of memory."""
    if sys.platform != "win32" and exit_code == -signal.SIGKILL:
        return _out_of_memory(where)
    if exit_code == 1:  # Python's own way to end; the kernel's crashes are signals
        return KernelError(
            "the solid modeller's process ended before its work",
            where,
            "a script calls wrapit.build below `if __name__ == '__main__':`; else please report the drawing",
        )
    return KernelError(
        f"the solid modeller crashed (exit code {exit_code})",
        where,
        "change the size or simplify the drawing there; please report the drawing",
    )


def _out_of_memory(where: str) -> KernelError:
    return KernelError(
        "the solid modeller was stopped from outside, as when memory runs out",
        where,
        "close other programs, build fewer pieces at once (make -j1), or simplify the drawing",
    )


def _serve(connection: Connection, preload: Sequence[str]) -> None:
    _end_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is told, and stops this process
    let_through()  # they were held at the start
    nothing_on_stdout()  # the kernel's writers chat there
    gc.set_threshold(*COLLECTING)
    orders: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    # Who sends an order that is larger than a pipe would wait until all is loaded.
    threading.Thread(target=_take_in, args=(connection, orders), daemon=True).start()
    for module in preload:
        importlib.import_module(module)
    while order := orders.get():
        began_s = time.monotonic()
        try:
            function, arguments = pickle.loads(order)
            answer: tuple[bool, Any] = (True, function(*arguments))
        except (WrapItError, OSError, MemoryError) as error:
            answer = (False, error)
        except Exception:  # noqa: BLE001  told to the parent with its traceback
            answer = (False, traceback.format_exc())
        try:
            connection.send((*answer, time.monotonic() - began_s))
        except BrokenPipeError:
            return  # the parent is gone


def _take_in(connection: Connection, orders: queue.SimpleQueue[bytes]) -> None:
    """Puts pickled orders by until their turn comes; an empty one at the end."""
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        while True:
            orders.put(connection.recv_bytes())
    orders.put(b"")


@contextlib.contextmanager
def seldom_collected() -> Iterator[None]:
    """Has Python look for rings of unknown objects as `COLLECTING` says, then as before."""
    before = gc.get_threshold()
    gc.set_threshold(*COLLECTING)
    try:
        yield
    finally:
        gc.set_threshold(*before)


def nothing_on_stdout() -> None:
    """Points stdout at nothing in a process beside the one whose report or link it carries."""
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)


def _end_with_parent() -> None:
    """Ends this process with the one that started it, however that one ends, even amid kernel work."""
    if sys.platform == "linux":
        import ctypes

        pr_set_pdeathsig = 1
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)
    end_after_parent()


def end_after_parent() -> None:
    """Ends this process once the one that started it is gone; kernel work may keep it until it is done."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent.sentinel,), daemon=True).start()


def _end_after(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)
