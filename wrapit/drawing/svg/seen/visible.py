"""Which strokes of a page are lines, and what of each is seen; what is lost on the way."""

from __future__ import annotations

from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Page, Shape
from wrapit.drawing.svg.seen.clipping import Seen
from wrapit.drawing.svg.seen.covers import Covers
from wrapit.drawing.svg.seen.dashes import of_dashes
from wrapit.drawing.svg.seen.losses import Loss, What
from wrapit.drawing.svg.seen.paper import erasing
from wrapit.drawing.svg.seen.parting import length, middle
from wrapit.drawing.svg.seen.regions import Regions

# In widths: a stroke that is shorter is a dot to the eye, its caps are all of it. Icons write dots as lines
# of 0.004 to 0.01 widths; the shortest strokes meant as lines are 0.5 wide.
_DOT = 0.1


class Visible:
    """The strokes of a page as far as they are seen; `losses` grows with each shape asked for."""

    def __init__(self, page: Page) -> None:
        regions = Regions()
        self.losses: list[Loss] = []
        self._page = page
        self._erasing = erasing(page, regions)
        self._seen = Seen(page, regions)
        self._covers = Covers(page, self._erasing, regions)
        for number in sorted(self._erasing):
            shape = page.shapes[number]
            self._lose("erasing", shape, self._seen.parts(shape, shape.curves).within)

    def is_line(self, number: int) -> bool:
        """Whether the shape with that number is stroked, and not only to erase."""
        return self._page.shapes[number].stroke is not None and number not in self._erasing

    def lines(self, number: int) -> list[Curve]:
        """What is seen of the stroke of the shape with that number."""
        shape = self._page.shapes[number]
        curves = self._without_dots(shape)
        if shape.dashes:
            curves = self._of_dashes(shape, curves)
        parts = self._seen.parts(shape, curves)
        self._lose("clipped", shape, parts.beyond)
        parts = self._covers.parts(number, parts.within)
        self._lose("hidden", shape, parts.beyond)
        if shape.mask and parts.within:
            longest = max(parts.within, key=length)
            lost = Loss("masked", middle(longest), length(longest), shape.line, shape.mask)
            self.losses.append(lost)
        return parts.within

    def _without_dots(self, shape: Shape) -> list[Curve]:
        """The curves of a shape that are longer than a dot."""
        dots = list(shape.dots) if shape.cap in ("round", "square") else []
        curves = []
        for curve in shape.curves:
            # Control points reach farther than the curve: only where they are near, it is measured.
            near = abs(curve.cubics - curve.cubics[0, 0]).max() < _DOT * shape.stroke_width
            if near and length(curve) < _DOT * shape.stroke_width:
                dots.append(middle(curve))
            else:
                curves.append(curve)
        self.losses += [Loss("dots", dot, 0.0, shape.line, shape.name, shape.stroke_width) for dot in dots]
        return curves

    def _of_dashes(self, shape: Shape, curves: list[Curve]) -> list[Curve]:
        found = []
        for curve in curves:
            dashed = of_dashes(curve, shape)
            if dashed.curve is not None:
                found.append(dashed.curve)
            if dashed.drawn == "dashed":
                self._lose("dashed", shape, [curve])
            elif dashed.drawn == "less":
                whole, left = length(curve), length(dashed.curve) if dashed.curve else 0.0
                lost = Loss("undrawn", middle(curve), whole - left, shape.line, shape.name)
                self.losses.append(lost)
        return found

    def _lose(self, what: What, shape: Shape, curves: list[Curve]) -> None:
        self.losses += [Loss(what, middle(curve), length(curve), shape.line, shape.name) for curve in curves]
