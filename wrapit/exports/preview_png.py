"""A picture of the jig from above with the wires laid in."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from wrapit.errors import ExportError
from wrapit.geometry import FloatArray, Region
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import circle
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

# Look of the picture: nothing hangs on these but how it is seen. 1200 px fill a window; painted three times
# too large and averaged, edges are smooth.
LONGEST_SIDE_PX = 1200
SUPERSAMPLING = 3
PAPER, PLATE, PLATE_EDGE, HOLE = (250, 249, 246), (224, 224, 222), (188, 188, 186), (120, 120, 118)
WALL, WALL_EDGE, SHADOW = (190, 193, 198), (150, 153, 158), (196, 196, 194)
TAUT, TAUT_MM = (40, 44, 52), 0.15
BEAD, BEAD_EDGE = (168, 196, 200), (84, 112, 118)
MARGIN_MM = 3.0
# A wire is painted in pieces this short, which can't cross themselves, each with points every 2 px.
PIECE_MM, PIECE_POINTS = 1.5, 24


def write_preview(
    path: Path,
    wires: Sequence[Wire],
    walls: Sequence[Region] = (),
    plate: Region | None = None,
    taut: Sequence[FloatArray] = (),
) -> None:
    """Write a PNG of plate, walls and wires from above; the same geometry gives the same bytes.

    Later passes of a wire lie over earlier ones; light comes from the upper left. `taut` are courses (m, 2)
    that are drawn as thin lines over them.
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
        _draw_beads(canvas, view, wire)
    for course in taut:
        canvas.line(view.px(course), fill=TAUT, width=round(TAUT_MM * view.px_per_mm), joint="curve")
    small = image.resize(
        (view.size_px[0] // SUPERSAMPLING, view.size_px[1] // SUPERSAMPLING), Image.Resampling.BOX
    )
    try:
        small.save(path, format="PNG")
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
        return [(x, y) for x, y in moved.tolist()]


def _draw_walls(
    image: Image.Image, canvas: ImageDraw.ImageDraw, view: _View, walls: Sequence[Region]
) -> None:
    """Walls with a soft shadow to the lower right; their holes show the plate again."""
    from PIL import Image, ImageDraw

    for offset_mm, fill, edge in ((0.5, SHADOW, SHADOW), (0.0, WALL, WALL_EDGE)):
        shift = np.array([offset_mm, -offset_mm])
        for wall in walls:
            outer, *holes = (view.px(loop.sampled(0.01) + shift) for loop in (wall.outer, *wall.holes))
            mask = Image.new("1", view.size_px, 0)
            inside = ImageDraw.Draw(mask)
            inside.polygon(outer, fill=1)
            for hole in holes:
                inside.polygon(hole, fill=0)
            box = mask.getbbox()
            if box is not None:
                image.paste(fill, box, mask.crop(box))
            for outline in (outer, *holes):
                canvas.line([*outline, outline[0]], fill=edge, width=SUPERSAMPLING)


def _draw_wire(canvas: ImageDraw.ImageDraw, view: _View, wire: Wire) -> None:
    """The whole wire, then once more the spans that lie over others or over the wire itself."""
    lengths = ArcLength(wire.centreline)
    _draw_span(canvas, view, wire, lengths, 0.0, lengths.total_mm)
    for start, end in _raised_spans(wire):
        _draw_span(canvas, view, wire, lengths, start, end)


def _draw_beads(canvas: ImageDraw.ImageDraw, view: _View, wire: Wire) -> None:
    """Each bead as a disc: it hides the wire that runs through it."""
    for bead, place in zip(wire.beads, wire.bead_places, strict=True):
        outline = circle((float(place[0]), float(place[1])), bead.diameter_mm / 2)
        points = view.px(outline.sampled(0.01))
        canvas.polygon(points, fill=BEAD)
        canvas.line([*points, points[0]], fill=BEAD_EDGE, width=SUPERSAMPLING)


def _raised_spans(wire: Wire) -> list[tuple[float, float]]:
    """Where the wire lies clearly above the lowest layer."""
    if not wire.lifts:
        return []
    at_mm, z_mm = np.array(wire.lifts).T
    fine = np.arange(0.0, at_mm[-1], 0.05)
    high = np.interp(fine, at_mm, z_mm) > 0.4 * wire.diameter_mm
    edges = np.flatnonzero(np.diff(np.r_[False, high, False]))
    return [(float(fine[a]), float(fine[b - 1])) for a, b in edges.reshape(-1, 2)]


def _draw_span(
    canvas: ImageDraw.ImageDraw, view: _View, wire: Wire, lengths: ArcLength, start_mm: float, end_mm: float
) -> None:
    """One pass, from its dark rim to a light line; the lighter bands reach farther, so no seam shows."""
    from shapely import buffer, get_parts, linestrings

    base = np.array([int(wire.colour.lstrip("#")[index : index + 2], 16) for index in (0, 2, 4)], dtype=float)
    bands = [
        (1.0, 0.45 * base, 0.0, 0.0),
        (0.84, 0.85 * base, 0.0, 0.4),
        (0.55, base + 0.22 * (255 - base), 0.08, 0.8),
        (0.2, base + 0.6 * (255 - base), 0.15, 1.2),
    ]
    light = np.array([-1.0, 1.0]) / np.sqrt(2) * wire.diameter_mm
    for share, colour, towards_light, reach in bands:
        low = max(0.0, start_mm - reach * wire.diameter_mm)
        high = min(lengths.total_mm, end_mm + reach * wire.diameter_mm)
        fill = tuple(round(float(value)) for value in colour)
        cuts = np.linspace(low, high, max(1, round((high - low) / PIECE_MM)) + 1)
        at_mm = np.linspace(np.maximum(low, cuts[:-1] - 0.05), cuts[1:], PIECE_POINTS, axis=1)
        points = wire.centreline.at(lengths.parameter(at_mm.ravel())) + towards_light * light
        lines = linestrings(points.reshape(-1, PIECE_POINTS, 2))
        for part in get_parts(buffer(lines, share * wire.diameter_mm / 2, quad_segs=16, cap_style="flat")):
            canvas.polygon(view.px(np.array(part.exterior.coords)), fill=fill)
        for end in (0.0, lengths.total_mm):
            if low <= end <= high:
                (x, y), *_ = view.px(
                    wire.centreline.at(lengths.parameter(np.array([end]))) + towards_light * light
                )
                radius = share * wire.diameter_mm * view.px_per_mm / 2
                canvas.ellipse((x - radius, y - radius, x + radius, y + radius), fill=fill)
