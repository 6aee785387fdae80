"""Chooses the lines among what an SVG file paints: stroked curves, and filled outlines on request."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Page, Shape
from wrapit.drawing.svg.reading.scene import read_page
from wrapit.drawing.svg.remarks import refusal, remarks
from wrapit.drawing.svg.seen.losses import Loss
from wrapit.drawing.svg.seen.paper import alike, is_white, opaque
from wrapit.drawing.svg.seen.visible import Visible
from wrapit.errors import Finding
from wrapit.geometry import FloatArray

# CSS and SVG 2: a pixel is a 96th of an inch.
_MM_PER_PX = 25.4 / 96
# In widths: fills that are larger than a square of these sides show within the stroke around them.
_SOLID = 2.0
# Paper is nearly white, or is what lies first and fills nine tenths of the page; outlines of a drawing,
# however large, fill a fraction of their box.
_PAGE_SHARE = 0.9


@dataclass(frozen=True, eq=False)
class Strokes:
    """The curves of an SVG file in its own pixels (96 per inch, y down), and their usual width.

    `owners` are the numbers of the shapes that the curves belong to. `filled` shapes have no stroke, `solid`
    ones are filled in the colour of theirs.
    `losses` are the stretches of lines that are not read, or not as drawn; `page` is all that is painted.
    """

    curves: list[Curve]
    owners: list[int]
    width_px: float | None
    filled: list[Shape]
    solid: list[Shape]
    mm_per_px: float
    losses: list[Loss]
    page: Page
    findings: tuple[Finding, ...]


def read_strokes(path: Path, tracing: TracingConfig) -> Strokes:
    """The stroked curves of an SVG file.

    Raises DrawingError where it can't be read, isn't safe, or has none.
    """
    page = read_page(path)
    curves: list[Curve] = []
    owners: list[int] = []
    widths: list[float] = []
    filled: list[Shape] = []
    solid: list[Shape] = []
    visible = Visible(page)
    for index, shape in enumerate(page.shapes):
        if visible.is_line(index):
            lines = visible.lines(index)
            solid += [shape] if lines and _is_solid(shape) else []
            curves += lines
            widths += [shape.stroke_width] * len(lines)
        elif shape.fill and shape.curves and not _is_ground(shape, first=index == 0, size=page.size):
            filled.append(shape)
            if tracing.filled == "outline":
                curves += [_closed(curve) for curve in shape.curves]
        owners += [index] * (len(curves) - len(owners))
    if not curves:
        raise refusal(page, filled, visible.losses, path)
    usual = float(np.median(widths)) if widths else None
    width = usual if usual and math.isfinite(usual) and usual > 0 else None
    return Strokes(curves, owners, width, filled, solid, _MM_PER_PX, visible.losses, page, remarks(page))


def _is_solid(shape: Shape) -> bool:
    """Whether a shape is filled in the colour of its stroke, so that its outline is no line to the eye."""
    fill, stroke = shape.fill, shape.stroke
    return opaque(fill) and bool(fill and stroke and alike(fill.colour, stroke.colour)) and _fills(shape)


def _fills(shape: Shape) -> bool:
    """Whether the fill shows within the stroke: open lines and thin shapes have none to speak of."""
    return _area(tuple(map(_closed, shape.curves))) > (_SOLID * shape.stroke_width) ** 2


def _is_ground(shape: Shape, first: bool, size: tuple[float, float]) -> bool:
    """Whether a filled shape is the paper."""
    if shape.fill and is_white(shape.fill.colour):
        return True
    return first and _area(shape.curves) > _PAGE_SHARE * size[0] * size[1]


def _area(curves: tuple[Curve, ...]) -> float:
    """Area of the largest outline less that of the others, which may be holes in it."""
    areas = [abs(_signed_area(_closed(curve).cubics)) for curve in curves]
    return 2 * max(areas, default=0.0) - sum(areas)


def _signed_area(cubics: FloatArray) -> float:
    """Area within a closed chain of cubics (n, 4, 2), by Green's theorem: exact."""
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = (cubics - cubics[0, 0]).transpose(1, 2, 0)
    parts = (
        (y3 - y0) * (x1 + x2) - (x3 - x0) * (y1 + y2) + y1 * (x0 - x2) - x1 * (y0 - y2)
        + y3 * (x2 + x0 / 3) - x3 * (y2 + y0 / 3)
    )  # fmt: skip
    return float(3 * parts.sum() / 20)


def _closed(curve: Curve) -> Curve:
    """The outline of what is filled, whose end is its start."""
    start, end = curve.cubics[0, 0], curve.cubics[-1, 3]
    if curve.closed or not np.abs(end - start).max() > 0:
        return curve
    straight = np.stack([end, end + (start - end) / 3, start - (start - end) / 3, start])
    return Curve(np.concatenate([curve.cubics, straight[None]]), closed=True)
