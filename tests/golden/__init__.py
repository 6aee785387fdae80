"""Golden numbers of our pieces: counts exactly, measures within tolerances, never bytes of the kernel."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent
RELATIVE, ABSOLUTE = 2e-3, 2e-3
BLOCKS = ("drawing", "decomposition", "wires", "jig", "plate")


def numbers(report: dict[str, Any]) -> dict[str, Any]:
    """The part of a report that is kept."""
    kept = {block: report[block] for block in BLOCKS if block in report}
    kept["findings"] = sorted({finding["code"] for finding in report["findings"]})
    kept["artifacts"] = sorted(artifact["path"] for artifact in report["artifacts"])
    return kept


def differences(golden: Any, fresh: Any, where: str = "") -> list[str]:
    """What differs, one line for each place; floats may differ by the tolerances."""
    if isinstance(golden, dict) and isinstance(fresh, dict):
        return [
            line
            for key in sorted(golden.keys() | fresh.keys())
            for line in differences(golden.get(key), fresh.get(key), f"{where}.{key}" if where else key)
        ]
    if isinstance(golden, list) and isinstance(fresh, list) and len(golden) == len(fresh):
        pairs = enumerate(zip(golden, fresh, strict=True))
        return [line for i, (a, b) in pairs for line in differences(a, b, f"{where}[{i}]")]
    if isinstance(golden, float) and isinstance(fresh, int | float) and not isinstance(fresh, bool):
        close = abs(golden - fresh) <= max(ABSOLUTE, RELATIVE * abs(golden))
        return [] if close else [f"{where}: {golden} became {fresh}"]
    same = type(golden) is type(fresh) and golden == fresh
    return [] if same else [f"{where}: {golden!r} became {fresh!r}"]


def path(name: str) -> Path:
    """Where the golden numbers of a piece are kept."""
    return FOLDER / f"{name}.json"


def read(name: str) -> dict[str, Any]:
    """The golden numbers of a piece."""
    return json.loads(path(name).read_text(encoding="utf-8"))
