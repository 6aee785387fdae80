"""What strangers bring, scored as the folder of cases scores it, beside the goals.

Run as `python -m tests.bench cases [svg|resvg|bitmap|icons …]`; the folder is looked for in $WRAPIT_CASES and
next to the checkout.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import os
import re
import sys
from pathlib import Path
from typing import Any

CASES = Path(os.environ.get("WRAPIT_CASES", Path(__file__).parents[3] / "shared" / "cases"))
# How many of each kind are to be right.
GOALS = {"svg": 29, "resvg": 150, "bitmap": 53, "icons": 46}


def scorer(cases: Path = CASES) -> Any:
    """The cases' own `compare.py` as a module. Raises FileNotFoundError where it isn't."""
    spec = importlib.util.spec_from_file_location("cases_compare", cases / "compare.py")
    if spec is None or spec.loader is None or not (cases / "compare.py").exists():
        raise FileNotFoundError(cases / "compare.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def main(kinds: list[str] | None = None) -> None:
    """Prints what is wrong, and for each kind its share with the goal beside."""
    try:
        compare = scorer()
    except FileNotFoundError:
        print("the folder of cases is not here; set WRAPIT_CASES")
        return
    for kind in kinds or GOALS:
        if kind == "resvg" and importlib.util.find_spec("resvg_py") is None:
            print("resvg: the renderer is not here: pip install resvg_py")
            continue
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            compare.main(kind)
        *wrong, share = said.getvalue().splitlines()
        found = re.search(r"(\d+) of (\d+)", share)
        if found is None:
            raise ValueError(f"compare.py says {share!r}, which is no share")
        reached = "reached" if int(found[1]) >= GOALS[kind] else "NOT reached"
        print("\n".join(wrong))
        print(f"{kind}: {found[1]} of {found[2]}, goal {GOALS[kind]}: {reached}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
