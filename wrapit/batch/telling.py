"""What a person reads of a batch: a line as each piece is done, and a table at the end."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rich.cells import cell_len

from wrapit.batch.model import INDEX, Outcome
from wrapit.errors import WrapItError


def done_line(outcome: Outcome, entry: dict[str, Any], *, number: int, count: int) -> str:
    """A piece that is done: its name, how it went, wires, seconds, or the reason."""
    beginning = f"[{number}/{count}] {entry['name']}:"
    if entry["status"] != "ok":
        return f"{beginning} failed: {reason(entry)}"
    how = "up to date" if outcome.kept else f"ok in {outcome.seconds:.1f} s"
    return f"{beginning} {how}, {_count(entry['wires'], 'wire')}"


def reason(entry: dict[str, Any]) -> str:
    """Why a piece failed, in one line with its place and remedy."""
    error = entry["error"]
    return str(WrapItError(error["problem"], error["where"], error["remedy"]))


def amount(cost: float | None, currency: str) -> str:
    """What something costs; empty where nobody knows."""
    return "" if cost is None else f"{cost:.2f} {currency}".rstrip()


def length(length_mm: float) -> str:
    """As long as wire is sold and cut."""
    return f"{length_mm / 1000:.2f} m"


def duration(minutes: float | None) -> str:
    """About how long hands take; empty where nobody knows."""
    if minutes is None:
        return ""
    hours, rest = divmod(round(minutes / 5) * 5, 60)
    return f"{hours} h {rest} min" if hours else f"{max(5, rest)} min"


def summary_lines(document: dict[str, Any], folder: Path) -> Iterator[str]:
    """A row for each piece under a head, the metal of all, and where the catalogue is."""
    pieces, totals = document["pieces"], document["totals"]
    head = ("piece", "wires", "cut", "metal", "cost", "difficulty", "warnings")
    rows = [_row(entry, totals["currency"]) for entry in pieces]
    shown = [column for column in range(len(head)) if any(row[column] for row in rows)] or [0]
    widths = [max(cell_len(row[column]) for row in (head, *rows)) for column in range(len(head))]
    for row, entry in zip((head, *rows), (None, *pieces), strict=True):
        cells = (_aligned(row[column], widths[column], column) for column in shown)
        failure = f"  failed: {reason(entry)}" if entry is not None and entry["status"] == "failed" else ""
        yield f"{'  '.join(cells)}".rstrip() if not failure else f"{_aligned(row[0], widths[0], 0)}{failure}"
    for row in totals["metal"]:
        cost = amount(row["cost"], totals["currency"])
        yield (
            f"{row['metal']}, {row['diameter_mm']:.2f} mm: {length(row['length_mm'])}, {row['mass_g']:.1f} g"
            f"{f', {cost}' if cost else ''}"
        )
    failures = f", {totals['failed']} failed" if totals["failed"] else ""
    yield f"{_count(totals['pieces'], 'piece')}, {totals['ok']} ok{failures}: {folder / INDEX}"


def _row(entry: dict[str, Any], currency: str) -> tuple[str, ...]:
    if entry["status"] != "ok":
        return (entry["name"], "", "", "", "", "", "")
    told = entry["findings"]["error"] + entry["findings"]["warning"]
    return (
        entry["name"],
        str(entry["wires"]),
        length(entry["cut_length_mm"]),
        f"{entry['mass_g']:.1f} g",
        amount(entry["cost"], currency),
        entry["difficulty"] or "",
        str(told),
    )


def _aligned(cell: str, width: int, column: int) -> str:
    """The cell with spaces; some letters are two columns wide, accents none."""
    spaces = " " * (width - cell_len(cell))
    return f"{cell}{spaces}" if column in (0, 5) else f"{spaces}{cell}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
