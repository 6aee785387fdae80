"""The files of a flat drawing: DXF for the machine, SVG to look at, print or cut by."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from wrapit.config import PlateConfig
from wrapit.exports.plate_dxf import write_dxf
from wrapit.exports.plate_svg import plate_svg
from wrapit.jig.contours import FlatDrawing


def write_flat_files(
    folder: Path, drawing: FlatDrawing, config: PlateConfig, formats: Collection[str]
) -> tuple[Path, ...]:
    """The drawing's files in those of its formats (dxf, svg) that are asked for; returns their paths.

    Raises ExportError when the DXF has faults, OSError when a file can't be written.
    """
    paths = []
    if "dxf" in formats:
        paths.append(folder / f"{drawing.stem}.dxf")
        write_dxf(paths[-1], list(drawing.contours), config.profile, config.curves, config.tolerance)
    if "svg" in formats:
        paths.append(folder / f"{drawing.stem}.svg")
        text = plate_svg(drawing, config.profile)
        paths[-1].write_text(text, encoding="utf-8", newline="\n")
    return tuple(paths)
