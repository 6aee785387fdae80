"""What two runs of a config's wire side by side need."""

from __future__ import annotations

from wrapit.config import Config
from wrapit.decomposition.second_runs import SideBySide
from wrapit.fit.limits import corner_radius_mm
from wrapit.wires.beside.stage import APART

# A line so many diameters long has room for two runs that meet and part at its ends.
_SHORTEST = 4.0


def room_of(config: Config) -> SideBySide:
    """For the decomposition, which knows nothing of wire."""
    diameter_mm = config.wire.gauge
    return SideBySide(APART * diameter_mm, corner_radius_mm(config), _SHORTEST * diameter_mm)
