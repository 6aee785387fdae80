"""What a person reads after a build."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from typing import Any

from wrapit.pipeline.build import Build
from wrapit.pipeline.exporting import ALTERNATIVES, FEWER_WIRES

# In the order in which they are told.
LEVELS = ("error", "warning", "note")
# What there may be, its picture, and what a command takes of it.
OTHER_WIRES = (("alternatives", ALTERNATIVES, "one"), ("fewer wires", FEWER_WIRES, "the fewest"))


def summary_lines(result: Build, take: Mapping[str, str] = {}) -> Iterator[str]:
    """A few lines: the drawing, the wires with their cut lengths, the jig, and where the files are.

    `take` are commands that build the piece with other wires, by what they are; each is shown behind the
    picture of these.
    """
    report = result.report
    drawing = report["drawing"]
    width, height = drawing["size_mm"]
    yield f"{report['name']}: {_count(drawing['segments'], 'segment')}, {width:.0f} × {height:.0f} mm"
    if "fit" in report:
        yield fit_line(report["fit"])
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
        yield f"{jigs}: {_count(jig['walls'], 'wall')}, {size} mm, {jig['held']:.0%} of the wires held"
        if "interference_mm3" in jig:
            yield f"the kernel's booleans find {jig['interference_mm3']:g} mm³ of jig in wires and channels"
    if result.folder is not None:
        yield _where(result)
        pictures = {each.get("instead_of", each["path"]): each["path"] for each in report["artifacts"]}
        for what, picture, one in OTHER_WIRES:
            if what in take and picture in pictures:
                yield f"{what}: {result.folder / pictures[picture]}; take {one} with: {take[what]}"


def fit_line(fit: dict[str, Any]) -> str:
    """What was changed to make the drawing fit, from its block of the report."""
    before, after = fit["before"], fit["after"]
    if fit["level"] != "off":
        name = f"fit {fit['level']}"
    else:
        name = "left out as asked" if "dropped" in fit["changes"] else "with beads"
    tight = "no bend" if not after["tight_bends"] else _count(after["tight_bends"], "bend")
    parts = [
        f"{before['segments']} -> {_count(after['segments'], 'segment')}",
        f"{before['wires']} -> {_count(after['wires'], 'wire')}",
        f"{tight} too tight",
        *([_count(len(fit["beads"]), "bead")] if fit["beads"] else []),
    ]
    gone = "left out or beads" if fit["beads"] else "left out"
    return f"{name}: {', '.join(parts)}; {fit['left_out_share']:.0%} of the lines {gone}"


def _where(result: Build) -> str:
    if not result.up_to_date:
        return f"written: {result.folder}"
    reached = result.report["until"]
    fuller = "" if reached == result.asked else f"; it holds a build until {reached}, which stays as it is"
    return f"up to date: {result.folder}{fuller}"


def finding_lines(result: Build, *, every: bool) -> Iterator[str]:
    """Errors and warnings, one line for each kind: how many there are and the worst of them.

    With `every`, each of them has its line, and notes too.
    """
    shown = [f for f in result.report["findings"] if every or f["level"] != "note"]
    ordered = sorted(shown, key=lambda finding: LEVELS.index(finding["level"]))
    for _, same in itertools.groupby(ordered, key=lambda f: (f["level"], f["code"])):
        kind = list(same)
        if every:
            yield from map(_line, kind)
        else:
            yield _line(kind[0], others=len(kind) - 1)


def timing_lines(result: Build) -> Iterator[str]:
    """What each stage took, and whether the cache held all of it."""
    for stage, seconds in result.timings_s.items():
        yield f"{stage:<14}{seconds:7.2f} s{' from the cache' if stage in result.cached else ''}"


def _line(finding: dict[str, Any], others: int = 0) -> str:
    more = f" (the worst of {others + 1}; -v shows all)" if others else ""
    where = f"{finding['where']}: " if finding["where"] else ""
    remedy = f"; {finding['remedy']}" if finding["remedy"] else ""
    return f"{finding['level']}: {where}{finding['message']}{more}{remedy}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
