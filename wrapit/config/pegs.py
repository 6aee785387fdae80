"""The board with pegs."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from wrapit.config.block import Block
from wrapit.config.quantities import length

Diameter = Annotated[float, length("0.5 mm", "50 mm", "3 mm")]


class PegsConfig(Block):
    """A board with holes in rows and columns, for round pegs (paper, section 5, first attempt).

    As sold for bending wire by hand: wire is bent round pegs that stand on the inside of its turns.
    """

    pitch: Annotated[float, length("1 mm", "50 mm", "5 mm")] = 5.0
    """Distance of neighbouring holes, in both directions."""

    diameters: tuple[Diameter, ...] = Field(
        default=(1.6, 3.0, 4.5, 6.0, 8.0, 10.0, 13.0, 16.0), min_length=1, max_length=40
    )
    """Diameters of the pegs that there are, as many of each as needed."""

    reach: Annotated[float, length("0.05 mm", "10 mm", "0.6 mm")] = 0.6
    """A peg serves a turn when the wire, bent round it, comes within this of the drawing."""

    margin: Annotated[float, length("0 mm", "200 mm", "10 mm")] = 10.0
    """Board around the wires."""
