"""The basic shapes as subpaths (SVG 2, chapter 10): rectangles, circles, ellipses and lines."""

from __future__ import annotations

from collections.abc import Callable

from wrapit.drawing.svg.reading.lengths import Side
from wrapit.drawing.svg.reading.pen import Pen, Subpath

# Gives a length of a property in user units, None where there is none (`auto`, not in order, missing).
Lengths = Callable[[str, Side], float | None]


def rectangle(get: Lengths) -> list[Subpath]:
    """A rectangle; radii follow each other where one is `auto`, and are never more than half a side."""
    x, y = get("x", "width") or 0.0, get("y", "height") or 0.0
    width, height = get("width", "width") or 0.0, get("height", "height") or 0.0
    if not (width > 0 and height > 0):
        return []
    rx, ry = _radii(get)
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    round_corners = rx > 0 and ry > 0
    if not round_corners:
        rx = ry = 0.0
    right, bottom = x + width, y + height
    pen = Pen()
    pen.move((x + rx, y))
    for side, corner in (
        ((right - rx, y), (right, y + ry)),
        ((right, bottom - ry), (right - rx, bottom)),
        ((x + rx, bottom), (x, bottom - ry)),
        ((x, y + ry), (x + rx, y)),
    ):
        pen.line(side)
        if round_corners:
            pen.arc(rx, ry, 0.0, False, True, corner)
    pen.close()
    return pen.subpaths()


def circle(get: Lengths) -> list[Subpath]:
    """A circle."""
    radius = get("r", "both") or 0.0
    return _ellipse(get, radius, radius)


def ellipse(get: Lengths) -> list[Subpath]:
    """An ellipse; where one radius is `auto` it is the other."""
    return _ellipse(get, *_radii(get))


def line(get: Lengths) -> list[Subpath]:
    """A straight line."""
    pen = Pen()
    pen.move((get("x1", "width") or 0.0, get("y1", "height") or 0.0))
    pen.line((get("x2", "width") or 0.0, get("y2", "height") or 0.0))
    return pen.subpaths()


def _radii(get: Lengths) -> tuple[float, float]:
    """Both radii; a negative one counts as `auto`."""
    rx, ry = (
        None if value is None or value < 0 else value for value in (get("rx", "width"), get("ry", "height"))
    )
    if rx is None:
        rx = ry
    if ry is None:
        ry = rx
    return rx or 0.0, ry or 0.0


def _ellipse(get: Lengths, rx: float, ry: float) -> list[Subpath]:
    if not (rx > 0 and ry > 0):
        return []
    x, y = get("cx", "width") or 0.0, get("cy", "height") or 0.0
    pen = Pen()
    pen.move((x + rx, y))
    for corner in ((x, y + ry), (x - rx, y), (x, y - ry), (x + rx, y)):
        pen.arc(rx, ry, 0.0, False, True, corner)
    pen.close()
    return pen.subpaths()
