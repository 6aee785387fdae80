"""A picture of the jig from above with the wires laid in."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from wrapit.errors import ExportError
from wrapit.geometry import FloatArray, Region
from wrapit.geometry.pieces import chain_of, piece
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

LONGEST_SIDE_PX = 1200
SUPERSAMPLING = 3
PAPER, PLATE, PLATE_EDGE, HOLE = (250, 249, 246), (224, 224, 222), (188, 188, 186), (120, 120, 118)
WALL, WALL_EDGE, SHADOW = (190, 193, 198), (150, 153, 158), (196, 196, 194)
MARGIN_MM = 3.0


def write_preview(
    path: Path, wires: Sequence[Wire], walls: Sequence[Region] = (), plate: Region | None = None
) -> None:
    """Write a PNG of plate, walls and wires from above; the same geometry gives the same bytes.

    Later passes of a wire lie over earlier ones; light comes from the upper left.
    Raises ExportError when the file can't be written.
    """
    from PIL import Image, ImageDraw

    view = _View.of(wires, plate)
    image = Image.new("RGB", view.size_px, PAPER)
    canvas = ImageDraw.Draw(image)
    if plate is not None:
        canvas.polygon(view.px(plate.outer.sampled(0.01)), fill=PLATE, outline=PLATE_EDGE)
        for hole in plate.holes:
            canvas.polygon(view.px(hole.sampled(0.01)), fill=HOLE)
    _draw_walls(image, canvas, view, walls)
    for wire in wires:
        _draw_wire(canvas, view, wire)
    small = image.resize(
        (view.size_px[0] // SUPERSAMPLING, view.size_px[1] // SUPERSAMPLING), Image.Resampling.BOX
    )
    try:
        small.save(path, format="PNG", compress_level=9)
    except OSError as error:
        raise ExportError(
            f"the picture can't be written ({error.strerror})", str(path), "check folder and disk"
        ) from error


class _View:
    """Millimetres to supersampled pixels."""

    def __init__(self, low: FloatArray, high: FloatArray) -> None:
        size = high - low + 2 * MARGIN_MM
        self.px_per_mm = LONGEST_SIDE_PX * SUPERSAMPLING / float(size.max())
        self._origin = np.array([low[0] - MARGIN_MM, high[1] + MARGIN_MM])
        pixels = [max(1, round(side * self.px_per_mm / SUPERSAMPLING)) * SUPERSAMPLING for side in size]
        self.size_px = (pixels[0], pixels[1])

    @classmethod
    def of(cls, wires: Sequence[Wire], plate: Region | None) -> _View:
        clouds = [chain_of(wire.centreline).sampled(0.2) for wire in wires]
        if plate is not None:
            clouds.append(plate.outer.sampled(0.05))
        if not clouds:
            raise ValueError("a picture needs a wire or a plate")
        points = np.vstack(clouds)
        return cls(points.min(axis=0), points.max(axis=0))

    def px(self, points: FloatArray) -> list[tuple[float, float]]:
        moved = (points - self._origin) * np.array([1.0, -1.0]) * self.px_per_mm
        return [(float(x), float(y)) for x, y in moved]


def _draw_walls(
    image: Image.Image, canvas: ImageDraw.ImageDraw, view: _View, walls: Sequence[Region]
) -> None:
    """Walls with a soft shadow to the lower right; their holes show the plate again."""
    from PIL import Image, ImageDraw

    for offset_mm, fill, edge in ((0.5, SHADOW, SHADOW), (0.0, WALL, WALL_EDGE)):
        shift = np.array([offset_mm, -offset_mm])
        for wall in walls:
            mask = Image.new("1", view.size_px, 0)
            inside = ImageDraw.Draw(mask)
            inside.polygon(view.px(wall.outer.sampled(0.01) + shift), fill=1)
            for hole in wall.holes:
                inside.polygon(view.px(hole.sampled(0.01) + shift), fill=0)
            image.paste(fill, (0, 0), mask)
            for loop in (wall.outer, *wall.holes):
                outline = view.px(loop.sampled(0.01) + shift)
                canvas.line([*outline, outline[0]], fill=edge, width=SUPERSAMPLING)


def _draw_wire(canvas: ImageDraw.ImageDraw, view: _View, wire: Wire) -> None:
    """The wire in pieces, each shaded from its dark rim to a light line, so that passes cover each other."""
    chain = chain_of(wire.centreline)
    base = np.array([int(wire.colour.lstrip("#")[index : index + 2], 16) for index in (0, 2, 4)], dtype=float)
    shades = [
        (1.0, 0.45 * base, 0.0),
        (0.84, 0.85 * base, 0.0),
        (0.55, base + 0.22 * (255 - base), 0.08),
        (0.2, base + 0.6 * (255 - base), 0.15),
    ]
    cuts = np.linspace(0, chain.length, max(1, round(chain.length / max(4.0 * wire.diameter_mm, 2.0))) + 1)
    light = np.array([-1.0, 1.0]) / np.sqrt(2) * wire.diameter_mm
    for index, (start, end) in enumerate(itertools.pairwise(cuts)):
        for layer, (share, colour, towards_light) in enumerate(shades):
            # The dark rim of a piece would end across the piece before: all lighter layers begin there again.
            begin = start if layer == 0 else cuts[max(0, index - 1)]
            points = piece(chain, float(begin), float(end)).sampled(0.05) + towards_light * light
            width_px = share * wire.diameter_mm * view.px_per_mm
            _stroke(canvas, view.px(points), width_px, tuple(round(float(value)) for value in colour))


def _stroke(
    canvas: ImageDraw.ImageDraw, points: list[tuple[float, float]], width_px: float, colour: tuple[int, ...]
) -> None:
    canvas.line(points, fill=colour, width=max(1, round(width_px)), joint="curve")
    radius = width_px / 2
    for x, y in (points[0], points[-1]):
        canvas.ellipse((x - radius, y - radius, x + radius, y + radius), fill=colour)
