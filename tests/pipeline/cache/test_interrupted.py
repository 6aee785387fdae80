"""Builds that are killed, and builds beside each other: entries are whole or missing, files are right."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.pipeline.folders import held, written_piece
from tests.pipeline.test_command_line import WRAPIT
from wrapit.pipeline.build import build
from wrapit.pipeline.cache.sealed import opened

# Kills one store amid each of so many entries.
_WRITING = """
import sys
from pathlib import Path
from wrapit.pipeline.cache.sealed import Entry
from wrapit.pipeline.cache.store import Store
store = Store(Path(sys.argv[1]), 1 << 40)
print("ready", flush=True)
while True:
    for number in range(8):
        store.put(f"key{number}", Entry({"number": number}, {"file": bytes([number]) * 3_000_000}, b"value"))
"""
# So many kills, and more until one came amid a file, which luck and a busy machine may put off.
KILLED, MOST_KILLED = 12, 100
PATIENCE_S = 20.0


def _started(config: Path, out: Path) -> subprocess.Popen[bytes]:
    command = [*WRAPIT, "build", str(config), "-o", str(out), "--until", "wires", "-q"]
    return subprocess.Popen(command, start_new_session=True)


def _all_whole(cache: Path) -> int:
    entries = list(cache.glob("*.entry"))
    for entry in entries:
        opened(entry.stem, entry.read_bytes())  # raises where it isn't whole
    return len(entries)


def _unfinished(cache: Path) -> set[str]:
    return {file.name for file in os.scandir(cache) if file.name.endswith(".partial")}


def _await_writing(cache: Path, before: set[str]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not _unfinished(cache) - before and time.monotonic() < deadline:
        pass


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_kill_9_amid_writing_leaves_whole_entries_or_none(tmp_path: Path) -> None:
    chance, kills, amid = random.Random(16), 0, 0
    while kills < KILLED or (not amid and kills < MOST_KILLED):
        before, kills = _unfinished(tmp_path), kills + 1
        process = subprocess.Popen(
            [WRAPIT[0], "-c", _WRITING, str(tmp_path)], stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        time.sleep(chance.uniform(0.0, 0.1))
        if kills % 2:  # most of its time goes into hashing: at any moment, few kills come amid a file
            _await_writing(tmp_path, before)
        process.kill()
        process.wait()
        process.stdout.close()
        _all_whole(tmp_path)
        amid += bool(_unfinished(tmp_path) - before)
    assert amid, "no kill came amid an entry: this tested nothing"
    assert _all_whole(tmp_path) > 0


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_after_a_killed_build_the_next_one_is_right(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config, chance = written_piece(tmp_path), random.Random(61)
    killed = 0
    for number in range(6):
        process = _started(config, tmp_path / "killed")
        time.sleep(chance.uniform(0.3, 1.5) + 0.2 * number)
        killed += process.poll() is None
        os.killpg(process.pid, signal.SIGKILL) if process.poll() is None else None
        process.wait()
        _all_whole(cache)
    assert killed, "all were done before they were killed"
    build(config, tmp_path / "next", until="wires")
    monkeypatch.setenv("WRAPIT_CACHE", "off")
    build(config, tmp_path / "off", until="wires")
    assert held(tmp_path / "next") == held(tmp_path / "off")


def test_builds_beside_each_other(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    config = written_piece(tmp_path)
    outs = [tmp_path / f"out{number}" for number in range(3)]
    processes = [_started(config, out) for out in outs]
    assert [process.wait(300) for process in processes] == [0] * len(outs)
    assert _all_whole(cache) > 0
    assert list(cache.glob(".*")) == []
    monkeypatch.setenv("WRAPIT_CACHE", "off")
    build(config, tmp_path / "off", until="wires")
    assert all(held(out) == held(tmp_path / "off") for out in outs)
