"""The printed jig: turns, walls, plate and holes."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import Field

from wrapit.config.block import Block
from wrapit.config.quantities import Angle, Curvature, Length, PositiveLength


class JigConfig(Block):
    """The printed jig (paper, section 5)."""

    kind: Literal["printed"] = "printed"

    turn_curvature: Curvature = 0.08
    """A wire needs a wall where it bends more sharply than this (0.08 /mm is a radius of 12.5 mm)."""

    turn_angle: Angle = math.radians(25)
    """Turns that bend the wire by less in total get no wall."""

    long_segment: PositiveLength = 20.0
    """Straighter stretches longer than this get a wall too."""

    wall_thickness: PositiveLength = 3.5
    clearance: Length = 0.2
    """Gap between wire and wall on each side."""

    min_wall_width: PositiveLength = 0.8
    """Thinner walls can't be printed and are dropped."""

    min_wall_area: float = Field(default=2.0, ge=0)
    """Smaller walls (mm²) can't be printed and are dropped."""

    base_thickness: PositiveLength = 3.0
    margin: Length = 5.0
    """Plate around the walls and wires."""

    corner_radius: Length = 3.0
    min_hole: PositiveLength = 2.0
    """Smallest start hole; thicker wires get their diameter + 0.5 mm."""

    tail_slot: Length = 1.5
    """Start holes are this much longer in the direction of the wire's tail, so that it can be bent down."""

    stl_tolerance: PositiveLength = 0.005
    """Largest distance of the STL's facets from the true surface."""
