"""The base plate's outline."""

from __future__ import annotations

import math
from typing import Any

from wrapit.geometry import Arc, Edge, Line, Loop


def rounded_rectangle(low: tuple[float, float], high: tuple[float, float], radius_mm: float) -> Loop:
    """Counter-clockwise from the lower left; the radius is cut to half the shorter side."""
    (x0, y0), (x1, y1) = low, high
    r = min(radius_mm, (x1 - x0) / 2, (y1 - y0) / 2)
    if r < 1e-6:
        return Loop(
            (
                Line((x0, y0), (x1, y0)),
                Line((x1, y0), (x1, y1)),
                Line((x1, y1), (x0, y1)),
                Line((x0, y1), (x0, y0)),
            )
        )
    quarter = math.pi / 2
    corners = [
        Arc((x1 - r, y0 + r), r, -quarter, quarter),
        Arc((x1 - r, y1 - r), r, 0.0, quarter),
        Arc((x0 + r, y1 - r), r, quarter, quarter),
        Arc((x0 + r, y0 + r), r, 2 * quarter, quarter),
    ]
    edges: list[Edge] = []
    for before, corner in zip(corners[-1:] + corners[:-1], corners, strict=True):
        if math.dist(before.end, corner.start) > 1e-9:
            edges.append(Line(before.end, corner.start))
        edges.append(corner)
    return Loop(tuple(edges))


def plate_outline(covered: Any, margin_mm: float, radius_mm: float) -> Loop:
    """A rounded rectangle with a margin around everything covered (shapely geometry)."""
    x0, y0, x1, y1 = covered.bounds
    low, high = (x0 - margin_mm, y0 - margin_mm), (x1 + margin_mm, y1 + margin_mm)
    return rounded_rectangle(low, high, radius_mm)
