"""What is paper in an SVG file: the colour behind each stroke, and strokes that only erase."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.svg.reading.model import Page, Paint, Shape
from wrapit.drawing.svg.reading.paints import Colour
from wrapit.drawing.svg.seen.parting import points
from wrapit.drawing.svg.seen.regions import Regions, filled
from wrapit.drawing.svg.steps import queried
from wrapit.geometry import FloatArray, IntArray

# Paper is nearly white: 230 of 255 in each colour, as cream and pale grey are.
WHITE = 230 / 255
# Two colours that differ less in each of red, green and blue are one to the eye: as pale grey on white.
_ALIKE = 1 - WHITE
# A line darker than this (relative luminance, of which red makes 0.21, green 0.72, blue 0.07) shows that a
# page of no colour is meant to be light; on a dark page it would hardly be seen.
_DARK = 0.5
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
# What shows less of what is behind it hides it.
_OPAQUE = 0.99
# Places along a shape where is asked what is behind it; most of them count.
_ASKED = 5


def opaque(paint: Paint | None) -> bool:
    """Whether a paint hides what is behind it; gradients and patterns may have holes."""
    return paint is not None and paint.colour is not None and paint.opacity >= _OPAQUE


def is_white(colour: Colour | None) -> bool:
    """Whether a colour is that of paper by itself."""
    return colour is not None and min(colour[:3]) > WHITE


def alike(one: Colour | None, other: Colour | None) -> bool:
    """Whether two colours are one to the eye."""
    return one is not None and other is not None and max(map(_apart, one[:3], other[:3])) <= _ALIKE


def _apart(one: float, other: float) -> float:
    return abs(one - other)


def paper_of(page: Page) -> Colour | None:
    """The colour behind all: as the file says, white under dark lines, else unknown."""
    if page.background is not None:
        return page.background
    strokes = [shape.stroke.colour for shape in page.shapes if shape.stroke and shape.stroke.colour]
    light = all(float(_LUMINANCE @ colour[:3]) > _DARK for colour in strokes)
    return None if light else (1.0, 1.0, 1.0, 1.0)


def erasing(page: Page, regions: Regions) -> set[int]:
    """Numbers of the shapes whose stroke has the colour of what it lies on."""
    asked = [k for k, shape in enumerate(page.shapes) if shape.stroke and shape.curves]
    if not asked:
        return set()
    behind = _behind(page, [page.shapes[k] for k in asked], np.array(asked), regions)
    paper = paper_of(page)
    found = set()
    for k, shapes in zip(asked, behind, strict=True):
        stroke = page.shapes[k].stroke
        colours = [_fill(page.shapes[fill]) if fill >= 0 else paper for fill in shapes]
        if sum(alike(stroke.colour if stroke else None, colour) for colour in colours) > _ASKED / 2:
            found.add(k)
    return found


def _fill(shape: Shape) -> Colour | None:
    return shape.fill.colour if shape.fill else None


def _behind(page: Page, shapes: list[Shape], numbers: IntArray, regions: Regions) -> IntArray:
    """The latest opaque fill behind each shape at some places (n, _ASKED); -1 for none."""
    from shapely import STRtree
    from shapely import points as point_of

    fills = [k for k, shape in enumerate(page.shapes) if opaque(shape.fill) and not shape.mask]
    latest = np.full(len(shapes) * _ASKED, -1)
    if fills:
        tree = STRtree([regions.clipped(filled(page.shapes[k]), page.shapes[k]) for k in fills])
        places = np.concatenate([_places(shape) for shape in shapes])
        before, number = np.repeat(numbers, _ASKED), np.array(fills)
        for at, fill in queried(tree, len(places), lambda some: point_of(places[some]), "intersects"):
            earlier = number[fill] < before[at]
            np.maximum.at(latest, at[earlier], number[fill][earlier])
    return latest.reshape(-1, _ASKED)


def _places(shape: Shape) -> FloatArray:
    """Places (_ASKED, 2) along all curves of a shape, none of them an end."""
    cubics = np.concatenate([curve.cubics for curve in shape.curves])
    shares = (np.arange(_ASKED) + 0.5) / _ASKED
    return points(cubics, shares * len(cubics))
