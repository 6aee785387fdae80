"""Reads the strokes of an SVG file: safely, and without loading anything it refers to."""

from __future__ import annotations

import io
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.svg.document import paths_of, safe_document
from wrapit.drawing.svg.element import Element
from wrapit.drawing.svg.limits import refuse_parts
from wrapit.drawing.svg.planar import Curve
from wrapit.errors import DrawingError
from wrapit.geometry import FloatArray

# CSS and SVG 2: a pixel is a 96th of an inch.
_MM_PER_PX = 25.4 / 96
# Larger coordinates are slips of a unit or an exponent; products of these are still far from overflow.
_LARGEST_PX = 1e12
# What svgelements raises on numbers and names that it can't make sense of.
_FAULTS = (
    ValueError,
    TypeError,
    AttributeError,
    LookupError,
    ArithmeticError,
    AssertionError,
    RecursionError,
)


@dataclass(frozen=True, eq=False)
class Strokes:
    """The curves of an SVG file in its own pixels (96 per inch, y down), and their usual width."""

    curves: list[Curve]
    width_px: float | None
    filled: int
    mm_per_px: float


def read_strokes(path: Path, tracing: TracingConfig) -> Strokes:
    """The stroked curves of an SVG file.

    Raises DrawingError where it can't be read, isn't safe, or has none.
    """
    data, elements = safe_document(path)
    root = _drawn(data, elements, path)
    try:
        return _strokes(root, tracing, path)
    except _FAULTS as error:
        raise _not_understood(error, elements, path) from None


def _strokes(root: Any, tracing: TracingConfig, path: Path) -> Strokes:
    curves: list[Curve] = []
    widths: list[float] = []
    filled = parts = drawn = 0
    for shape in _shapes(root):
        stroked = _paints(shape.stroke)
        drawn += stroked
        if not stroked:
            if not _paints(shape.fill) or _is_ground(shape, root):
                continue
            filled += 1
            if tracing.filled == "refuse":
                continue
        found = _curves(shape, path)
        curves += found
        parts += sum(len(curve.cubics) for curve in found)
        refuse_parts(parts, path)
        if stroked and shape.stroke_width:
            scale = math.sqrt(
                abs(shape.transform.a * shape.transform.d - shape.transform.b * shape.transform.c)
            )
            width = float(shape.implicit_stroke_width or shape.stroke_width * scale)
            widths += [width] * len(found)
    if not curves:
        if drawn:
            problem = f"the drawing's lines ({drawn} in all) have no length"
            raise DrawingError(problem, str(path), "draw at least one line that is longer than a dot")
        if filled:
            shapes = "1 filled shape" if filled == 1 else f"{filled} filled shapes"
            raise DrawingError(
                f"the drawing has {shapes} and no stroked lines",
                str(path),
                "draw centre lines with a stroke, or set tracing.filled to outline",
            )
        raise DrawingError(
            "the drawing has no stroked lines that are shown", str(path), "give the lines a stroke"
        )
    usual = float(np.median(widths)) if widths else None
    return Strokes(
        curves, usual if usual and math.isfinite(usual) and usual > 0 else None, filled, _mm_per_px(root)
    )


def _mm_per_px(root: Any) -> float:
    """Exact scale; svgelements takes a metric unit for 0.0393701 inches per mm."""
    metric = re.fullmatch(r"[-+.\deE]+\s*(?:mm|cm)", str(root.values.get("width", "")).strip())
    return _MM_PER_PX / (25.4 * 0.0393701) if metric else _MM_PER_PX


def _drawn(data: bytes, elements: Element, path: Path) -> Any:
    from xml.etree.ElementTree import ParseError

    from svgelements import SVG

    try:
        return SVG.parse(io.BytesIO(data), reify=True, ppi=96.0, on_error="raise")
    except (*_FAULTS, ParseError) as error:
        raise _not_understood(error, elements, path) from None


def _not_understood(error: Exception, elements: Element, path: Path) -> DrawingError:
    """The refusal of a file that svgelements can't read, with the path that is at fault where one is."""
    from svgelements import Path as SvgPath

    for element in paths_of(elements):
        try:
            SvgPath().parse(element.attributes["d"])
        except _FAULTS:
            name = element.attributes.get("id", "")
            which = f" {name[:40]!r}" if name else ""
            return DrawingError(
                f"the data of path{which} is not complete or not in order",
                f"{path}:{element.line}",
                "correct it, or delete the path",
            )
    # The error's own text speaks of Python's lists, not of the file.
    reason = "a number is out of its range or no number at all"
    if isinstance(error, LookupError | TypeError | AttributeError):
        reason = "a number or a name is missing where one is needed, as in a transform"
    return DrawingError(f"the SVG file can't be understood ({reason})", str(path), "save it as plain SVG")


def _shapes(root: Any) -> list[Any]:
    from svgelements import Shape

    shapes = []
    for element in root.elements():
        if not isinstance(element, Shape):
            continue
        values = element.values
        style = str(values.get("style", ""))
        hidden = values.get("visibility") in ("hidden", "collapse") or "visibility:hidden" in style.replace(
            " ", ""
        )
        gone = values.get("display") == "none" or "display:none" in style.replace(" ", "")
        clear = _is_zero(values.get("opacity")) or (_is_zero(values.get("stroke-opacity")))
        if not (hidden or gone or clear):
            shapes.append(element)
    return shapes


def _is_zero(value: object) -> bool:
    try:
        return value is not None and float(str(value)) == 0
    except ValueError:
        return False


def _paints(colour: Any) -> bool:
    return colour is not None and colour.value is not None and colour.alpha != 0


def _is_ground(shape: Any, root: Any) -> bool:
    """Whether a filled shape is the paper: nearly white, or as large as the picture."""
    fill = shape.fill
    if min(fill.red, fill.green, fill.blue) > 230:
        return True
    box = shape.bbox()
    if box is None or root.width is None or root.height is None:
        return False
    return bool((box[2] - box[0]) * (box[3] - box[1]) > 0.9 * float(root.width) * float(root.height))


def _curves(shape: Any, path: Path) -> list[Curve]:
    from svgelements import Arc, Close, CubicBezier, Line, Move, QuadraticBezier
    from svgelements import Path as SvgPath

    curves: list[Curve] = []
    cubics: list[FloatArray] = []

    def finish(closed: bool) -> None:
        if cubics:
            curves.append(
                Curve(_chained(cubics), closed or bool(np.allclose(cubics[0][0], cubics[-1][3], atol=1e-9)))
            )
            cubics.clear()

    for part in SvgPath(shape):
        if isinstance(part, Move):
            finish(False)
        elif isinstance(part, Close):
            if part.start is not None and part.end is not None:
                _add(cubics, [_line(part.start, part.end)], path)
            finish(True)
        elif isinstance(part, Line):
            _add(cubics, [_line(part.start, part.end)], path)
        elif isinstance(part, QuadraticBezier):
            a, b, c = (np.array([p.x, p.y]) for p in (part.start, part.control, part.end))
            _add(cubics, [np.stack([a, a + 2 / 3 * (b - a), c + 2 / 3 * (b - c), c])], path)
        elif isinstance(part, CubicBezier):
            _add(cubics, [_control(part)], path)
        elif isinstance(part, Arc):
            _add(cubics, [_control(cubic) for cubic in part.as_cubic_curves()], path)
    finish(False)
    return curves


def _add(cubics: list[FloatArray], new: list[FloatArray], path: Path) -> None:
    for cubic in new:
        if not np.isfinite(cubic).all():
            raise DrawingError("a coordinate is not a finite number", str(path), "correct the path data")
        if np.abs(cubic).max() > _LARGEST_PX:
            raise DrawingError(
                f"a coordinate is larger than {_LARGEST_PX:g} px", str(path), "correct the path data"
            )
        if np.abs(np.diff(cubic, axis=0)).max() > 1e-9:
            cubics.append(cubic)


def _line(start: Any, end: Any) -> FloatArray:
    a, b = np.array([start.x, start.y]), np.array([end.x, end.y])
    if not (np.isfinite(a).all() and np.isfinite(b).all()):
        return np.full((4, 2), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large is refused by name
        return np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b])


def _control(part: Any) -> FloatArray:
    return np.array(
        [[p.x, p.y] for p in (part.start, part.control1, part.control2, part.end)], dtype=np.float64
    )


def _chained(cubics: list[FloatArray]) -> FloatArray:
    chain = np.array(cubics)
    chain[1:, 0] = chain[:-1, 3]
    return chain
