"""The laser-cut jig's part of the report."""

from __future__ import annotations

from typing import Any

from wrapit.jig.made import reported
from wrapit.jig.sheet.model import LaserJig


def plate_numbers(laser: LaserJig) -> dict[str, Any]:
    """The `plate` block: the laser-cut jig as it is drawn."""
    checks = laser.checks
    return {
        "sheets": len(laser.sheets),
        "parts": len(laser.parts),
        "closed_contours": checks.closed_contours,
        "kerf_mm": laser.kerf_mm,
        "fit_mm": laser.fit_mm,
        "cut_length_mm": reported(checks.cut_length_mm),
        "engraved_length_mm": reported(checks.engraved_length_mm),
        "min_cut_distance_mm": _optional(checks.min_cut_distance_mm),
        "min_web_mm": _optional(checks.min_web_mm),
        "wall_height_mm": reported(laser.wall_height_mm),
    }


def _optional(value: float | None) -> float | None:
    return None if value is None else reported(value)
