"""What goes wrong outside of the piece: closed outputs, folders that can't be, a lost worker."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest

from tests.pipeline.folders import held, written_piece
from tests.pipeline.test_command_line import WRAPIT, refused, wrapit
from wrapit.errors import KernelError
from wrapit.pipeline.worker import Worker

ERROR_KEYS = {"code", "problem", "where", "remedy", "exit_code"}


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
@pytest.mark.parametrize("command", ["schema", "materials", "--help", "--version", "build", "build --json"])
def test_an_output_that_is_full(tmp_path: Path, command: str) -> None:
    words = command.split()
    if words[0] == "build":
        words[1:1] = [str(written_piece(tmp_path)), "-o", str(tmp_path / "out"), "--until", "wires"]
    with Path("/dev/full").open("w") as full:
        run = subprocess.run(
            [*WRAPIT, *words], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60, check=False
        )
    assert run.returncode == 1
    assert (
        run.stderr
        == "error: output: can't be read or written (no space left on device); free space on the disk\n"
    )


@pytest.mark.parametrize("command", ["schema", "materials", "--help", "build", "build --json"])
def test_a_reader_that_has_seen_enough(tmp_path: Path, command: str) -> None:
    words = command.split()
    if words[0] == "build":
        words[1:1] = [str(written_piece(tmp_path)), "-o", str(tmp_path / "out"), "--until", "drawing"]
    process = subprocess.Popen([*WRAPIT, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    process.stdout.close()
    assert process.stderr is not None
    assert process.stderr.read() == ""
    assert process.wait(60) in (0, 1)


@pytest.mark.parametrize("name", ["file/out", "file", "x" * 300, "loop", "loop/out", "x/" * 3000])
def test_an_output_folder_that_cannot_be(tmp_path: Path, name: str) -> None:
    config = written_piece(tmp_path)
    (tmp_path / "file").write_text("precious")
    (tmp_path / "loop").symlink_to("loop")
    before = held(tmp_path)
    refused(wrapit("build", config, "-o", tmp_path / name, "--until", "drawing"), 2, "-o")
    assert held(tmp_path) == before


def _cases(folder: Path) -> dict[str, tuple[int, list[str]]]:
    """Exit code and arguments of one failure of each kind."""
    config = written_piece(folder)
    (folder / "empty.yaml").write_text("drawing: none.svg")
    (folder / "file").write_text("precious")
    build = ["build", str(config), "-o", str(folder / "out")]
    return {
        "export": (1, ["build", str(config), "-o", "/proc/out"]),
        "kernel": (
            1,
            [*build, "--set", "jig.time_limit=1 s", "--set", "jigs=[printed]", "--set", "outputs=[stl]"],
        ),
        "config": (2, [*build, "--set", "size=40"]),
        "usage": (2, [*build, "--frobnicate"]),
        "drawing": (3, ["build", str(folder / "empty.yaml")]),
    }


@pytest.mark.parametrize("code", ["export", "kernel", "config", "usage", "drawing"])
def test_each_failure_is_one_document(tmp_path: Path, code: str) -> None:
    exit_code, arguments = _cases(tmp_path)[code]
    before = held(tmp_path)
    run = wrapit(*arguments, "--json")
    assert run.returncode == exit_code, run.stderr
    error = _document(run.stdout)["error"]
    assert error.keys() == ERROR_KEYS
    assert (error["code"], error["exit_code"]) == (code, exit_code)
    assert error["problem"]
    assert error["remedy"]
    assert run.stderr.startswith("error: ")
    assert len(run.stderr.splitlines()) == 1
    assert held(tmp_path) == before


def test_an_interrupted_build_is_one_document(tmp_path: Path) -> None:
    config = written_piece(tmp_path)
    process = subprocess.Popen(
        [*WRAPIT, "build", str(config), "-o", str(tmp_path / "out"), "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + 60
    while not list(tmp_path.glob(".out.*")) and time.monotonic() < deadline:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    out, told = process.communicate(timeout=60)
    assert process.returncode == 130
    assert _document(out)["error"].keys() == ERROR_KEYS
    assert _document(out)["error"]["exit_code"] == 130
    assert len(told.splitlines()) == 1


def _document(text: str) -> dict[str, Any]:
    """Strict JSON: one document, without the words that Python adds to it."""

    def refuse(word: str) -> None:
        raise AssertionError(word)

    document: dict[str, Any] = json.loads(text, parse_constant=refuse)
    return document


def test_any_terminal_will_do(tmp_path: Path) -> None:
    """One that knows ASCII alone gets what it can show."""
    config = written_piece(tmp_path, name="schön")
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    for arguments in (["build", str(config), "-o", str(tmp_path / "ö")], ["materials"], ["schema"]):
        stage = ["--until", "wires"] if arguments[0] == "build" else []
        for extra in ([], ["--json"]) if stage else ([],):
            run = subprocess.run(
                [*WRAPIT, *arguments, *stage, *extra],
                capture_output=True,
                env=environment,
                timeout=60,
                check=False,
            )
            assert (run.returncode, run.stderr) == (0, b"")
            assert run.stdout.isascii()
    assert _document((tmp_path / "ö" / "report.json").read_text(encoding="utf-8"))["name"] == "schön"


def _killed() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_worker_that_the_system_killed_ran_out_of_memory() -> None:
    with Worker() as worker:
        job = worker.start("piece: jig", 60, _killed)
        with pytest.raises(KernelError, match=r"memory runs out.*-j1") as lost:
            worker.result(job)
    assert lost.value.where == "piece: jig"


def test_a_time_limit_is_kept_and_can_be_raised(tmp_path: Path) -> None:
    config = written_piece(tmp_path, outputs=["stl"], jigs=["printed"])
    out = ("-o", tmp_path / "out")
    start = time.monotonic()
    refused(wrapit("build", config, *out, "--set", "jig.time_limit=1 s"), 1, "within 1 s", "jig.time_limit")
    assert time.monotonic() - start < 30
    assert wrapit("build", config, *out, "--set", "jig.time_limit=100 s").returncode == 0
