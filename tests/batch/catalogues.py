"""Small pieces that are built in a second or two, and batches of them in processes of their own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.pipeline.folders import PIECE

ROOT = Path(__file__).parent.parent.parent
# No kernel: a guide, and pegs on a board.
QUICK = {"jigs": ["pegs"], "outputs": ["html"]}
# Nothing here takes so long but where it hangs.
PATIENCE_S = 120.0


def ring(folder: Path, stem: str, **settings: Any) -> Path:
    """The config of a ring, which is built soon."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ring.svg").write_text(PIECE, encoding="utf-8")
    config = folder / f"{stem}.yaml"
    config.write_text(json.dumps({"drawing": "ring.svg", **QUICK, **settings}), encoding="utf-8")
    return config


def started(folder: Path, *arguments: object) -> subprocess.Popen[str]:
    """`wrapit batch` in this folder, writing to `out`."""
    return subprocess.Popen(
        [sys.executable, "-m", "wrapit", "batch", *map(str, arguments), "-o", "out"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(folder: Path, *arguments: object) -> tuple[int, str, str]:
    """Exit code, stdout and stderr of the same."""
    process = started(folder, *arguments)
    said, complaint = process.communicate(timeout=PATIENCE_S)
    return process.returncode, said, complaint


def ledger(folder: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((folder / "out" / "batch.json").read_text(encoding="utf-8"))
    return document


def statuses(folder: Path) -> dict[str, str]:
    return {piece["name"]: piece["status"] for piece in ledger(folder)["pieces"]}


def builds(parent: int | None, name: str) -> list[int]:
    """Processes that build a piece of this name: those that another one started, or anybody's."""
    found = []
    for process in Path("/proc").iterdir():
        try:
            command = (process / "cmdline").read_bytes().decode().split("\0")
            above = int((process / "stat").read_text().rpartition(")")[2].split()[1])
        except (OSError, ValueError, IndexError):
            continue
        called = any(Path(part).name in (name, f"{name}.yaml") for part in command)
        if "build" in command and called and parent in (None, above):
            found.append(int(process.name))
    return found


def awaited(look: Callable[[], Any], what: str) -> Any:
    """What a look finds, as soon as it finds something."""
    deadline_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline_s:
        if found := look():
            return found
        time.sleep(0.02)
    raise AssertionError(f"{what}: not seen in {PATIENCE_S:.0f} s")
