"""The laser's files: one drawing for each sheet, since shops want a file for each thickness."""

from __future__ import annotations

from wrapit.jig.contours import FlatDrawing
from wrapit.jig.sheet.model import LaserJig, LaserSheet


def sheet_drawings(laser: LaserJig) -> tuple[FlatDrawing, ...]:
    """One drawing a sheet, named by `sheet_name`."""
    return tuple(
        FlatDrawing(
            sheet_name(sheet),
            f"Laser-cut jig, sheet {sheet.number} of {len(laser.sheets)}: {sheet.thickness_mm:g} mm",
            sheet.contours,
            sheet.width_mm,
            sheet.height_mm,
        )
        for sheet in laser.sheets
    )


def sheet_name(sheet: LaserSheet) -> str:
    """`plate-1-3mm`: sheet 1, of 3 mm."""
    return f"plate-{sheet.number}-{sheet.thickness_mm:g}mm"
