"""Numbers as round pen strokes, so that engraving needs no font."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.geometry import FloatArray

# Each digit in a box 3 wide and 5 high: strokes as the points that pull a curve, through the first, the
# middles between neighbours, and the last. A point given twice is a corner; a stroke that ends where it
# starts is closed.
_STROKES: dict[str, list[list[tuple[float, float]]]] = {
    "0": [[(0, 2.5), (0, 5), (3, 5), (3, 0), (0, 0), (0, 2.5)]],
    "1": [[(0.5, 4), (1.5, 5), (1.5, 5), (1.5, 0)]],
    "2": [[(0.1, 3.7), (0.1, 5), (3, 5), (3, 3), (0, 0), (0, 0), (3, 0)]],
    "3": [
        [(0.2, 5), (2.8, 5), (2.8, 2.7), (1.2, 2.7)],
        [(1.2, 2.7), (3, 2.7), (3, 0), (0.1, 0)],
    ],
    "4": [[(2.3, 0), (2.3, 5), (2.3, 5), (0, 1.6), (0, 1.6), (3, 1.6)]],
    "5": [[(2.8, 5), (0.3, 5), (0.3, 5), (0.1, 3), (0.1, 3), (3, 3.4), (3, 0), (0.5, 0)]],
    "6": [[(2.6, 5), (0, 4.4), (0, 0), (3, 0), (3, 3), (1, 3), (0.5, 2.2)]],
    "7": [[(0, 5), (3, 5), (3, 5), (1, 0)]],
    "8": [
        [(1.5, 2.7), (0.3, 2.7), (0.3, 5), (2.7, 5), (2.7, 2.7), (1.5, 2.7)],
        [(1.5, 2.7), (0, 2.7), (0, 0), (3, 0), (3, 2.7), (1.5, 2.7)],
    ],
    "9": [[(0.4, 0), (3, 0.6), (3, 5), (0, 5), (0, 2), (2, 2), (2.5, 2.8)]],
}
# The box of a digit.
_BOX = (3.0, 5.0)
# Plate that stays between two digits, as between grooves: narrower webs don't print. With 4.4 of the
# box's units from one to the next an 8 of 2.5 mm ran into its neighbour.
_APART_MM = 0.3
# Into how many lines is each pulled stretch of a stroke divided? They bend by 7° so, far from a corner.
_LINES = 16


def number_polygon(number: int, height_mm: float, stroke_mm: float) -> Any:
    """The number as shapely geometry, `height_mm` high to the outside of its strokes, centred on (0, 0).

    Raises ValueError for negative numbers.
    """
    import shapely

    if number < 0:
        raise ValueError("only numbers from 0 up can be engraved")
    scale = (height_mm - stroke_mm) / _BOX[1]
    advance = _BOX[0] * scale + stroke_mm + _APART_MM
    lines = [
        _line(_curve(np.array(stroke)) * scale + np.array([index * advance, 0.0]))
        for index, digit in enumerate(str(number))
        for stroke in _STROKES[digit]
    ]
    # Square ends and mitred corners: a third of the sides that round ones need, and as easy to read.
    inked = shapely.union_all(
        shapely.buffer(lines, stroke_mm / 2, cap_style="square", join_style="mitre", mitre_limit=2.0)
    )
    x0, y0, x1, y1 = inked.bounds
    return shapely.affinity.translate(inked, -(x0 + x1) / 2, -(y0 + y1) / 2)


def _line(points: FloatArray) -> Any:
    import shapely

    if np.array_equal(points[0], points[-1]):
        return shapely.LinearRing(points)
    return shapely.LineString(points)


def _curve(pulls: FloatArray) -> FloatArray:
    """Points along the quadratic B-spline of a stroke's points (n, 2), straight between two corners."""
    joints = (pulls[:-1] + pulls[1:]) / 2
    joints[0], joints[-1] = pulls[0], pulls[-1]
    parts = [pulls[:1]]
    t = (np.arange(1, _LINES + 1) / _LINES)[:, None]
    for start, pull, end in zip(joints[:-1], pulls[1:-1], joints[1:], strict=True):
        straight = np.array_equal(pull, start) or np.array_equal(pull, end)
        parts.append(end[None] if straight else (1 - t) ** 2 * start + 2 * t * (1 - t) * pull + t**2 * end)
    return np.concatenate(parts)
