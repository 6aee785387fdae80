"""A build that is killed is tried once more; then it fails, and says what ended it."""

from __future__ import annotations

import errno
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from wrapit.batch import processes
from wrapit.batch.processes import Processes

DONE = 'print(\'{"timings_s": {"wires": 1.5}}\')'
INTERRUPTED = (
    'print(\'{"error": {"code": "interrupted", "problem": "p", "where": "", "remedy": ""}}\');'
    "raise SystemExit(143)"
)
KILLED = "import os, signal;os.kill(os.getpid(), signal.SIGKILL)"
FIRST_KILLED = (
    "import pathlib\nif not pathlib.Path({0!r}).exists():\n  pathlib.Path({0!r}).touch()\n  {1}\n{2}"
)


def script(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    """What runs instead of a build."""
    monkeypatch.setattr(processes, "_command", lambda *arguments: [sys.executable, "-c", text])


@pytest.mark.parametrize("end", [KILLED, INTERRUPTED.replace(";", "\n  ")])
def test_once_killed_it_is_tried_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, end: str) -> None:
    script(monkeypatch, FIRST_KILLED.format(str(tmp_path / "seen"), end, DONE))
    ended = Processes().build(Path("a.yaml"), tmp_path, ())
    assert ended.exit_code == 0
    assert ended.error is None
    assert ended.timings_s == {"wires": 1.5}


@pytest.mark.parametrize(
    ("end", "code", "how"),
    [
        (KILLED, 137, "signal 9"),
        (INTERRUPTED, 143, "exit code 143"),
        ("raise SystemExit('no such module')", 1, "exit code 1: no such module"),
        ("", 1, "exit code 0"),
    ],
)
def test_killed_twice_it_fails_with_that_reason(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, end: str, code: int, how: str
) -> None:
    count = tmp_path / "count"
    script(monkeypatch, f"open({str(count)!r}, 'a').write('x')\n{end.replace(';', chr(10))}")
    ended = Processes().build(Path("a.yaml"), tmp_path, ())
    assert count.read_text() == "xx"
    assert ended.exit_code == code
    assert ended.error is not None
    assert ended.error["code"] == "killed"
    assert how in ended.error["problem"]
    assert ended.error["where"] == "a.yaml"


def test_where_no_process_starts_that_piece_fails(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def refused(*_: object, **__: object) -> None:
        raise BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable")

    monkeypatch.setattr(subprocess, "Popen", refused)
    ended = Processes().build(Path("a.yaml"), tmp_path, ())
    assert ended.error is not None
    assert ended.exit_code == 1
    assert ended.error["where"] == "a.yaml"
    assert "resource temporarily unavailable" in ended.error["problem"]


def test_stopped_nothing_is_tried_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    count = tmp_path / "count"
    script(monkeypatch, f"import time\nopen({str(count)!r}, 'a').write('x')\ntime.sleep(60)")
    running = Processes()
    thread = threading.Thread(target=running.build, args=(Path("a.yaml"), tmp_path, ()))
    thread.start()
    while not count.exists() or not count.read_text():
        time.sleep(0.01)
    running.stop()
    thread.join(20)
    assert not thread.is_alive()
    running.build(Path("b.yaml"), tmp_path, ())
    assert count.read_text() == "x"
