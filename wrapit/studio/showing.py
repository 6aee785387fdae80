"""What the stages make, as documents that a page can draw. Runs in the build's process: it knows curves."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Final

import numpy as np

from wrapit.decomposition.bridges import with_bridges
from wrapit.decomposition.model import Solution
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.model import Drawing
from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.pipeline.report import findings_list
from wrapit.pipeline.work import Work
from wrapit.studio.comparing import fit_document
from wrapit.wires.model import Wire

SAG_MM: Final = 0.05
"""Largest distance of a drawn polyline from its wire: half of what a screen shows at its usual 10 px a mm."""
STEP_MM: Final = 0.25
"""Between the points that a polyline chooses among; bends of 0.6 mm stray less than SAG_MM from them."""
# Micrometres are finer than any screen.
_DECIMALS: Final = 3
# How findings say where: along a wire, at a point of the piece, by a number of the drawing.
_ALONG: Final = re.compile(r"(wire-\d+) at (\d+(?:\.\d+)?)")
_POINT: Final = re.compile(r"^(?:at )?\((-?\d+(?:\.\d+)?), (-?\d+(?:\.\d+)?)\) mm$")
_WIRE: Final = re.compile(r"wire-\d+")
_NUMBERED: Final = re.compile(r"\b(segment|junction)s? (\d+)")


def shown_after(stage: str, work: Work) -> dict[str, Any]:
    """What a page shows anew after a stage: a part of the state's `shown`, and the findings so far."""
    news: dict[str, Any] = {"stage": stage, "timings_s": dict(work.timings_s)}
    if stage in ("drawing", "fit") and work.drawing is not None:
        news["drawing"] = drawing_document(work.drawing, work.config.decomposition.bridges)
        news["fit"] = fit_document(work.fitted, work.config)
    if stage == "decomposition" and work.solution is not None:
        news |= {"energy": asdict(work.solution.energy) | {"total": work.solution.energy.total}}
        news["optimal"] = work.solution.optimal
    if stage == "wires":
        news["wires"] = wire_documents(work.wires)
    return {"shown": news, "findings": placed(findings_list(work.findings), work)}


def drawing_document(drawing: Drawing, bridges: bool) -> dict[str, Any]:
    """The document of `drawing.json`, with the bridges on offer where they are asked for."""
    return json.loads(drawing_json(with_bridges(drawing) if bridges else drawing))


def wire_documents(wires: Sequence[Wire]) -> list[dict[str, Any]]:
    """What a page draws of each wire."""
    return [
        {
            "name": wire.name,
            "colour": wire.colour,
            "diameter_mm": round(wire.diameter_mm, _DECIMALS),
            "closed": wire.closed,
            "points": polyline(wire),
            "segments": [[each.segment, each.reversed] for each in wire.traversals],
            "length_mm": round(wire.length_mm, _DECIMALS),
            "cut_length_mm": round(wire.cut_length_mm, _DECIMALS),
        }
        for wire in wires
    ]


def alternative_documents(choices: Sequence[tuple[Solution, Sequence[Wire]]]) -> list[dict[str, Any]]:
    """What a page shows of each way to divide the drawing, the best first."""
    return [
        {
            "number": number,
            "wires": len(wires),
            "energy": asdict(solution.energy) | {"total": solution.energy.total},
            "total": solution.energy.total,
            "drawn": [{"colour": wire.colour, "points": polyline(wire)} for wire in wires],
        }
        for number, (solution, wires) in enumerate(choices, start=1)
    ]


def polyline(wire: Wire) -> list[list[float]]:
    """A wire's centreline as few points, within SAG_MM of it."""
    from shapely import LineString

    curve = ArcLength(wire.centreline)
    count = max(2, round(curve.total_mm / STEP_MM) + 1)
    points = wire.centreline.at(curve.parameter(np.linspace(0.0, curve.total_mm, count)))
    few = LineString(points).simplify(SAG_MM / 2, preserve_topology=False).coords
    return [_rounded(np.array(point)) for point in few]


def placed(findings: Sequence[dict[str, str]], work: Work) -> list[dict[str, Any]]:
    """Findings, each with the point of the piece that its `where` means, if it means one."""
    return [{**finding, "at": place(finding["where"], work)} for finding in findings]


def place(where: str, work: Work) -> list[float] | None:
    """The point of the piece that a finding's `where` means: on a wire, of a segment or junction.

    None where it means none; sheets and jigs have places of their own, which aren't the piece's.
    """
    wires = {wire.name: wire for wire in work.wires}
    if (named := _WIRE.search(where)) and named[0] in wires:
        wire = wires[named[0]]
        along = _ALONG.search(where)
        curve = ArcLength(wire.centreline)
        at_mm = float(along[2]) if along else curve.total_mm / 2
        return _rounded(wire.centreline.at(curve.parameter(np.array([at_mm])))[0])
    if point := _POINT.match(where):
        return [float(point[1]), float(point[2])]
    numbered = _NUMBERED.search(where)
    return _of_number(numbered[1], int(numbered[2]), work.drawing) if numbered and work.drawing else None


def _of_number(kind: str, number: int, drawing: Drawing) -> list[float] | None:
    parts: Sequence[Any] = drawing.segments if kind == "segment" else drawing.junctions
    if number >= len(parts):
        return None
    if kind == "junction":
        return _rounded(drawing.junctions[number].point)
    points = drawing.segments[number].curve.sampled(STEP_MM)
    return _rounded(points[len(points) // 2])


def _rounded(point: FloatArray) -> list[float]:
    return [round(float(value), _DECIMALS) + 0.0 for value in point]
