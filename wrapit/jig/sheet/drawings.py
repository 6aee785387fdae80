"""The laser's files: one drawing with all sheets side by side, and one for each where there are several."""

from __future__ import annotations

from wrapit.jig.contours import Contour, FlatDrawing
from wrapit.jig.sheet.model import LaserJig, LaserSheet

# Between sheets that are drawn side by side, so that one is seen to end.
GAP_MM = 20.0
TITLE = "Laser-cut plate jig"


def sheet_drawings(laser: LaserJig) -> tuple[FlatDrawing, ...]:
    """`plate` with all sheets side by side; for several sheets also each by itself.

    Shops want a file for each thickness: `plate-1-3mm` is sheet 1, of 3 mm.
    """
    whole = FlatDrawing("plate", TITLE, tuple(_side_by_side(laser)), *_extent(laser))
    if len(laser.sheets) < 2:
        return (whole,)
    each = (
        FlatDrawing(sheet_name(sheet), TITLE, sheet.contours, sheet.width_mm, sheet.height_mm)
        for sheet in laser.sheets
    )
    return (whole, *each)


def sheet_name(sheet: LaserSheet) -> str:
    """`plate-1-3mm`."""
    return f"plate-{sheet.number}-{sheet.thickness_mm:g}mm"


def _side_by_side(laser: LaserJig) -> list[Contour]:
    contours, left = [], 0.0
    for sheet in laser.sheets:
        contours += [contour.moved(0, (left, 0.0)) for contour in sheet.contours]
        left += sheet.width_mm + GAP_MM
    return contours


def _extent(laser: LaserJig) -> tuple[float, float]:
    width_mm = sum(sheet.width_mm for sheet in laser.sheets) + GAP_MM * (len(laser.sheets) - 1)
    return width_mm, max((sheet.height_mm for sheet in laser.sheets), default=0.0)
