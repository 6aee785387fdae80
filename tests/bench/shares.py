"""What each stage takes of a whole build, beside loading the CAD libraries.

Run as `python -m tests.bench shares [config]`.

Each build starts cold, in a process of its own; seconds of the wall clock hold on an idle machine only, those
of the processor on any.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

IMPORTS = "import build123d, cadquery"
# How often the time of loading a whole build may take.
GOAL = 2.5
CONFIG = Path(__file__).parents[2] / "configs" / "butterfly.yaml"
_BUILD = """
import json, pathlib, sys
if __name__ == "__main__":
    from wrapit import build
    print(json.dumps(build(sys.argv[1], sys.argv[2]).timings_s))
"""


def main(words: list[str] | None = None) -> None:
    """Prints wall and processor seconds of each."""
    config = Path(words[0]) if words else CONFIG
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "cold.py"
        script.write_text(_BUILD, encoding="utf-8")
        loading_s, loading_cpu_s, _ = _timed([sys.executable, "-c", IMPORTS])
        whole_s, whole_cpu_s, said = _timed(
            [sys.executable, str(script), str(config.resolve()), str(Path(folder) / "out")]
        )
    print(f"{IMPORTS}: {loading_s:.1f} s, processor {loading_cpu_s:.1f} s")
    stages: dict[str, float] = json.loads(said)
    for stage, seconds in {"start and end": whole_s - sum(stages.values()), **stages}.items():
        print(f"  {stage:15s}{seconds:6.2f} s  {seconds / whole_s:4.0%}")
    busy = whole_cpu_s / whole_s
    print(
        f"{config.stem}: {whole_s:.1f} s, processor {whole_cpu_s:.1f} s, {busy:.1f} cores busy;"
        f" {whole_s / loading_s:.1f} × loading (goal {GOAL}), processor {whole_cpu_s / loading_cpu_s:.1f} ×"
    )


def _timed(command: list[str]) -> tuple[float, float, str]:
    """Wall and processor seconds, and what was printed; the checkout comes first in the path."""
    here = str(Path(__file__).parents[2])
    path = os.pathsep.join([here, *filter(None, [os.environ.get("PYTHONPATH")])])
    before, began = os.times(), time.perf_counter()
    run = subprocess.run(
        command, check=True, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": path}
    )
    wall_s, after = time.perf_counter() - began, os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return wall_s, used, run.stdout


if __name__ == "__main__":
    main(sys.argv[1:])
