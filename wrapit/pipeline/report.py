"""`report.json`: every number, finding and artifact of a build; no timings, so that it stays the same."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from wrapit import __version__
from wrapit.config import Config, lock_text
from wrapit.errors import Finding
from wrapit.pipeline.output.ownership import FORMAT, Artifact

if TYPE_CHECKING:
    from wrapit.decomposition.model import Solution
    from wrapit.drawing.model import Drawing
    from wrapit.fit.model import Fitted, Measures
    from wrapit.wires.model import JumpRing, Wire
    from wrapit.wires.springback import Overbent

if TYPE_CHECKING:
    from wrapit.instructions.model import Guide

# What identifies a build: with these the same, all its files are.
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


def fit_numbers(fitted: Fitted, level: str) -> dict[str, Any]:
    """The `fit` block: what was changed, and what that cost; shares of the length, places in mm."""
    changes = fitted.drawing.removed[len(fitted.original.removed) :]
    return {
        "level": level,
        "before": _measures(fitted.before),
        "after": _measures(fitted.after),
        "outline_kept": round(fitted.costs.outline_kept, 4),
        "left_out_share": round(fitted.costs.left_out, 4),
        "deviation_mm": _mm(fitted.costs.deviation_mm),
        "changes": dict(sorted(Counter(change.what for change in changes).items())),
        "beads": [
            {
                "at": [_mm(value) for value in bead.at],
                "diameter_mm": _mm(bead.diameter_mm),
                "segment": bead.segment,
            }
            for bead in fitted.beads
        ],
    }


def _measures(measures: Measures) -> dict[str, Any]:
    return {
        "segments": measures.segments,
        "wires": measures.wires,
        "tight_bends": measures.tight_bends,
        "smallest_face_mm": None if measures.smallest_face_mm is None else _mm(measures.smallest_face_mm),
        "length_mm": _mm(measures.length_mm),
    }


def decomposition_numbers(solution: Solution, fewest_possible_wires: int) -> dict[str, Any]:
    """The `decomposition` block."""
    from wrapit.decomposition.json_file import decomposition_summary

    return {**decomposition_summary(solution), "fewest_possible_wires": fewest_possible_wires}


def fewer_wires_numbers(front: Sequence[Solution]) -> list[dict[str, Any]]:
    """The `fewer_wires` block, the most wires first: what fewer of them cost, and the `max_wires` that asks
    for them; of the first, which needs none, it is null."""
    from wrapit.decomposition.graph import most_of_a_piece

    return [
        {
            "max_wires": most_of_a_piece(member) if number else None,
            "wires": member.energy.complexity,
            "doubled_mm": _mm(member.doubled_mm),
            "bends_deg": round(math.degrees(member.energy.smoothness_rad), 2),
            "optimal": member.optimal,
        }
        for number, member in enumerate(front)
    ]


def lengths_mm(wires: Sequence[Wire]) -> list[float]:
    """Of each wire as it is drawn, without tails."""
    return [_mm(wire.length_mm) for wire in wires]


def wire_numbers(wires: Sequence[Wire]) -> list[dict[str, Any]]:
    """The `wires` block."""
    return [
        {
            "name": wire.name,
            "length_mm": _mm(wire.length_mm),
            "cut_length_mm": _mm(wire.cut_length_mm),
            "turns": sum(not turn.stretch for turn in wire.turns),
            "connections": len(wire.bindings),
            "min_bend_radius_mm": _mm(wire.min_bend_radius_mm),
            "max_deviation_from_drawing_mm": _mm(wire.max_deviation_from_drawing_mm),
            "layers": wire.layers,
            "mass_g": round(wire.mass_g, 4),
            **({"beads": _bead_numbers(wire)} if wire.beads else {}),
        }
        for wire in wires
    ]


def _bead_numbers(wire: Wire) -> list[dict[str, Any]]:
    """Where along a wire its beads are, threaded or beside it."""
    return [
        {
            "at_mm": _mm(bead.at_mm),
            "diameter_mm": bead.diameter_mm,
            "held": "threaded" if bead.threaded else "sewn",
        }
        for bead in wire.beads
    ]


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


def guide_numbers(guide: Guide) -> dict[str, Any]:
    """The `guide` block: how hard and how long the work is, and the metal for it (for both of a pair)."""
    return {
        "difficulty": guide.difficulty,
        "minutes": round(guide.minutes, 1),
        "materials": [
            {
                "use": each.use,
                "diameter_mm": _mm(each.diameter_mm),
                "length_mm": _mm(each.length_mm),
                "mass_g": round(each.mass_g, 4),
            }
            for each in guide.materials
        ],
    }


def findings_list(findings: Sequence[Finding]) -> list[dict[str, str]]:
    """The `findings` block: each said once, those of a kind together, the worst of them first."""
    severity: dict[Finding, float] = {}
    for finding in findings:
        severity[finding] = max(finding.severity, severity.get(finding, 0.0))
    kinds: dict[tuple[str, str], list[Finding]] = {}
    for finding in severity:
        kinds.setdefault((finding.code, finding.level), []).append(finding)
    ordered = [f for kind in kinds.values() for f in sorted(kind, key=lambda f: -severity[f])]
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


def _mm(value: float) -> float:
    return round(float(value), 4)
