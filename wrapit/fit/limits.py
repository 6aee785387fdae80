"""What a config's wire, metal and jig ask of the lines of a drawing."""

from __future__ import annotations

from typing import Final

from wrapit.config import Config
from wrapit.fit.model import Level, Limits
from wrapit.materials import METALS, min_inner_bend_radius_mm

# Room inside a face, in wire diameters: at one, wires beside it touch; at two, one more fits between.
_ROOM: Final[dict[Level, float]] = {"gentle": 1.0, "bold": 2.0}
# Shorter segments can't be held and bent: 3 mm between pliers, 5 mm between fingers.
_SHORTEST_MM: Final[dict[Level, float]] = {"gentle": 3.0, "bold": 5.0}


def limits_of(config: Config, level: Level) -> Limits:
    """The limits of a config's wire at a level."""
    diameter_mm, room_mm = config.wire.gauge, _ROOM[level] * config.wire.gauge
    ring_mm = max(room_mm, 2 * _post_bend_mm(config))
    return Limits(diameter_mm, corner_radius_mm(config), room_mm, ring_mm, _SHORTEST_MM[level])


def least_radius_mm(config: Config) -> float:
    """Radius of the tightest bend of a centreline that the metal takes without damage."""
    return min_inner_bend_radius_mm(config.wire.gauge, config.wire.temper) + config.wire.gauge / 2


def corner_radius_mm(config: Config) -> float:
    """Radius that corners are rounded to: also a post of the jig fits inside, where that counts.

    With springback made up for it is what the tightest bend becomes when it is let go.
    """
    radius_mm = least_radius_mm(config)
    if config.jig.post_bends:
        radius_mm = max(radius_mm, _post_bend_mm(config))
    if config.jig.springback == "report":
        return radius_mm
    wire = config.wire
    return 1 / (1 / radius_mm - METALS[wire.metal].springback_per_mm(wire.gauge, wire.temper))


def _post_bend_mm(config: Config) -> float:
    """Radius of the tightest bend with room for the narrowest printable post on its inside."""
    return config.wire.gauge / 2 + config.jig.clearance + config.jig.min_wall_width / 2
