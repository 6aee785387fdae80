"""Builds in processes of their own: a crash, or a kill from outside, ends one of them and no other."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import wrapit
from wrapit.batch.model import Ended

# Builds are tried so often where somebody else ends them: a second time they may find more memory.
TRIES: Final = 2
# How long builds that are asked to end may take: clearing away is quick, the kernel's process is given 2 s.
_ENDING_S: Final = 10.0
# Of what a build said last, so much goes into a reason: a line of a terminal or two.
_LAST_WORDS: Final = 200


class Processes:
    """Builds that run; from any thread. `stop` ends them all, and lets none begin any more."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._running: set[subprocess.Popen[str]] = set()
        self._stopping = False

    def build(self, config: Path, folder: Path, overrides: Sequence[str]) -> Ended:
        """Builds a config into a folder; one that is killed is tried once more."""
        command = _command(config, folder, overrides)
        for _ in range(TRIES):
            try:
                exit_code, said, complaint = self._run(command)
            except OSError as error:
                return _unstarted(error, config)
            document = _document(said)
            if document is not None and document.get("error", {}).get("code") != "interrupted":
                return _ended(exit_code, document)
            if self._stopping:
                break
        return _killed(exit_code, complaint, config)

    def stop(self) -> None:
        """Asks all builds to end, and ends those that don't."""
        with self._lock:
            self._stopping = True
            running = list(self._running)
        for process in running:
            process.terminate()
        deadline_s = time.monotonic() + _ENDING_S
        for process in running:
            try:
                process.wait(max(0.0, deadline_s - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()

    def _run(self, command: Sequence[str]) -> tuple[int, str, str]:
        with self._lock:
            if self._stopping:
                return -signal.SIGTERM, "", ""
            process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                encoding="utf-8",
                errors="replace",
                env=_environment(),
            )
            self._running.add(process)
        try:
            said, complaint = process.communicate()
        finally:
            with self._lock:
                self._running.discard(process)
        return process.returncode, said, complaint


def _command(config: Path, folder: Path, overrides: Sequence[str]) -> list[str]:
    """`-P`: a folder called wrapit where somebody works is not the program."""
    settings = [part for override in overrides for part in ("--set", override)]
    program = [sys.executable, "-P", "-m", "wrapit", "build", "--json", "--quiet"]
    return [*program, "--output", str(folder), *settings, "--", str(config)]


def _environment() -> dict[str, str]:
    """The build is made by this very wrapit, wherever it was imported from, and speaks UTF-8."""
    here = str(Path(wrapit.__file__).resolve().parent.parent)
    others = os.environ.get("PYTHONPATH")
    paths = here if not others else f"{here}{os.pathsep}{others}"
    return {**os.environ, "PYTHONPATH": paths, "PYTHONIOENCODING": "utf-8"}


def _document(said: str) -> dict[str, Any] | None:
    """The document that a build ends with; None where it didn't get so far."""
    with contextlib.suppress(ValueError):
        document = json.loads(said)
        return document if isinstance(document, dict) else None
    return None


def _ended(exit_code: int, document: dict[str, Any]) -> Ended:
    error = document.get("error")
    if error is None:
        return Ended(exit_code, None, document.get("timings_s", {}))
    return Ended(exit_code, {key: str(error[key]) for key in ("code", "problem", "where", "remedy")})


def _unstarted(error: OSError, config: Path) -> Ended:
    told = {
        "code": "system",
        "problem": f"no process could be started for the build ({(error.strerror or str(error)).lower()})",
        "where": str(config),
        "remedy": "end other programs, or take fewer --jobs, and go on with --resume",
    }
    return Ended(1, told)


def _killed(exit_code: int, complaint: str, config: Path) -> Ended:
    how = f"signal {-exit_code}" if exit_code < 0 else f"exit code {exit_code}"
    last = complaint.strip().rpartition("\n")[2][-_LAST_WORDS:]
    words = f": {last}" if last and exit_code > 0 else ""
    told = {
        "code": "killed",
        "problem": f"the build was ended from outside, also when tried again ({how}{words})",
        "where": str(config),
        "remedy": "make sure that memory suffices, for example with --jobs 1, and go on with --resume",
    }
    return Ended(128 - exit_code if exit_code < 0 else max(1, exit_code), told)
