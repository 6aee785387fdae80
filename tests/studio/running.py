"""The real command, started as a person does, and asked as a page does."""

from __future__ import annotations

import contextlib
import http.client
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent.parent
PICTURE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="65mm" height="40mm" viewBox="0 0 65 40">'
    '<path d="M 5 20 C 5 0 45 0 45 20 C 45 40 5 40 5 20 Z M 45 20 L 60 20" fill="none" stroke="black"/></svg>'
)
CONFIG = "# ours\nname: leaf\ndrawing: leaf.svg  # by hand\nsize: 60 mm\njigs: [pegs]\noutputs: [html]\n"
# A quick piece is built in a second; the machine may be busy with ten others.
PATIENCE_S = 120.0


class Studio:
    """A running `wrapit studio`; `ask` and `post` know its token and origin."""

    def __init__(self, folder: Path, *arguments: str) -> None:
        self.folder, self.config = folder, folder / "leaf.yaml"
        command = [sys.executable, "-m", "wrapit", "studio", *arguments, "--port", "0", "--no-browser"]
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        self.process = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        assert self.process.stdout is not None
        self.line = self.process.stdout.readline()
        if not self.line:
            raise AssertionError(self.process.communicate()[1])
        address, _, self.token = self.line.removeprefix("studio: ").strip().partition("/?token=")
        self.origin = address
        self.port = int(address.rpartition(":")[2])

    def raw(
        self, method: str, target: str, headers: dict[str, str] | None = None, body: bytes | None = None
    ) -> tuple[int, dict[str, str], bytes]:
        """Status, headers and body of a request as it is given, path untouched."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        with contextlib.closing(connection):
            connection.putrequest(method, target, skip_host="Host" in (headers or {}))
            for name, value in (headers or {}).items():
                connection.putheader(name, value)
            if body is not None:
                connection.putheader("Content-Length", str(len(body)))
            connection.endheaders(body)
            answer = connection.getresponse()
            return answer.status, {k.lower(): v for k, v in answer.getheaders()}, answer.read()

    @property
    def cookie(self) -> dict[str, str]:
        return {"Cookie": f"wrapit-{self.port}={self.token}"}

    def ask(self, target: str) -> tuple[int, dict[str, str], bytes]:
        return self.raw("GET", target, self.cookie)

    def post(self, target: str, document: Any) -> tuple[int, Any]:
        headers = self.cookie | {"Origin": self.origin, "Content-Type": "application/json"}
        status, _, body = self.raw("POST", target, headers, json.dumps(document).encode())
        return status, json.loads(body)

    def state(self) -> dict[str, Any]:
        status, _, body = self.ask("/state")
        assert status == 200, body
        return json.loads(body)

    def until(self, holds: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The first state for which something holds."""
        end = time.monotonic() + PATIENCE_S
        while not holds(state := self.state()):
            shown = {key: state[key] for key in ("problem", "building", "fresh", "text")}
            assert time.monotonic() < end, shown
            time.sleep(0.1)
        return state

    def built(self) -> dict[str, Any]:
        return self.until(lambda state: state["fresh"])

    def stop(self, signum: int = signal.SIGTERM) -> tuple[int, str]:
        """Its exit code and what it said on stderr."""
        self.process.send_signal(signum)
        _, said = self.process.communicate(timeout=30)
        return self.process.returncode, said


def with_piece(folder: Path, config: str = CONFIG) -> Path:
    """A folder that holds a config and its drawing."""
    (folder / "leaf.svg").write_text(PICTURE)
    (folder / "leaf.yaml").write_bytes(config.encode())
    return folder


@contextlib.contextmanager
def running(folder: Path, *arguments: str) -> Iterator[Studio]:
    studio = Studio(folder, *arguments)
    try:
        yield studio
    finally:
        if studio.process.poll() is None:
            studio.process.kill()
        studio.process.wait()
        for stream in (studio.process.stdout, studio.process.stderr):
            if stream is not None:
                stream.close()
