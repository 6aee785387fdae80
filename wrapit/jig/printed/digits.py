"""Numbers as pen strokes, so that engraving needs no font."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.geometry import FloatArray

# Each digit in a box 3 wide and 5 high: strokes as lists of points.
_STROKES: dict[str, list[list[tuple[float, float]]]] = {
    "0": [[(0, 1), (0, 4), (1, 5), (2, 5), (3, 4), (3, 1), (2, 0), (1, 0), (0, 1)]],
    "1": [[(0.5, 4), (1.5, 5), (1.5, 0)]],
    "2": [[(0, 4), (1, 5), (2, 5), (3, 4), (3, 3.2), (0, 0), (3, 0)]],
    "3": [[(0, 5), (3, 5), (1.4, 3), (2, 3), (3, 2), (3, 1), (2, 0), (1, 0), (0, 0.8)]],
    "4": [[(2.3, 0), (2.3, 5), (0, 1.6), (3, 1.6)]],
    "5": [[(3, 5), (0.2, 5), (0, 2.8), (1.8, 3.1), (3, 2.2), (3, 1), (2, 0), (1, 0), (0, 0.7)]],
    "6": [[(2.6, 5), (1, 4), (0, 2), (0, 1), (1, 0), (2, 0), (3, 1), (3, 2), (2, 2.9), (1, 2.9), (0, 2)]],
    "7": [[(0, 5), (3, 5), (1, 0)]],
    "8": [
        [(1, 2.7), (0, 3.4), (0, 4.3), (1, 5), (2, 5), (3, 4.3), (3, 3.4), (2, 2.7), (1, 2.7)],
        [(1, 2.7), (0, 1.9), (0, 0.8), (1, 0), (2, 0), (3, 0.8), (3, 1.9), (2, 2.7)],
    ],
    "9": [[(0.4, 0), (2, 1), (3, 3), (3, 4), (2, 5), (1, 5), (0, 4), (0, 3), (1, 2.1), (2, 2.1), (3, 3)]],
}
# The box of a digit, and from one to the next: strokes of 0.6 mm stay open between digits of 2.5 mm.
_BOX = (3.0, 5.0)
_ADVANCE = 4.4


def number_polygon(number: int, height_mm: float, stroke_mm: float) -> Any:
    """The number as shapely geometry, `height_mm` high to the outside of its strokes, centred on (0, 0).

    Raises ValueError for negative numbers.
    """
    import shapely

    if number < 0:
        raise ValueError("only numbers from 0 up can be engraved")
    scale = (height_mm - stroke_mm) / _BOX[1]
    lines = [
        shapely.LineString(_placed(stroke, index * _ADVANCE, scale))
        for index, digit in enumerate(str(number))
        for stroke in _STROKES[digit]
    ]
    # Square ends and mitred bends: a third of the sides that round ones need, and as easy to read.
    inked = shapely.union_all(
        shapely.buffer(lines, stroke_mm / 2, cap_style="square", join_style="mitre", mitre_limit=2.0)
    )
    x0, y0, x1, y1 = inked.bounds
    return shapely.affinity.translate(inked, -(x0 + x1) / 2, -(y0 + y1) / 2)


def _placed(stroke: list[tuple[float, float]], shift: float, scale: float) -> FloatArray:
    return (np.array(stroke) + np.array([shift, 0.0])) * scale
