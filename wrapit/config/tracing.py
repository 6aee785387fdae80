"""How a drawing is read."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from wrapit.config.block import Block
from wrapit.config.quantities import angle, length, number, whole

Components = Literal["auto", "largest", "join", "weigh"]
"""What becomes of a drawing in several pieces."""


class TracingConfig(Block):
    """How lines are found in a bitmap; JSON and SVG drawings are taken as they are drawn."""

    corner_angle: Annotated[float, angle("1 deg", "180 deg", "60 deg")] = math.radians(60)
    """A turn sharper than this becomes a corner (a junction of two segments)."""

    shortest_segment: Annotated[float, length("0 mm", "100 mm", "0.8 mm")] = 0.8
    """Segments of the real piece that are shorter can't be bent by hand: they are merged or dropped."""

    tolerance: Annotated[float, number(0.001, 0.5)] = 0.04
    """Largest distance of the fitted curves from the centre of the ink, in stroke widths."""

    components: Components = "auto"
    """A drawing in several pieces: keep the `largest`; `join` near ones by the shortest extra segment;
    `weigh` them, which joins those within the largest that are twice as long as their link. `auto` weighs
    with `fit`, and else keeps the largest."""

    filled: Literal["refuse", "outline"] = "refuse"
    """Filled shapes: refuse them (they are no lines), or trace their outlines as lines."""

    pixel_limit: Annotated[int, whole(1_000, 1_000_000_000)] = 120_000_000
    """Larger images are refused before they are decoded."""
