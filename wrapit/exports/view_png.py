"""A picture of the jig at an angle, wires laid in, without a 3D library.

Seen from above at an angle, whatever is higher hides what is lower: a jig of flat terraces is painted
slice by slice from the bottom up, each slice moved up the picture by its height.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wrapit.errors import ExportError
from wrapit.geometry import FloatArray, IntArray, Region
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.made import View
from wrapit.wires.model import Wire

# Look of the picture: nothing hangs on these but how it is seen. 12 px/mm shows a wire of 1 mm in a dozen
# pixels; a slice is thinner than a pixel's row at that scale, so that sides have no steps.
PX_PER_MM = 12.0
SUPERSAMPLING = 2
TURN_RAD, TILT_RAD = math.radians(-24), math.radians(48)  # about the vertical; above the horizon
SLICE_MM = 0.1
MARGIN_MM = 4.0
PAPER, PLATE, WALL = np.array([250, 249, 246.0]), np.array([214, 214, 211.0]), np.array([168, 173, 181.0])

Mask = NDArray[np.bool_]


def write_view(path: Path, view: View) -> None:
    """Write a PNG of a jig seen at an angle with its wires; the same geometry gives the same bytes.

    The view has a plate. Raises ExportError when the file can't be written.
    """
    from PIL import Image

    assert view.plate is not None
    height_mm = _height(view)
    picture = _Picture(view.plate, height_mm)
    top = view.plate_mm
    picture.raise_region([view.plate], 0.0, top, PLATE)
    for z_mm in np.arange(top, height_mm + SLICE_MM, SLICE_MM):
        for height in sorted(set(view.heights_mm)):
            walls = [wall for wall, own in zip(view.walls, view.heights_mm, strict=True) if own == height]
            if z_mm <= top + height:
                picture.slice_region(walls, float(z_mm), WALL, top=bool(z_mm + SLICE_MM > top + height))
        for wire in view.wires:
            picture.slice_wire(wire, float(z_mm), top)
    image = Image.fromarray(picture.pixels)
    small = image.resize((image.width // SUPERSAMPLING, image.height // SUPERSAMPLING), Image.Resampling.BOX)
    try:
        small.save(path, format="PNG")
    except OSError as error:
        raise ExportError(
            f"the picture can't be written ({error.strerror})", str(path), "check the disk"
        ) from error


def _height(view: View) -> float:
    laid = max(
        (wire.diameter_mm + max((z for _, z in wire.lifts), default=0.0) for wire in view.wires), default=0.0
    )
    return view.plate_mm + max(*view.heights_mm, 0.0, laid)


class _Picture:
    """Pixels (h, w, 3), painted from the bottom up."""

    def __init__(self, plate: Region, height_mm: float) -> None:
        corners = self._turned(plate.outer.sampled(0.1))
        low, high = corners.min(axis=0) - MARGIN_MM, corners.max(axis=0) + MARGIN_MM
        self._scale = PX_PER_MM * SUPERSAMPLING
        self._origin = np.array([low[0], high[1] + height_mm * math.cos(TILT_RAD)])
        extent = np.array([high[0] - low[0], self._origin[1] - low[1]])
        width, height = (math.ceil(side * PX_PER_MM) * SUPERSAMPLING for side in extent)
        self.pixels = np.tile(PAPER.astype(np.uint8), (height, width, 1))
        self._stencils: dict[int, _Stencil] = {}
        self._courses: dict[str, _Course] = {}

    @staticmethod
    def _turned(points: FloatArray) -> FloatArray:
        c, s = math.cos(TURN_RAD), math.sin(TURN_RAD)
        turned = points @ np.array([[c, s], [-s, c]])
        return turned * np.array([1.0, math.sin(TILT_RAD)])

    def _px(self, points: FloatArray) -> list[tuple[float, float]]:
        moved = (self._turned(points) - self._origin) * np.array([1.0, -1.0]) * self._scale
        return [(x, y) for x, y in moved.tolist()]

    def _stencil(self, regions: Sequence[Region]) -> _Stencil:
        from PIL import Image, ImageDraw

        key = hash(tuple(id(region) for region in regions))
        if key not in self._stencils:
            image = Image.new("1", (self.pixels.shape[1], self.pixels.shape[0]), 0)
            canvas = ImageDraw.Draw(image)
            for region in regions:
                canvas.polygon(self._px(region.outer.sampled(0.01)), fill=1)
                for hole in region.holes:
                    canvas.polygon(self._px(hole.sampled(0.01)), fill=0)
            step = math.ceil(SLICE_MM * math.cos(TILT_RAD) * self._scale)
            self._stencils[key] = _Stencil.of(np.asarray(image), step)
        return self._stencils[key]

    def _course(self, wire: Wire) -> _Course:
        if wire.name not in self._courses:
            lengths = ArcLength(wire.centreline)
            at_mm = lengths.stations(0.1)
            lifts = wire.heights_mm(at_mm)
            points = wire.centreline.at(lengths.parameter(at_mm))
            self._courses[wire.name] = _Course(np.array(self._px(points)), lifts + wire.diameter_mm / 2)
        return self._courses[wire.name]

    def raise_region(
        self, regions: Sequence[Region], low_mm: float, high_mm: float, colour: FloatArray
    ) -> None:
        """Paint an upright prism."""
        for z_mm in np.arange(low_mm, high_mm, SLICE_MM):
            self.slice_region(regions, float(z_mm), colour, top=False)
        self.slice_region(regions, high_mm, colour, top=True)

    def slice_region(self, regions: Sequence[Region], z_mm: float, colour: FloatArray, *, top: bool) -> None:
        """Paint one slice: sides darker than the top, and darkest to the right."""
        stencil = self._stencil(regions)
        row = stencil.row - round(z_mm * math.cos(TILT_RAD) * self._scale)
        height, width = stencil.mask.shape
        under = self.pixels[row : row + height, stencil.column : stencil.column + width]
        if top:
            under[stencil.mask] = colour
        else:
            under[stencil.side] = 0.80 * colour
            under[stencil.right] = 0.66 * colour

    def slice_wire(self, wire: Wire, z_mm: float, plate_mm: float) -> None:
        """Paint the wire's section at a height: narrow and light near its top."""
        from PIL import Image, ImageDraw

        course, radius = self._course(wire), wire.diameter_mm / 2
        above = (z_mm - plate_mm - course.height_mm) / radius
        inside = np.abs(above) < 1
        if not inside.any():
            return
        points = course.points_px[inside] - np.array([0.0, z_mm * math.cos(TILT_RAD) * self._scale])
        reach = 2 + math.ceil(radius * self._scale)
        left, upper = (math.floor(v) - reach for v in points.min(axis=0))
        right, lower = (math.ceil(v) + reach for v in points.max(axis=0))
        image = Image.new("L", (right - left, lower - upper), 0)
        canvas = ImageDraw.Draw(image)
        level, middles = above[inside], points - np.array([left, upper])
        half = radius * np.sqrt(1 - level**2) * self._scale
        reaches = np.column_stack([half, half * math.sin(TILT_RAD)])
        boxes = np.concatenate([middles - reaches, middles + reaches], axis=1)
        fills = np.rint(1 + 127 * (1 + level)).astype(int)
        for box, fill in zip(boxes.tolist(), fills.tolist(), strict=True):
            canvas.ellipse(box, fill=fill)
        mask = np.asarray(image)
        painted = mask > 0
        self.pixels[upper:lower, left:right][painted] = _shades(wire.colour)[mask[painted]]


def _shades(colour: str) -> NDArray[np.uint8]:
    """The wire's colour from dark (1) to its light line (255); 0 is not painted: (256, 3)."""
    base = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], dtype=float)
    level = np.maximum(np.arange(256)[:, None] - 1, 0) / 254
    shade = base * (0.45 + 0.55 * level) + 90 * np.maximum(level - 0.75, 0) * 4
    return np.minimum(shade, 255).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class _Stencil:
    """The pixels of a flat shape, cropped.

    `side` are rows and columns of those that the next slice, which lies higher, leaves to be seen; `right` of
    those among them near the shape's right rim.
    """

    row: int
    column: int
    mask: Mask
    side: tuple[IntArray, ...]
    right: tuple[IntArray, ...]

    @classmethod
    def of(cls, whole: Mask, step: int) -> _Stencil:
        """`step` is how many rows the next slice lies higher at most."""
        rows, columns = np.flatnonzero(whole.any(axis=1)), np.flatnonzero(whole.any(axis=0))
        mask = whole[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        side = mask.copy()
        side[:-step] &= ~mask[step:]
        right = side.copy()
        right[:, :-3] &= ~mask[:, 3:]
        return cls(int(rows[0]), int(columns[0]), mask, np.nonzero(side), np.nonzero(right))


@dataclass(frozen=True, eq=False)
class _Course:
    """Stations along a wire: pixels of the plane, and the height of its middle above the plate."""

    points_px: FloatArray
    height_mm: FloatArray
