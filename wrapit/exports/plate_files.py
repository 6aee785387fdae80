"""All files of a laser-cut jig: one drawing with every sheet, and one for each sheet if there are several."""

from __future__ import annotations

from pathlib import Path

from wrapit.config import PlateConfig
from wrapit.errors import ExportError
from wrapit.exports.plate_dxf import write_dxf
from wrapit.exports.plate_svg import plate_svg
from wrapit.jig.sheet.model import Contour, LaserJig, LaserSheet

# Between sheets that are drawn side by side.
GAP_MM = 20.0


def write_plate_files(folder: Path, laser: LaserJig, config: PlateConfig) -> tuple[Path, ...]:
    """`plate.dxf` and `plate.svg` with all sheets side by side; for several sheets also one pair for each.

    Shops want a file for each thickness: `plate-1-3mm.dxf` is sheet 1, of 3 mm. Returns the paths.
    Raises ExportError when a file can't be written.
    """
    paths = list(_write(folder, "plate", _side_by_side(laser), *_extent(laser), config))
    if len(laser.sheets) > 1:
        for sheet in laser.sheets:
            size = sheet.width_mm, sheet.height_mm
            paths += _write(folder, sheet_name(sheet), list(sheet.contours), *size, config)
    return tuple(paths)


def sheet_name(sheet: LaserSheet) -> str:
    """`plate-1-3mm`."""
    return f"plate-{sheet.number}-{sheet.thickness_mm:g}mm"


def _write(
    folder: Path, stem: str, contours: list[Contour], width_mm: float, height_mm: float, config: PlateConfig
) -> tuple[Path, Path]:
    dxf, svg = folder / f"{stem}.dxf", folder / f"{stem}.svg"
    write_dxf(dxf, contours, config.profile, config.curves, config.tolerance)
    try:
        svg.write_text(
            plate_svg(contours, width_mm, height_mm, config.profile), encoding="utf-8", newline="\n"
        )
    except OSError as error:
        raise ExportError(
            f"the SVG can't be written ({error.strerror})", str(svg), "check folder and disk"
        ) from error
    return dxf, svg


def _side_by_side(laser: LaserJig) -> list[Contour]:
    contours, left = [], 0.0
    for sheet in laser.sheets:
        contours += [contour.moved(0, (left, 0.0)) for contour in sheet.contours]
        left += sheet.width_mm + GAP_MM
    return contours


def _extent(laser: LaserJig) -> tuple[float, float]:
    width_mm = sum(sheet.width_mm for sheet in laser.sheets) + GAP_MM * (len(laser.sheets) - 1)
    return width_mm, max((sheet.height_mm for sheet in laser.sheets), default=0.0)
