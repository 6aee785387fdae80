"""Lays parts out on sheets of the configured size, as few sheets as the packing finds."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.config import PlateConfig
from wrapit.errors import Finding
from wrapit.geometry import FloatArray, Line, Loop
from wrapit.jig.contours import Contour, Layer
from wrapit.jig.lettering import engraved_text, text_size_mm
from wrapit.jig.sheet.model import LaserPart, LaserSheet, Placed

# Packing counts in whole hundredths of a millimetre.
_UNITS_PER_MM = 100
# Legible where it is engraved: no wire number is smaller than three quarters of it.
TEXT_MM = 2.0
# Along the lower edge of a sheet: lettering over the bar's ticks, and free sheet above.
STRIP_MM = 6.0
# Long enough that 0.1 % is seen with a caliper.
BAR_MM = 100.0


def nest(
    parts: Sequence[LaserPart], config: PlateConfig
) -> tuple[tuple[LaserSheet, ...], tuple[Finding, ...]]:
    """Sheets of one thickness each, thin ones first; every part once for each of its copies.

    A part larger than the sheet gets a sheet of its own size, and an error that says so.
    """
    sheets: list[LaserSheet] = []
    findings: list[Finding] = []
    thicknesses = sorted({part.thickness_mm for part in parts})
    # Sheets of different thickness say which they are, so that none is cut from the wrong one.
    strip_mm = STRIP_MM if config.reference_bar or len(thicknesses) > 1 else 0.0
    for thickness_mm in thicknesses:
        pieces = [part for part in parts if part.thickness_mm == thickness_mm for _ in range(part.copies)]
        for group, width_mm, height_mm in _groups(pieces, config, strip_mm, findings):
            marks = _marks(thickness_mm, width_mm, config) if strip_mm else ()
            sheets.append(LaserSheet(len(sheets) + 1, thickness_mm, width_mm, height_mm, tuple(group), marks))
    return tuple(sheets), tuple(findings)


def _groups(
    pieces: Sequence[LaserPart], config: PlateConfig, strip_mm: float, findings: list[Finding]
) -> list[tuple[list[Placed], float, float]]:
    """For each sheet its placed parts, and its size."""
    boxes = [_box(part) for part in pieces]
    sizes = [high - low for low, high in boxes]
    room = np.array([config.sheet_width, config.sheet_height]) - 2 * config.spacing
    room[1] -= strip_mm
    groups = []
    small = []
    for index, size in enumerate(sizes):
        if max(size) <= max(room) and min(size) <= min(room):
            small.append(index)
            continue
        need = size + 2 * config.spacing + [0.0, strip_mm]
        findings.append(_too_large(pieces[index], need, config))
        shift = np.array([config.spacing, config.spacing + strip_mm]) - boxes[index][0]
        groups.append(([_placed(pieces[index], 0, shift)], float(need[0]), float(need[1])))
    packed = _packed([sizes[index] for index in small], room, config.spacing)
    for sheet in packed:
        placed = []
        for which, x_mm, y_mm, turned in sheet:
            part, (low, high) = pieces[small[which]], boxes[small[which]]
            corner = np.array([x_mm, y_mm]) + config.spacing + [0.0, strip_mm]
            # A quarter turn to the left brings the box's upper left corner to the lower left.
            origin = np.array([-high[1], low[0]]) if turned else low
            placed.append(_placed(part, int(turned), corner - origin))
        groups.append((placed, config.sheet_width, config.sheet_height))
    return groups


def _packed(
    sizes: Sequence[FloatArray], room: FloatArray, spacing_mm: float
) -> list[list[tuple[int, float, float, bool]]]:
    """For each sheet (part, x, y, turned); every part is taken with the spacing to its right and above."""
    from rectpack import newPacker

    packer = newPacker(rotation=True)
    whole = [[math.ceil((side + spacing_mm) * _UNITS_PER_MM) for side in size] for size in sizes]
    for index, (width, height) in enumerate(whole):
        packer.add_rect(width, height, index)
    bins = [math.floor((side + spacing_mm) * _UNITS_PER_MM) for side in room]
    packer.add_bin(*bins, count=max(1, len(sizes)))
    packer.pack()
    sheets = []
    for sheet in packer:
        rects = sorted((rect.rid, rect.x, rect.y, rect.width) for rect in sheet)
        sheets.append(
            [
                (rid, x / _UNITS_PER_MM, y / _UNITS_PER_MM, width != whole[rid][0])
                for rid, x, y, width in rects
            ]
        )
    if sum(map(len, sheets)) != len(sizes):
        raise ValueError("the packing lost a part")
    return sheets


def _placed(part: LaserPart, quarters: int, shift: FloatArray) -> Placed:
    return Placed(part, quarters, (float(shift[0]), float(shift[1])))


def _box(part: LaserPart) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner of all that the laser draws for a part."""
    points = np.vstack([Loop(contour.edges).sampled(2e-4) for contour in part.contours])
    ends = np.array([contour.edges[-1].end for contour in part.contours])
    points = np.vstack([points, ends])
    return points.min(axis=0), points.max(axis=0)


def _too_large(part: LaserPart, need: FloatArray, config: PlateConfig) -> Finding:
    return Finding(
        "error",
        "larger-than-sheet",
        f"{part.jig}, part {part.label}",
        f"the part needs a sheet of {need[0]:.0f} × {need[1]:.0f} mm; "
        f"the sheet has {config.sheet_width:.0f} × {config.sheet_height:.0f} mm",
        "set plate.sheet_width and plate.sheet_height to a larger sheet, or split the jig per wire",
    )


def _marks(thickness_mm: float, width_mm: float, config: PlateConfig) -> tuple[Contour, ...]:
    """The thickness of the sheet, to be read only; and if it is wanted the bar with its ticks, engraved."""
    x, y = config.spacing, config.spacing + 1.0
    note = f"sheet of {thickness_mm:g} mm"
    if not config.reference_bar:
        return _lettered(note, x + 1.0, y + 2.6, "NOTE")
    ends = [(x + offset, y) for offset in (0.0, min(BAR_MM, width_mm - 2 * x))]
    lines = [Line(*ends), *(Line((end[0], end[1] - 1), (end[0], end[1] + 1)) for end in ends)]
    length = f"{ends[1][0] - x:.0f} mm"
    return (
        *(Contour("ENGRAVE", (line,)) for line in lines),
        *_lettered(length, x + 1.0, y + 2.6, "ENGRAVE"),
        *_lettered(note, x + 4.0 + text_size_mm(length, TEXT_MM)[0], y + 2.6, "NOTE"),
    )


def _lettered(text: str, left_mm: float, middle_mm: float, layer: Layer) -> tuple[Contour, ...]:
    centre = (left_mm + text_size_mm(text, TEXT_MM)[0] / 2, middle_mm)
    return engraved_text(text, centre, TEXT_MM, layer)
