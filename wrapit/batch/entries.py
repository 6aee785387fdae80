"""What `batch.json` says of each piece and of all together; no times, so that it stays the same."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, Final

from wrapit.batch.model import STATUSES, Outcome, Piece
from wrapit.batch.pricing import Prices
from wrapit.config import Config
from wrapit.materials import METALS
from wrapit.units import printable

# Files that the catalogue shows or leads to: the first of each kind that there is.
_SHOWN: Final = {
    "guide": ("guide.html", "guide.pdf"),
    "wires": ("decomposition.svg",),
    "preview": ("preview.png",),
}
# What is known of a piece when it is made.
_MADE: Final = (
    *("pair", "size_mm", "wires", "cut_length_mm", "metal", "mass_g", "cost", "difficulty", "minutes"),
    *("findings", "report", "files"),
)


def pending(piece: Piece) -> dict[str, Any]:
    """A piece that nobody has built yet."""
    return {
        "name": piece.name,
        "config": printable(str(piece.config_path)),
        "status": "pending",
        "exit_code": None,
        "error": None,
        **dict.fromkeys(_MADE),
    }


def entry_of(outcome: Outcome, folder: Path, prices: Prices) -> dict[str, Any]:
    """A piece that was dealt with; what is told of it is what the report in its folder says."""
    from wrapit.pipeline.output.ownership import REPORT, own_report

    piece, ended = outcome.piece, outcome.ended
    entry = pending(piece) | {"exit_code": ended.exit_code}
    report = own_report(folder / piece.name) if ended.error is None else None
    if report is None or piece.config is None:
        gone = {
            "code": "system",
            "problem": "the build's report is gone",
            "where": str(folder / piece.name),
            "remedy": "build it again with --resume",
        }
        error = ended.error if ended.error is not None else gone
        # Names of files may hold what neither a page nor a terminal should be given: halves of characters,
        # commands to the terminal.
        told = {key: printable(text) for key, text in error.items()}
        return entry | {"status": "failed", "exit_code": ended.exit_code or 1, "error": told}
    metal = list(_metal(report, piece.config, prices))
    return entry | {
        "status": "ok",
        "pair": piece.config.pair,
        "size_mm": report["drawing"]["size_mm"],
        "wires": _pieces(piece.config) * len(report["wires"]),
        "cut_length_mm": round(
            _pieces(piece.config) * sum(wire["cut_length_mm"] for wire in report["wires"]), 4
        ),
        "metal": metal,
        "mass_g": round(sum(each["mass_g"] for each in metal), 4),
        "cost": _sum(each["cost"] for each in metal),
        "difficulty": report.get("guide", {}).get("difficulty"),
        "minutes": report.get("guide", {}).get("minutes"),
        "findings": _levels(report),
        "report": f"{piece.name}/{REPORT}",
        "files": _files(piece.name, report),
    }


def totals(entries: Sequence[dict[str, Any]], prices: Prices) -> dict[str, Any]:
    """Of the pieces that are made: wires, metal by thickness, by metal, and what it costs."""
    made = [entry for entry in entries if entry["status"] == "ok"]
    lengths: dict[tuple[str, float], float] = defaultdict(float)
    masses: dict[tuple[str, float], float] = defaultdict(float)
    by_metal: dict[str, float] = defaultdict(float)
    for row in (row for entry in made for row in entry["metal"]):
        kind = row["metal"], -row["diameter_mm"]
        lengths[kind] += row["length_mm"]
        masses[kind] += row["mass_g"]
        by_metal[row["metal"]] += row["mass_g"]
    counts = Counter(entry["status"] for entry in entries)
    return {
        "pieces": len(entries),
        **{status: counts[status] for status in STATUSES},
        "wires": sum(entry["wires"] for entry in made),
        "cut_length_mm": round(sum(entry["cut_length_mm"] for entry in made), 4),
        "minutes": _sum(entry["minutes"] for entry in made),
        "metal": [
            {
                "metal": metal,
                "diameter_mm": -thin,
                "length_mm": round(lengths[metal, thin], 4),
                "mass_g": round(masses[metal, thin], 4),
                "cost": prices.cost(metal, masses[metal, thin]),
            }
            for metal, thin in sorted(lengths)
        ],
        "mass_g": {metal: round(mass, 4) for metal, mass in sorted(by_metal.items())},
        "cost": _sum(prices.cost(metal, mass) for metal, mass in sorted(by_metal.items())),
        "currency": prices.currency,
    }


def _metal(report: dict[str, Any], config: Config, prices: Prices) -> Iterator[dict[str, Any]]:
    """Each use of wire; without a guide there are no ties, so that only the wires themselves are known."""
    rows = report.get("guide", {}).get("materials")
    if rows is None:
        length_mm = _pieces(config) * sum(wire["cut_length_mm"] for wire in report["wires"])
        mass_g = METALS[config.wire.metal].mass_g(length_mm, config.wire.gauge)
        whole = {"diameter_mm": round(config.wire.gauge, 4), "length_mm": round(length_mm, 4)}
        rows = [{"use": "frame", **whole, "mass_g": round(mass_g, 4)}]
    for row in rows:
        yield {"metal": config.wire.metal, **row, "cost": prices.cost(config.wire.metal, row["mass_g"])}


def _pieces(config: Config) -> int:
    return 2 if config.pair else 1


def _levels(report: dict[str, Any]) -> dict[str, int]:
    counts = Counter(finding["level"] for finding in report["findings"])
    return {level: counts[level] for level in ("error", "warning", "note")}


def _files(name: str, report: dict[str, Any]) -> dict[str, str]:
    """Paths from the batch's folder; a file that had to make way for somebody's own has another name."""
    names = {a.get("instead_of", a["path"]): a["path"] for a in report["artifacts"]}
    found = {
        kind: next((f"{name}/{names[usual]}" for usual in usuals if usual in names), None)
        for kind, usuals in _SHOWN.items()
    }
    return {kind: path for kind, path in found.items() if path is not None}


def _sum(amounts: Iterable[float | None]) -> float | None:
    """Of those that are known; None where none is."""
    known = [amount for amount in amounts if amount is not None]
    return round(sum(known), 2) if known else None
