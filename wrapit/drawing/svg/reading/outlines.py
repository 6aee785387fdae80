"""Shapes with their paint: what an element's outline is, in px, and whether it is filled and stroked."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading import basic_shapes
from wrapit.drawing.svg.reading.element import Element
from wrapit.drawing.svg.reading.lengths import Measure, lengths_of, number
from wrapit.drawing.svg.reading.links import Links
from wrapit.drawing.svg.reading.matrices import Matrix, applied, determinant
from wrapit.drawing.svg.reading.model import Omission, Paint, Shape
from wrapit.drawing.svg.reading.paints import NOTHING, PaintValue
from wrapit.drawing.svg.reading.path_data import path_subpaths, polygon_subpaths
from wrapit.drawing.svg.reading.pen import Subpath
from wrapit.drawing.svg.reading.styles import Style
from wrapit.errors import DrawingError
from wrapit.geometry import FloatArray
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.polyline import total_length

# Parts of all lines together. Finding where as many cross takes a few seconds.
MOST_PARTS = 20_000
# Larger coordinates are slips of a unit or an exponent; products of these are still far from overflow.
_LARGEST_PX = 1e12
# Parts that are shorter (in px) are dots, or rounding.
_SHORTEST_PX = 1e-9

# Steps of a cubic whose length is measured: 1e-4 of a quarter circle too short.
_LENGTH_SAMPLES = 32

# How the outline of each basic shape is drawn; a path and lists of points have data instead.
_BASIC: dict[str, Callable[[basic_shapes.Lengths], list[Subpath]]] = {
    "rect": basic_shapes.rectangle,
    "circle": basic_shapes.circle,
    "ellipse": basic_shapes.ellipse,
    "line": basic_shapes.line,
}
# All elements that have an outline (SVG 2, chapters 9 and 10).
OUTLINED = (*_BASIC, "path", "polyline", "polygon")


class Outliner:
    """Makes shapes; counts their parts, and remembers what of their data was not in order."""

    def __init__(self, links: Links, path: Path) -> None:
        self.omissions: list[Omission] = []
        self._links, self._path = links, path
        self._parts = 0

    def shape(
        self,
        element: Element,
        declared: dict[str, str],
        style: Style,
        matrix: Matrix,
        measure: Measure,
        opacity: float,
        mask: str,
    ) -> Shape:
        """The shape of an element; neither filled nor stroked where it is not visible."""
        subpaths = self._subpaths(element, declared, measure)
        flat = _is_flat(subpaths)
        fill = self._paint(style.fill, style, opacity * style.fill_opacity, flat)
        stroke = self._paint(style.stroke, style, opacity * style.stroke_opacity, flat)
        scaled = declared.get("vector-effect", "").strip().lower() != "non-scaling-stroke"
        factor = abs(determinant(matrix)) ** 0.5 if scaled else 1.0
        width = style.stroke_width * factor
        if not style.visible or element.name == "line":
            fill = None
        if not style.visible or not width > 0:
            stroke = None
        if stroke and style.dashes:
            factor *= _stretched(element, subpaths)
        curves, dots = self._placed(subpaths, matrix, element, fill is not None or stroke is not None)
        if stroke and style.markers and element.name in ("path", "line", "polyline", "polygon"):
            self.omissions.append(Omission("markers", element.line))
        return Shape(
            tag=element.name,
            name=element.get("id", ""),
            line=element.line,
            curves=curves,
            dots=dots,
            fill=fill,
            stroke=stroke,
            stroke_width=width,
            fill_rule=style.fill_rule,
            clip_rule=style.clip_rule,
            cap=style.cap,
            join=style.join,
            dashes=tuple(factor * length for length in style.dashes),
            dash_offset=factor * style.dash_offset,
            mask=mask,
            shown=style.visible,
        )

    def place(self, element: Element, matrix: Matrix, width: float, height: float) -> Shape:
        """The rectangle of a viewport."""
        sizes = {"width": width, "height": height}
        curves, dots = self._placed(
            basic_shapes.rectangle(lambda name, _: sizes.get(name)), matrix, element, True
        )
        return Shape(element.name, element.get("id", ""), element.line, curves, dots, None, None, 0.0)

    def in_context(self, paint: PaintValue, style: Style) -> PaintValue:
        """A paint as whoever is copied sees it: of its own, not of what it is in."""
        if paint.kind == "current":
            return PaintValue("colour", style.colour)
        if paint.kind in ("context-fill", "context-stroke"):
            return style.context[paint.kind == "context-stroke"]
        return paint

    def _paint(self, paint: PaintValue, style: Style, opacity: float, flat: bool) -> Paint | None:
        paint = self.in_context(paint, style)
        if paint.kind == "server":
            if self._links.paints(paint.server, flat):
                return Paint(None, opacity) if opacity > 0 else None
            paint = self.in_context(paint.fallback or NOTHING, style)
        if paint.colour is None or paint.kind != "colour":
            return None
        opacity *= paint.colour[3]
        return Paint(paint.colour, opacity) if opacity > 0 else None

    def _subpaths(self, element: Element, declared: dict[str, str], measure: Measure) -> list[Subpath]:
        if element.name in _BASIC:
            found = _BASIC[element.name](lengths_of(declared, measure))
            self._parts += sum(len(subpath.cubics) for subpath in found)
        else:
            most = MOST_PARTS - self._parts
            name = "d" if element.name == "path" else "points"
            text = element.get(name, "").strip()
            if name == "d":
                found, error, parts = path_subpaths(text, most)
            else:
                found, error, parts = polygon_subpaths(text, element.name == "polygon", most)
            self._parts += parts
            if error is not None and parts <= most:
                called = f" {element.get('id', '')[:40]!r}" if element.get("id") else ""
                near = f"{element.name}{called} from {text[error : error + 20]!r} on"
                self.omissions.append(Omission("path-data", element.line, near))
        if self._parts > MOST_PARTS:
            raise DrawingError(
                f"the lines have too many straight or curved parts (the limit is {MOST_PARTS})",
                str(self._path),
                "simplify the paths, in Inkscape with Path > Simplify",
            )
        return found

    def _placed(
        self, subpaths: list[Subpath], matrix: Matrix, element: Element, painted: bool
    ) -> tuple[tuple[Curve, ...], FloatArray]:
        """Subpaths as curves in px, and those without length as dots (n, 2)."""
        curves, dots = [], []
        for subpath in subpaths:
            cubics = applied(matrix, subpath.cubics)
            if painted:
                self._refuse_far(cubics, element)
            with np.errstate(over="ignore", invalid="ignore"):
                parts = cubics[np.abs(np.diff(cubics, axis=1)).max(axis=(1, 2)) > _SHORTEST_PX]
            if not len(parts):
                dots.append(cubics[0, 0])
                continue
            parts[1:, 0] = parts[:-1, 3]
            closed = subpath.closed or bool(np.allclose(parts[0, 0], parts[-1, 3], atol=_SHORTEST_PX))
            curves.append(Curve(parts, closed))
        return tuple(curves), np.array(dots, dtype=np.float64).reshape(-1, 2)

    def _refuse_far(self, cubics: FloatArray, element: Element) -> None:
        where = f"{self._path}:{element.line}"
        if not np.isfinite(cubics).all():
            raise DrawingError("a coordinate is not a finite number", where, "correct the path data")
        if np.abs(cubics).max() > _LARGEST_PX:
            problem = f"a coordinate is larger than {_LARGEST_PX:g} px"
            raise DrawingError(problem, where, "correct the path data")


def _is_flat(subpaths: list[Subpath]) -> bool:
    """Whether the box of subpaths has no area."""
    points = [subpath.cubics.reshape(-1, 2) for subpath in subpaths]
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(points) and bool((np.ptp(np.concatenate(points), axis=0) == 0).any())


def _stretched(element: Element, subpaths: list[Subpath]) -> float:
    """By how much longer a line is than its `pathLength`, which dashes are measured by (SVG 2, 9.6.1)."""
    said = number(element.get("pathLength"))
    if not said or said < 0:
        return 1.0
    t = np.linspace(0, 1, _LENGTH_SAMPLES + 1)
    return sum(total_length(line) for subpath in subpaths for line in evaluate(subpath.cubics, t)) / said
