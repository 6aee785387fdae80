"""The outline that bottom plate and pocket plate share, with pin holes to lay them on one another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.config import JigConfig, PlateConfig
from wrapit.geometry import Loop, Region
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import rounded_rectangle
from wrapit.jig.model import Hole
from wrapit.wires.model import Wire

# Sheet around a pin hole: as wide as the sheet is thick, within these bounds; nothing but the margin hangs on
# them.
_LEAST_WEB_MM, _MOST_WEB_MM = 1.5, 3.0


@dataclass(frozen=True)
class Frame:
    """A rectangle with round corners; `pins` are the centres of the pin holes."""

    left: float
    bottom: float
    right: float
    top: float
    radius_mm: float
    pins: tuple[tuple[float, float], ...]

    def outline(self, grown_mm: float = 0.0) -> Loop:
        """The outline, moved outward, counter-clockwise."""
        return rounded_rectangle(
            self.left - grown_mm,
            self.bottom - grown_mm,
            self.right + grown_mm,
            self.top + grown_mm,
            self.radius_mm + grown_mm if self.radius_mm > 0 else 0.0,
        )

    @property
    def label_place(self) -> tuple[float, float]:
        """Centre of the free strip along the lower edge."""
        return (self.left + self.right) / 2, self.pins[0][1]


def frame_around(
    wires: Sequence[Wire],
    walls: Sequence[Region],
    holes: Sequence[Hole],
    jig_config: JigConfig,
    config: PlateConfig,
) -> Frame:
    """The frame around wires, walls and start holes; its margin has room for the pins.

    Three corners have pins, so that the plates fit upon one another in one way only.
    """
    clouds = [chain_of(wire.centreline).sampled(0.2) for wire in wires]
    clouds += [wall.outer.sampled(0.05) for wall in walls]
    clouds += [hole.outline.sampled(0.05) for hole in holes]
    points = np.vstack(clouds)
    low, high = points.min(axis=0), points.max(axis=0)
    web_mm = min(max(config.sheet, _LEAST_WEB_MM), _MOST_WEB_MM)
    margin_mm = max(jig_config.margin, config.pin + 2 * web_mm)
    left, bottom = float(low[0]) - margin_mm, float(low[1]) - margin_mm
    right, top = float(high[0]) + margin_mm, float(high[1]) + margin_mm
    inset = web_mm + config.pin / 2
    pins = ((left + inset, bottom + inset), (right - inset, bottom + inset), (left + inset, top - inset))
    return Frame(left, bottom, right, top, jig_config.corner_radius, pins)
