"""The base plate's outline and its screw holes."""

from __future__ import annotations

import math
from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import JigError
from wrapit.geometry import Loop
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.jig.printed.fitted_plate import fitted_outline

# Plate around a screw hole: three lines of a nozzle of 0.4 mm, under the head of the screw.
RIM_MM = 1.2
# How much more room than it needs is given to a ring of screws, so that rounding closes none of it; and how
# much the margin grows where four screws still find no place (round a piece smaller than their heads).
SPARE_MM = 0.1
WIDER = 1.25
# A polygon this near to an outline says what fits inside; screws and numbers keep more from its edge.
SAMPLED_MM = 0.01


def plate_outline(covered: Any, config: JigConfig, name: str) -> tuple[Loop, tuple[Loop, ...]]:
    """The plate with the margin around everything covered (shapely), and its screw holes.

    Raises JigError where the plate is larger than the printer's bed, either way round.
    """
    outline, screws = (_rectangle if config.plate == "rectangle" else _fitted)(covered, config)
    _check_bed(outline, config, name)
    return outline, screws


def polygon_within(loop: Loop) -> Any:
    """The loop as a shapely polygon, within SAMPLED_MM."""
    import shapely

    return shapely.Polygon(loop.sampled(SAMPLED_MM))


def _rectangle(covered: Any, config: JigConfig) -> tuple[Loop, tuple[Loop, ...]]:
    x0, y0, x1, y1 = covered.bounds
    margin = max(config.margin, _screw_room(config))
    low, high = (x0 - margin, y0 - margin), (x1 + margin, y1 + margin)
    inset = RIM_MM + config.screw_hole / 2
    screws = [
        circle((x, y), config.screw_hole / 2)
        for x in (low[0] + inset, high[0] - inset)
        for y in (low[1] + inset, high[1] - inset)
        if config.screw_hole
    ]
    # The rounding leaves the screw holes their rim.
    radius = min(config.corner_radius, inset) if screws else config.corner_radius
    return rounded_rectangle(*low, *high, radius), tuple(screws)


def _fitted(covered: Any, config: JigConfig) -> tuple[Loop, tuple[Loop, ...]]:
    """The outline, its margin grown until four screws have their rim in it."""
    margin = max(config.margin, _screw_room(config) + SPARE_MM if config.screw_hole else 0.0)
    outline = fitted_outline(covered, margin, config.corner_radius)
    if not config.screw_hole:
        return outline, ()
    while (screws := _screws(polygon_within(outline), covered, config.screw_hole)) is None:
        margin *= WIDER
        outline = fitted_outline(covered, margin, config.corner_radius)
    return outline, screws


def _screws(plate: Any, covered: Any, hole_mm: float) -> tuple[Loop, ...] | None:
    """Holes as far out as possible towards each corner of the plate's box; None where one has no place."""
    import shapely

    inset = RIM_MM + hole_mm / 2
    room = plate.buffer(-inset).difference(covered.buffer(inset))
    left, bottom, right, top = plate.bounds
    screws = []
    for corner in ((left, bottom), (left, top), (right, bottom), (right, top)):
        if room.is_empty:
            return None
        points = shapely.get_coordinates(room)
        x, y = (float(value) for value in min(points.tolist(), key=lambda point: math.dist(point, corner)))
        screws.append(circle((x, y), hole_mm / 2))
        room = room.difference(shapely.Point(x, y).buffer(hole_mm + RIM_MM))
    return tuple(screws)


def _screw_room(config: JigConfig) -> float:
    """How wide a margin is that has room for screws with their rims."""
    return config.screw_hole + 2 * RIM_MM if config.screw_hole else 0.0


def _check_bed(outline: Loop, config: JigConfig, name: str) -> None:
    x0, y0, x1, y1 = polygon_within(outline).bounds
    size = (x1 - x0, y1 - y0)
    beds = ((config.bed_width, config.bed_depth), (config.bed_depth, config.bed_width))
    if not any(size[0] <= bed[0] and size[1] <= bed[1] for bed in beds):
        raise JigError(
            f"the plate of {size[0]:.0f} x {size[1]:.0f} mm is larger than the bed of"
            f" {config.bed_width:.0f} x {config.bed_depth:.0f} mm",
            name,
            "make the piece smaller, or set jig.bed_width and jig.bed_depth to those of your printer",
        )
