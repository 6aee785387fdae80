"""What a person reads after a build."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from wrapit.pipeline.build import Build

SHOWN_PER_KIND = 3


def summary_lines(result: Build) -> Iterator[str]:
    """A few lines: the drawing, the wires with their cut lengths, the jig, and where the files are."""
    report = result.report
    drawing = report["drawing"]
    width, height = drawing["size_mm"]
    yield f"{report['name']}: {drawing['segments']} segments, {width:.0f} × {height:.0f} mm"
    if "decomposition" in report:
        energy, optimal = report["decomposition"]["energy"], report["decomposition"]["optimal"]
        proof = ", proven best" if optimal else ""
        yield f"{_count(energy['complexity'], 'wire')}{proof}"
    for wire in report.get("wires", []):
        yield f"  {wire['name']}: cut {wire['cut_length_mm']:.0f} mm, {_count(wire['turns'], 'turn')}"
    if "jig" in report:
        jig = report["jig"]
        size = " × ".join(f"{value:.0f}" for value in jig["size_mm"])
        jigs = f"{jig['jigs']} jigs" if jig["jigs"] > 1 else "jig"
        bends = any(wire["turns"] for wire in report["wires"])
        held = f", {jig['turn_support']:.0%} of turns held" if bends else ""
        yield f"{jigs}: {_count(jig['walls'], 'wall')}, {size} mm{held}"
    if result.folder is not None:
        yield f"{'up to date' if result.up_to_date else 'written'}: {result.folder}"


def finding_lines(result: Build, *, every: bool) -> Iterator[str]:
    """Warnings and errors, one line each, the first few of a kind; with `every` all of them and notes."""
    findings = [f for f in result.report["findings"] if every or f["level"] != "note"]
    shown: Counter[str] = Counter()
    for finding in findings:
        shown[finding["code"]] += 1
        if every or shown[finding["code"]] <= SHOWN_PER_KIND:
            where = f"{finding['where']}: " if finding["where"] else ""
            remedy = f"; {finding['remedy']}" if finding["remedy"] else ""
            yield f"{finding['level']}: {where}{finding['message']}{remedy}"
    for code, number in shown.items():
        if not every and number > SHOWN_PER_KIND:
            yield f"and {number - SHOWN_PER_KIND} more of the kind {code!r} (-v shows all, the report too)"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
