"""Pictures on paper: the same shapes and marks as on the page, in reportlab's terms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from wrapit.geometry import BezierChain, Region
from wrapit.geometry.outlines.loops import as_chain
from wrapit.instructions.page.picture_svg import DOT, DROP
from wrapit.jig.bench.from_above import disc_mm
from wrapit.pages.model import Mark, Picture, Shape, Shared, Style

MM: Final = 72 / 25.4  # points in a millimetre: what reportlab counts in
# Fill, line and its width in mm of each style; a shape's own colour and width come before.
LOOKS: Final[dict[Style, tuple[str, str, float]]] = {
    "plate": ("#f4efe6", "#c4c4c4", 0.2),
    "wall": ("#d9c7a3", "#4a4a4a", 0.1),
    "wall-now": ("#8a5a12", "#1c1c1c", 0.2),
    "hole": ("#c4c4c4", "", 0.0),
    "wire": ("", "#1c1c1c", 0.5),
    "earlier": ("", "#1c1c1c", 0.5),
    "later": ("", "#b4b4b4", 0.5),
    "edge": ("", "#1c1c1c", 0.5),
    "present": ("", "#1c1c1c", 0.5),
    "arrow": ("", "#1c1c1c", 0.5),
    "ring": ("", "#1c1c1c", 0.5),
}
INK: Final = "#1c1c1c"
DISCS: Final = {"number": "#ffffff", "tie": "#fff3c4"}
# How strongly what was done before is drawn.
EARLIER_ALPHA: Final = 0.6
# The smallest text of a picture that a reader makes out at arm's length, in points.
LEAST_TEXT_PT: Final = 7.0


@dataclass(frozen=True)
class Brush:
    """What pictures are painted with: the canvas, the bold font, and shapes that many pictures share."""

    canvas: Any
    font: str
    shared: Mapping[str, tuple[Shape, ...]]

    def paint(self, picture: Picture, left_pt: float, bottom_pt: float, scale: float) -> None:
        """The picture with its lower left corner there; `scale` is 1 for true size."""
        canvas = self.canvas
        canvas.saveState()
        canvas.translate(left_pt, bottom_pt)
        canvas.scale(scale * MM, scale * MM)
        canvas.translate(-picture.low[0], -picture.low[1])
        canvas.setLineCap(1)
        canvas.setLineJoin(1)
        for shape in picture.shapes:
            self._shape(shape)
        size = max(picture.text_mm, LEAST_TEXT_PT / (scale * MM))
        for mark in picture.marks:
            self._mark(mark, size)
        canvas.restoreState()

    def form(self, key: str) -> str:
        """The name of a shared piece of drawing, written into the file once."""
        name = f"shape-{key}"
        if not self.canvas.hasForm(name):
            shapes = self.shared[key]
            corners = [
                shape.geometry.outer.sampled(0.5) for shape in shapes if isinstance(shape.geometry, Region)
            ]
            low = min(float(points.min()) for points in corners) - 1
            high = max(float(points.max()) for points in corners) + 1
            self.canvas.beginForm(name, low, low, high, high)
            for shape in shapes:
                self._line(shape, shape.style, shape.colour, shape.width_mm)
            self.canvas.endForm()
        return name

    def _shape(self, shape: Shape | Shared) -> None:
        if isinstance(shape, Shape):
            self._line(shape, shape.style, shape.colour, shape.width_mm)
        elif shape.style is None:
            self.canvas.doForm(self.form(shape.key))
        else:
            for each in self.shared[shape.key]:
                self._line(each, shape.style, shape.colour, shape.width_mm)

    def _line(self, shape: Shape, style: Style, colour: str, width_mm: float) -> None:
        canvas = self.canvas
        fill, line, width = LOOKS[style]
        canvas.saveState()
        if fill:
            canvas.setFillColor(fill)
        if line:
            canvas.setStrokeColor(colour or line)
            canvas.setLineWidth(width_mm or width)
        if style == "earlier":
            canvas.setStrokeAlpha(EARLIER_ALPHA)
        canvas.drawPath(self._path(shape), stroke=int(bool(line)), fill=int(bool(fill)), fillMode=0)
        canvas.restoreState()

    def _path(self, shape: Shape) -> Any:
        path, geometry = self.canvas.beginPath(), shape.geometry
        if isinstance(geometry, Region):
            for loop in (geometry.outer, *geometry.holes):
                path.moveTo(*map(float, loop.edges[0].start))
                for edge in loop.edges:
                    _curve(path, as_chain(edge))
                path.close()
        elif isinstance(geometry, BezierChain):
            path.moveTo(*map(float, geometry.start))
            _curve(path, geometry)
        else:
            path.moveTo(*map(float, geometry[0]))
            for point in geometry[1:]:
                path.lineTo(*map(float, point))
        return path

    def _mark(self, mark: Mark, size: float) -> None:
        canvas, (x, y) = self.canvas, mark.at
        canvas.setStrokeColor(INK)
        if mark.anchor is not None:
            canvas.setLineWidth(0.06 * size)
            canvas.line(x, y, *mark.anchor)
        if mark.kind == "dot":
            canvas.setFillColor(INK)
            canvas.circle(x, y, DOT * size, stroke=0, fill=1)
            return
        if mark.kind != "bare":
            canvas.setFillColor(DISCS[mark.kind])
            canvas.setLineWidth(0.06 * size)
            canvas.circle(x, y, disc_mm(mark.text, size), stroke=1, fill=1)
        canvas.setFillColor(INK)
        canvas.setFont(self.font, size)
        canvas.drawCentredString(x, y - DROP * size, mark.text)


def _curve(path: Any, chain: BezierChain) -> None:
    for cubic in chain.points:
        path.curveTo(*(float(value) for point in cubic[1:] for value in point))
