"""The base plate's outline and its screw holes."""

from __future__ import annotations

import math
from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import JigError
from wrapit.geometry import Arc, Edge, Line, Loop

RIM_MM = 1.2  # plate around a screw hole


def rounded_rectangle(low: tuple[float, float], high: tuple[float, float], radius_mm: float) -> Loop:
    """Counter-clockwise from the lower left; the radius is cut to half the shorter side."""
    (x0, y0), (x1, y1) = low, high
    r = min(radius_mm, (x1 - x0) / 2, (y1 - y0) / 2)
    if r < 1e-6:
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        return Loop(tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))
    quarter = math.pi / 2
    arcs = [
        Arc((x1 - r, y0 + r), r, -quarter, quarter),
        Arc((x1 - r, y1 - r), r, 0.0, quarter),
        Arc((x0 + r, y1 - r), r, quarter, quarter),
        Arc((x0 + r, y0 + r), r, 2 * quarter, quarter),
    ]
    edges: list[Edge] = []
    for before, arc in zip(arcs[-1:] + arcs[:-1], arcs, strict=True):
        if math.dist(before.end, arc.start) > 1e-9:
            edges.append(Line(before.end, arc.start))
        edges.append(arc)
    return Loop(tuple(edges))


def plate_outline(covered: Any, config: JigConfig, name: str) -> tuple[Loop, tuple[Loop, ...]]:
    """A rounded rectangle with the margin around everything covered, and its screw holes.

    Raises JigError where the plate is larger than the printer's bed, either way round.
    """
    x0, y0, x1, y1 = covered.bounds
    margin = max(config.margin, config.screw_hole + 2 * RIM_MM if config.screw_hole else 0.0)
    low, high = (x0 - margin, y0 - margin), (x1 + margin, y1 + margin)
    size = (high[0] - low[0], high[1] - low[1])
    beds = ((config.bed_width, config.bed_depth), (config.bed_depth, config.bed_width))
    if not any(size[0] <= bed[0] and size[1] <= bed[1] for bed in beds):
        raise JigError(
            f"the plate of {size[0]:.0f} x {size[1]:.0f} mm is larger than the bed of"
            f" {config.bed_width:.0f} x {config.bed_depth:.0f} mm",
            name,
            "make the piece smaller, or set jig.bed_width and jig.bed_depth to those of your printer",
        )
    inset = RIM_MM + config.screw_hole / 2
    screws = [
        Loop((Arc((x, y), config.screw_hole / 2, 0.0, 2 * math.pi),))
        for x in (low[0] + inset, high[0] - inset)
        for y in (low[1] + inset, high[1] - inset)
        if config.screw_hole
    ]
    # The rounding leaves the screw holes their rim.
    radius = min(config.corner_radius, inset) if screws else config.corner_radius
    return rounded_rectangle(low, high, radius), tuple(screws)
