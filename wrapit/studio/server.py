"""The server on this machine: begins, says its address, and ends as it is asked to."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Final

import uvicorn

from wrapit.errors import ConfigError
from wrapit.studio.application import application
from wrapit.studio.gate import Door
from wrapit.studio.session import Session

LEAVE_S: Final = 1
"""How long requests under way may take when the server is to end; each is answered in some ms."""


def serve(config: Path, output: Path | None, port: int, browser: bool) -> None:
    """Serves the page of a config until a signal ends it; prints its address when it listens.

    Raises ConfigError where the port can't be had.
    """
    with _listening(port) as listener:
        door = Door(listener.getsockname()[1])
        session = Session(config, output)
        logging.getLogger("uvicorn.error").addFilter(_is_worth_saying)
        settings = uvicorn.Config(
            application(session, door),
            log_config=None,
            access_log=False,
            server_header=False,
            proxy_headers=False,
            http="h11",
            ws="none",
            timeout_graceful_shutdown=LEAVE_S,
        )
        _Server(settings, session, door.link, browser).run([listener])


class _Server(uvicorn.Server):
    """Says its address once it listens; a signal ends it, and that is no failure."""

    def __init__(self, settings: uvicorn.Config, session: Session, link: str, browser: bool) -> None:
        super().__init__(settings)
        self._session, self._link, self._browser = session, link, browser

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            print(f"studio: {self._link}", flush=True)
            if self._browser:
                threading.Thread(target=_open, args=(self._link,), daemon=True).start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._session.leave()  # else each page's line of events would be waited for
        await super().shutdown(sockets)

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """The signals that end a program end the server; the library's own way raises them again."""
        names = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
        signals = [getattr(signal, name) for name in names if hasattr(signal, name)]
        earlier = {each: signal.getsignal(each) for each in signals}
        caught = [each for each in signals if earlier[each] is not signal.SIG_IGN]
        for each in caught:
            signal.signal(each, self._leave)
        try:
            yield
        finally:
            for each in caught:
                signal.signal(each, earlier[each])

    def _leave(self, signum: int, frame: FrameType | None) -> None:  # noqa: ARG002  Python's signature
        self.force_exit = self.should_exit
        self.should_exit = True


def _is_worth_saying(record: logging.LogRecord) -> bool:
    """Not that a signal cut off who hadn't sent or fetched all by then: to end is what was asked."""
    cut_off = record.exc_info is not None and isinstance(record.exc_info[1], asyncio.CancelledError)
    return not cut_off and "timeout graceful shutdown" not in str(record.msg)


def _listening(port: int) -> socket.socket:
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if sys.platform != "win32":  # there it would let another program listen on the same port
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(("127.0.0.1", port))
        return listener
    except (OSError, OverflowError) as error:
        listener.close()
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise ConfigError(f"port {port} can't be used ({reason})", "--port", "choose another, or 0") from None


def _open(link: str) -> None:
    import webbrowser

    try:
        first = type(webbrowser.get())
    except webbrowser.Error:
        first = None
    # One that shows pages in the terminal would take it from us; whoever set BROWSER wants what it says.
    in_terminal = first is webbrowser.GenericBrowser and not os.environ.get("BROWSER")
    if first is None or in_terminal or not webbrowser.open(link):
        print("no browser could be opened: open the link yourself", file=sys.stderr)
