"""The page that says what each code means, from `wrapit/codes.py`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from wrapit.codes import ERRORS, FINDINGS, Saying

PAGE = Path(__file__).parents[2] / "wrapit" / "TROUBLESHOOTING.md"
HEAD = """\
# When something is said

A *finding* is something to know about a piece that was made; `report.json` holds them all, each with
its `code`, its place and a remedy of its own. An *error* ends a command without what it was to make, with
one line and an exit code; with `--json` the document has its code in `error.code`. Here is what each code
means, and what helps in general. (`make docs` writes this page from `codes.py`.)
"""


def page() -> str:
    """The whole page."""
    tables = [_table("Errors", ERRORS), *(_table(about, codes) for about, codes in FINDINGS.items())]
    return "\n".join([HEAD, *tables])


def _table(title: str, codes: Mapping[str, Saying]) -> str:
    rows = [f"| `{code}` | {codes[code].means} | {codes[code].helps} |" for code in sorted(codes)]
    return "\n".join([f"## {title}", "", "| code | means | what helps |", "|---|---|---|", *rows, ""])
