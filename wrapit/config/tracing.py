"""How a drawing is read."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import Field

from wrapit.config.block import Block
from wrapit.config.quantities import Angle, Length


class TracingConfig(Block):
    """How lines are found in a bitmap; JSON and SVG drawings are taken as they are drawn."""

    corner_angle: Angle = math.radians(60)
    """A turn sharper than this becomes a corner (a junction of two segments)."""

    shortest_segment: Length = 0.8
    """Segments of the real piece that are shorter can't be bent by hand: they are merged or dropped."""

    tolerance: float = Field(default=0.04, gt=0, le=0.5)
    """Largest distance of the fitted curves from the centre of the ink, in stroke widths."""

    components: Literal["largest", "join"] = "largest"
    """A drawing in several pieces: keep the largest, or join near ones by the shortest extra segment."""

    filled: Literal["refuse", "outline"] = "refuse"
    """Filled shapes: refuse them (they are no lines), or trace their outlines as lines."""

    pixel_limit: int = Field(default=120_000_000, gt=0)
    """Larger images are refused before they are decoded."""
