"""What an SVG file paints, in the order in which it does."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.programs import Program
from wrapit.drawing.svg.reading.matrices import Matrix, applied, determinant, inverse
from wrapit.drawing.svg.reading.paints import Colour
from wrapit.geometry import FloatArray

# What of a file is not drawn as a browser would draw it.
Missing = Literal[
    "text",
    "picture",
    "foreign",
    "other-file",
    "style-sheet",
    "recursion",
    "markers",
    "path-data",
    "transform",
]


@dataclass(frozen=True)
class Paint:
    """Paint: its colour (None for a gradient or a pattern), and its opacity (0 to 1) with all groups."""

    colour: Colour | None
    opacity: float


@dataclass(frozen=True, eq=False)
class Clip:
    """What is seen through: the fills of all its shapes together; each shape may be clipped itself."""

    shapes: tuple[Shape, ...]


@dataclass(frozen=True, eq=False)
class Shape:
    """One thing that is painted: first its fill, then its stroke. All lengths in px, after all transforms.

    `dots` (n, 2) are subpaths without length. `dashes` and gaps follow in turn, from `dash_offset` on, anew
    for each curve; none for a whole line. A point is seen that lies in all `clips`; `mask` is a mask's name.
    """

    tag: str
    name: str
    line: int
    curves: tuple[Curve, ...]
    dots: FloatArray
    fill: Paint | None
    stroke: Paint | None
    stroke_width: float
    fill_rule: str = "nonzero"
    clip_rule: str = "nonzero"
    cap: str = "butt"
    join: str = "miter"
    dashes: tuple[float, ...] = ()
    dash_offset: float = 0.0
    mask: str = ""
    shown: bool = True
    clips: tuple[Clip, ...] = ()

    def moved(self, matrix: Matrix) -> Shape:
        """The shape with its clips under a further transform."""
        factor = abs(determinant(matrix)) ** 0.5
        return replace(
            self,
            curves=tuple(Curve(applied(matrix, curve.cubics), curve.closed) for curve in self.curves),
            dots=applied(matrix, self.dots),
            stroke_width=self.stroke_width * factor,
            dashes=tuple(factor * length for length in self.dashes),
            dash_offset=factor * self.dash_offset,
            clips=tuple(Clip(tuple(shape.moved(matrix) for shape in clip.shapes)) for clip in self.clips),
        )


@dataclass(frozen=True)
class Omission:
    """Something that is not drawn, or not as it is meant: what, in which line, and which text is at fault."""

    what: Missing
    line: int
    text: str = ""


@dataclass(frozen=True, eq=False)
class Page:
    """All that a file paints, its size in px, and what is left out.

    `frame` is the edge of the page; None where the file says nothing of it, so that nothing lies outside.
    `background` is the colour behind all, where the file gives one, `program` what made the file.
    """

    shapes: tuple[Shape, ...]
    size: tuple[float, float]
    frame: Clip | None
    omissions: tuple[Omission, ...] = field(default=())
    background: Colour | None = None
    program: Program = ""


def box_within(shapes: Iterable[Shape], matrix: Matrix) -> tuple[float, float, float, float] | None:
    """x, y, width and height of shapes in the units from which a matrix leads to px."""
    back = inverse(matrix)
    found = _bounds(shape.moved(back) for shape in shapes) if back else None
    if found is None:
        return None
    (x, y), (right, bottom) = found
    return float(x), float(y), float(right - x), float(bottom - y)


def _bounds(shapes: Iterable[Shape]) -> tuple[FloatArray, FloatArray] | None:
    """Lowest and highest corner (2,) of the shapes' outlines; None where there are none."""
    points = []
    for shape in shapes:
        points += [_extremes(curve.cubics) for curve in shape.curves if len(curve.cubics)]
        points += [shape.dots] if len(shape.dots) else []
    if not points:
        return None
    together = np.concatenate(points)
    return together.min(axis=0), together.max(axis=0)


def _extremes(cubics: FloatArray) -> FloatArray:
    """Ends of cubics (n, 4, 2), and where they turn back in x or y: (m, 2) that span their boxes."""
    a, b, c, d = np.moveaxis(cubics, 1, 0)
    second, first, zeroth = d - 3 * c + 3 * b - a, 2 * (c - 2 * b + a), b - a
    found = [a, d]
    with np.errstate(all="ignore"):
        root = np.sqrt(np.maximum(first**2 - 4 * second * zeroth, 0.0))
        for turn in ((-first + root) / (2 * second), (-first - root) / (2 * second), -zeroth / first):
            t = np.where(np.isfinite(turn), np.clip(turn, 0.0, 1.0), 0.0)
            s = 1 - t
            found.append(s**3 * a + 3 * s * s * t * b + 3 * s * t * t * c + t**3 * d)
    return np.concatenate(found)
