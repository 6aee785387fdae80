"""A process beside the server that takes one order at a time, can be stopped, and is kept warm in between.

It is no daemon in Python's sense, for a build starts the kernel's process; it ends with its parent all the
same.
"""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import multiprocessing
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any, Final

from wrapit.errors import WrapItError
from wrapit.pipeline.output.guards import let_through
from wrapit.pipeline.worker import end_after_parent, nothing_on_stdout
from wrapit.units import printable

ORDERS: Final = "wrapit.studio.orders"
"""Where the orders are; imported there and not here, for it loads what takes a second."""
LEAVE_S: Final = 3.0
"""How long a stopped build may take to clear its folder away; it takes some 10 ms, 300 on a busy machine."""
Message = dict[str, Any]


class Bench:
    """Runs orders in a process; `tell` gets each message in the event loop, none of a stopped order.

    The last message of an order is `{"ended": None}` or `{"ended": {...}}` with what went wrong.
    """

    def __init__(self, tell: Callable[[Message], None]) -> None:
        self._tell = tell
        self._process: Any = None
        self._connection: Any = None
        self._busy = False
        self._number = 0
        self._leaving: list[threading.Thread] = []

    @property
    def is_busy(self) -> bool:
        """Whether an order is under way."""
        return self._busy

    def warm_up(self) -> None:
        """Starts the process, unless it runs; it imports what it needs while nobody waits."""
        if self._process is not None and self._process.is_alive():
            return
        context = multiprocessing.get_context("spawn")
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs,), name="wrapit-studio-bench")
        self._process.start()
        theirs.close()
        self._number += 1
        loop = asyncio.get_running_loop()
        listening = (self._connection, self._number, self._process, loop)
        threading.Thread(target=self._listen, args=listening, daemon=True).start()

    def order(self, name: str, *arguments: Any) -> None:
        """Starts an order, and stops the one before it."""
        if self._busy:
            self.stop()
        self.warm_up()
        assert self._connection is not None, "the process has been started"
        self._busy = True
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):  # the listener tells of its end
            self._connection.send((name, arguments))

    def stop(self) -> None:
        """Ends the process and what it started, in the background: the next order needn't wait for that."""
        process, self._process, self._busy = self._process, None, False
        self._number += 1  # what it still says is of no interest
        if process is not None:
            self._leaving = [each for each in self._leaving if each.is_alive()]
            self._leaving.append(threading.Thread(target=_end, args=(process,)))
            self._leaving[-1].start()

    def end(self) -> None:
        """Stops, and returns when all processes are gone."""
        self.stop()
        for each in self._leaving:
            each.join()

    def _listen(
        self, connection: Connection, number: int, process: Any, loop: asyncio.AbstractEventLoop
    ) -> None:
        while True:
            try:
                message = connection.recv()
            except (EOFError, OSError):
                break
            self._hand_over(loop, number, message)
        connection.close()
        process.join()
        problem = {
            "code": "stopped",
            "problem": f"the build's process ended (exit code {process.exitcode})",
            "where": "",
            "remedy": "close other programs if memory ran out, and try again",
        }
        self._hand_over(loop, number, {"ended": problem})

    def _hand_over(self, loop: asyncio.AbstractEventLoop, number: int, message: Message) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed: the program ends
            loop.call_soon_threadsafe(self._receive, number, message)

    def _receive(self, number: int, message: Message) -> None:
        if number != self._number or not self._busy:
            return
        if "ended" in message:
            self._busy = False
        self._tell(message)


def told(error: WrapItError) -> dict[str, str]:
    """A mistake as the page gets it."""
    return {
        "code": error.code,
        "problem": error.problem,
        "where": printable(error.where),
        "remedy": error.remedy,
    }


def _end(process: Any) -> None:
    process.terminate()
    process.join(LEAVE_S)
    if process.is_alive():
        process.kill()
        process.join()


def _serve(connection: Connection) -> None:
    end_after_parent()  # its kernel's process then ends with it
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is told, and stops this process
    signal.signal(signal.SIGTERM, _leave)
    let_through()
    nothing_on_stdout()
    orders = importlib.import_module(ORDERS)
    while True:
        try:
            name, arguments = connection.recv()
        except EOFError:
            return
        connection.send({"ended": _outcome(getattr(orders, name), connection, arguments)})


def _outcome(order: Callable[..., None], connection: Connection, arguments: Any) -> dict[str, str] | None:
    try:
        order(connection.send, *arguments)
    except WrapItError as error:
        return told(error)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        remedy = "check the path, its permissions and the disk"
        return {
            "code": "system",
            "problem": f"can't be read or written ({reason})",
            "where": str(error.filename or "output"),
            "remedy": remedy,
        }
    except Exception as error:  # noqa: BLE001  the page says that it is our mistake, the terminal which
        if signal.getsignal(signal.SIGTERM) is signal.SIG_IGN:  # a library made this of SystemExit
            raise SystemExit(128 + signal.SIGTERM) from None
        print(traceback.format_exc(), file=sys.stderr)
        summary = " ".join(f"{type(error).__name__}: {error}".split())[-300:]
        return {
            "code": "unexpected",
            "problem": f"unexpected ({summary})",
            "where": "",
            "remedy": "run wrapit build -vv with this config and report it",
        }
    return None


def _leave(signum: int, frame: object) -> None:  # noqa: ARG001  the signature is Python's
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # clearing away isn't to be ended half-way
    raise SystemExit(128 + signum)
