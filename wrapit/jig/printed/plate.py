"""The base plate's outline and its screw holes."""

from __future__ import annotations

from typing import Any

from wrapit.config import JigConfig
from wrapit.errors import JigError
from wrapit.geometry import Loop
from wrapit.geometry.outlines.loops import circle, rounded_rectangle

# Plate around a screw hole: three lines of a nozzle of 0.4 mm, under the head of the screw.
RIM_MM = 1.2


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
        circle((x, y), config.screw_hole / 2)
        for x in (low[0] + inset, high[0] - inset)
        for y in (low[1] + inset, high[1] - inset)
        if config.screw_hole
    ]
    # The rounding leaves the screw holes their rim.
    radius = min(config.corner_radius, inset) if screws else config.corner_radius
    return rounded_rectangle(*low, *high, radius), tuple(screws)
