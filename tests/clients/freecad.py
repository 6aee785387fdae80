"""Opens STEP files in FreeCAD, on a virtual screen."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

SCRIPT = Path(__file__).with_name("freecad_tree.py")


def tree(xvfb_run: str, freecad: str, files: list[Path], scratch: Path) -> dict[Path, dict[str, Any]]:
    """For each file the features that FreeCAD shows (label, volume, colour, curves) and the groups.

    All are opened by one FreeCAD, which takes seconds to start. Those are with "Enable STEP Compound merge"
    off; `as_it_comes` has the solids by label with it on.
    """
    seen, error = scratch / "seen.json", scratch / "seen.json.error"
    environment = {
        **os.environ,
        "STEP_FILES": os.pathsep.join(map(str, files)),
        "SEEN_JSON": str(seen),
        "QTWEBENGINE_DISABLE_SANDBOX": "1",
        "HOME": str(scratch),
    }
    command = [xvfb_run, "-a", freecad, str(SCRIPT)]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600, check=False)
    assert seen.is_file(), error.read_text() if error.is_file() else run.stdout + run.stderr
    return {Path(path): found for path, found in json.loads(seen.read_text()).items()}
