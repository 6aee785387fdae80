"""Pictures as inline SVG, in one frame for the whole page: shared shapes are drawn once and used often."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from markupsafe import Markup

from wrapit.geometry import BezierChain, Region
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.bench.from_above import disc_mm
from wrapit.pages.model import Mark, Picture, Shape, Shared

# The page's frame has the piece's origin at its own, y down; each picture's viewBox cuts out its part.
FRAME: Final = SvgFrame(0.0, 0.0, 0.0, 0.0)
# Radius of a dot in shares of the text's height.
DOT: Final = 0.4
# How far text hangs below its middle, in its own height: for letters without descenders.
DROP: Final = 0.36


def definitions(shared: Mapping[str, tuple[Shape, ...]]) -> Markup:
    """The shared shapes of a page, which `picture` refers to."""
    groups = (
        Markup('<g id="{}">{}</g>').format(key, Markup("").join(_defined(shape) for shape in shapes))
        for key, shapes in shared.items()
    )
    return Markup('<svg class="shared" aria-hidden="true" focusable="false"><defs>{}</defs></svg>').format(
        Markup("\n").join(groups)
    )


def picture_svg(picture: Picture, label: str) -> Markup:
    """The picture, with its words for who can't see it."""
    (left, bottom), (right, top) = picture.low, picture.high
    box = " ".join(map(number, (left, -top, right - left, top - bottom)))
    parts = [*map(_shown, picture.shapes), *(part for mark in picture.marks for part in _mark(mark, picture))]
    return Markup('<svg class="picture" viewBox="{}" role="img" aria-label="{}">\n{}\n</svg>').format(
        box, label, Markup("\n").join(parts)
    )


def _defined(shape: Shape) -> Markup:
    """Lines get their look where they are used, flat pieces have their own."""
    if isinstance(shape.geometry, Region):
        return Markup('<path class="{}" d="{}"/>').format(shape.style, _path(shape))
    return Markup('<path d="{}"/>').format(_path(shape))


def _shown(shape: Shape | Shared) -> Markup:
    look = Markup("")
    if shape.colour:
        look += Markup(' stroke="{}"').format(shape.colour)
    if shape.width_mm:
        look += Markup(' stroke-width="{}"').format(number(shape.width_mm))
    if isinstance(shape, Shared):
        style = Markup(' class="{}"').format(shape.style) if shape.style is not None else Markup("")
        return Markup('<use href="#{}"{}{}/>').format(shape.key, style, look)
    return Markup('<path class="{}" d="{}"{}/>').format(shape.style, _path(shape), look)


def _path(shape: Shape) -> str:
    geometry = shape.geometry
    if isinstance(geometry, Region):
        return FRAME.region(geometry)
    return FRAME.path(geometry) if isinstance(geometry, BezierChain) else FRAME.polyline(geometry)


def _mark(mark: Mark, picture: Picture) -> Iterator[Markup]:
    x, y = map(number, FRAME.at(mark.at))
    size = picture.text_mm
    if mark.kind == "dot":
        yield Markup('<circle class="dot" cx="{}" cy="{}" r="{}"/>').format(x, y, number(DOT * size))
        return
    if mark.anchor is not None:
        anchor_x, anchor_y = map(number, FRAME.at(mark.anchor))
        line = Markup('<line class="leader" x1="{}" y1="{}" x2="{}" y2="{}" stroke-width="{}"/>')
        yield line.format(x, y, anchor_x, anchor_y, number(0.08 * size))
    if mark.kind != "bare":
        radius = disc_mm(mark.text, size)
        disc = Markup('<circle class="{}" cx="{}" cy="{}" r="{}" stroke-width="{}"/>')
        yield disc.format(mark.kind, x, y, number(radius), number(0.06 * size))
    yield Markup('<text x="{}" y="{}" dy="{}em" font-size="{}">{}</text>').format(
        x, y, DROP, number(size), mark.text
    )
