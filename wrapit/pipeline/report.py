"""`report.json`: every number, finding and artifact of a build; no timings, so that it stays the same."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from wrapit import __version__
from wrapit.config import Config, lock_text
from wrapit.decomposition.json_file import decomposition_summary
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.jig.model import Jig, JigSet, TurnSupport
from wrapit.jig.sheet.model import LaserJig
from wrapit.jig.support import stretch_support, total_support
from wrapit.pipeline.ownership import FORMAT, Artifact
from wrapit.wires.model import JumpRing, Wire
from wrapit.wires.springback import Overbent

HEAD_KEYS = ("format", "name", "version", "config_sha256", "drawing_sha256")


def head(config: Config, drawing_sha256: str) -> dict[str, Any]:
    """What identifies a build."""
    return {
        "format": FORMAT,
        "name": config.name,
        "version": __version__,
        "config_sha256": hashlib.sha256(lock_text(config).encode()).hexdigest(),
        "drawing_sha256": drawing_sha256,
    }


def drawing_numbers(drawing: Drawing, with_bridges: Drawing) -> dict[str, Any]:
    """The `drawing` block; the second drawing has the bridges that are offered."""
    low, high = drawing.bounds_mm
    strokes = [segment for segment in drawing.segments if segment.kind == "stroke"]
    degrees = Counter(end for segment in strokes for end in (segment.start, segment.end))
    return {
        "junctions": len(drawing.junctions),
        "odd_junctions": sum(degree % 2 for degree in degrees.values()),
        "segments": len(strokes),
        "length_mm": _mm(sum(segment.curve.length for segment in strokes)),
        "size_mm": [_mm(value) for value in high - low],
        "bridges_offered": len(with_bridges.segments) - len(strokes),
    }


def decomposition_numbers(solution: Solution, fewest_possible_wires: int) -> dict[str, Any]:
    """The `decomposition` block."""
    return {**decomposition_summary(solution), "fewest_possible_wires": fewest_possible_wires}


def wire_numbers(wires: Sequence[Wire]) -> list[dict[str, Any]]:
    """The `wires` block."""
    return [
        {
            "name": wire.name,
            "length_mm": _mm(wire.length_mm),
            "cut_length_mm": _mm(wire.cut_length_mm),
            "turns": sum(turn.inside != "both" for turn in wire.turns),
            "connections": len(wire.bindings),
            "min_bend_radius_mm": _mm(wire.min_bend_radius_mm),
            "max_deviation_from_drawing_mm": _mm(wire.max_deviation_from_drawing_mm),
            "layers": wire.layers,
            "mass_g": round(wire.mass_g, 4),
        }
        for wire in wires
    ]


def jig_numbers(jigs: JigSet, wires: Sequence[Wire]) -> dict[str, Any]:
    """The `jig` block, over all jigs of the piece."""
    support = [each for jig in jigs.jigs for each in jig.support]
    by_wire = {
        wire.name: round(total_support(each for each in support if each.turn.wire == wire.name), 4)
        for wire in wires
    }
    weakest = min(by_wire, key=lambda name: (by_wire[name], name))
    distances = [jig.min_wall_to_wire_mm for jig in jigs.jigs if jig.min_wall_to_wire_mm is not None]
    seats = sum(len(jig.plan.seats) for jig in jigs.jigs)
    return {
        "kind": "printed",
        "split": jigs.split,
        "jigs": len(jigs.jigs),
        "solids": sum(jig.solids for jig in jigs.jigs),
        "valid": all(jig.valid for jig in jigs.jigs),
        "volume_mm3": round(sum(jig.volume_mm3 for jig in jigs.jigs), 3),
        "walls": sum(len(jig.walls) for jig in jigs.jigs),
        "holes": sum(len(jig.plan.holes) for jig in jigs.jigs),
        **({"seats": seats} if seats else {}),
        "turn_support": round(total_support(support), 4),
        "turn_support_by_wire": by_wire,
        "weakest": {"wire": weakest, "turn_support": by_wire[weakest]},
        "stretch_support": round(stretch_support(support), 4),
        "turns": [_turn_numbers(jig, each) for jig in jigs.jigs for each in jig.support],
        "min_wall_to_wire_mm": round(min(distances), 6) if distances else None,
        "size_mm": [_mm(max(jig.size_mm[axis] for jig in jigs.jigs)) for axis in range(3)],
    }


def _turn_numbers(jig: Jig, support: TurnSupport) -> dict[str, Any]:
    turn = support.turn
    pin = next((pin.diameter_mm for pin in jig.plan.pins if pin.turn == turn), None)
    bend = turn.max_curvature_per_mm
    return {
        "wire": turn.wire,
        "from_mm": _mm(turn.start_mm),
        "to_mm": _mm(turn.end_mm),
        "inside": turn.inside,
        "min_radius_mm": _mm(1 / bend) if bend > 0 else None,
        "support": round(support.share, 4),
        "pin_mm": pin,
    }


def bail_numbers(wires: Sequence[Wire], ring: JumpRing | None) -> dict[str, Any]:
    """The `bail` block: the loop that a wire's end is bent into, or the jump ring; at its middle or place."""
    if ring is not None:
        place = [_mm(value) for value in ring.point]
        inside, length = ring.inner_diameter_mm, ring.length_mm
        return {"kind": "ring", "at": place, "inner_diameter_mm": inside, "wire_mm": _mm(length)}
    wire, bail = next((wire, wire.bail) for wire in wires if wire.bail is not None)
    return {
        "kind": "loop",
        "wire": wire.name,
        "at": [_mm(value) for value in bail.centre],
        "inner_diameter_mm": bail.inner_diameter_mm,
        "wire_mm": _mm(bail.end_mm - bail.start_mm),
    }


def springback_numbers(bent: Sequence[Overbent]) -> list[dict[str, Any]]:
    """The `springback` block of a jig that makes up for it, by wire."""
    return [
        {
            "name": each.wire.name,
            "overbend_deg": round(math.degrees(each.overbend_rad), 2),
            "moved_mm": _mm(each.moved_mm),
            "residual_mm": _mm(each.residual_mm),
        }
        for each in bent
    ]


def plate_numbers(laser: LaserJig) -> dict[str, Any]:
    """The `plate` block: the laser-cut jig as it is drawn."""
    checks = laser.checks
    return {
        "sheets": len(laser.sheets),
        "parts": len(laser.parts),
        "closed_contours": checks.closed_contours,
        "kerf_mm": laser.kerf_mm,
        "fit_mm": laser.fit_mm,
        "cut_length_mm": _mm(checks.cut_length_mm),
        "engraved_length_mm": _mm(checks.engraved_length_mm),
        "min_cut_distance_mm": _optional_mm(checks.min_cut_distance_mm),
        "min_web_mm": _optional_mm(checks.min_web_mm),
        "wall_height_mm": _mm(laser.wall_height_mm),
    }


def findings_list(findings: Sequence[Finding]) -> list[dict[str, str]]:
    """The `findings` block: each said once, those of a kind together, the worst of them first."""
    kinds: dict[tuple[str, str], list[Finding]] = {}
    for finding in dict.fromkeys(findings):
        kinds.setdefault((finding.code, finding.level), []).append(finding)
    ordered = [f for kind in kinds.values() for f in sorted(kind, key=lambda f: -f.severity)]
    return [
        {"level": f.level, "code": f.code, "where": f.where, "message": f.message, "remedy": f.remedy}
        for f in ordered
    ]


def artifact_list(artifacts: Sequence[Artifact]) -> list[dict[str, Any]]:
    """The `artifacts` block."""
    return [
        {key: value for key, value in dataclasses.asdict(artifact).items() if value is not None}
        for artifact in artifacts
    ]


def to_json(document: dict[str, Any]) -> str:
    """Readable JSON with a line end; refuses NaN, which JSON has no word for."""
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _optional_mm(value: float | None) -> float | None:
    return None if value is None else _mm(value)


def _mm(value: float) -> float:
    return round(float(value), 4)
