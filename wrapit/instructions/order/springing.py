"""How far to bend beyond a wire's shape, because the metal springs back when it is let go."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

from wrapit.config import WireConfig
from wrapit.materials import METALS
from wrapit.pages.model import Length, Text, text
from wrapit.wires.model import Wire

# Tighter bends spring back by less than a hand can tell: dead-soft copper of 1 mm by 0.8° at this radius.
LEAST_SPRINGY_RADIUS_MM: Final = 5.0
# Wider ones are hardly bends: the angle would be that of no right angle in the piece.
MOST_SPRINGY_RADIUS_MM: Final = 50.0


def springs_back(wire: Wire, config: WireConfig) -> Iterator[Text]:
    """By how much at a right angle of the wire's tightest turn; nothing where a hand can't tell."""
    curvature = max((turn.max_curvature_per_mm for turn in wire.turns), default=0.0)
    if curvature <= 0:
        return
    loss = METALS[config.metal].springback_per_mm(wire.diameter_mm, config.temper)
    radius_mm = min(max(1 / curvature, LEAST_SPRINGY_RADIUS_MM), MOST_SPRINGY_RADIUS_MM)
    degrees = round(math.degrees(math.pi / 2 * loss * radius_mm))
    if degrees >= 1:
        yield text("spring-further", radius=Length(round(radius_mm)), angle=degrees)
