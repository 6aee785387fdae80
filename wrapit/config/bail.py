"""What the finished piece hangs from."""

from __future__ import annotations

from typing import Annotated

from wrapit.config.block import Block
from wrapit.config.quantities import Place, length


class BailConfig(Block):
    """A bail: a round loop that a wire's end is bent into, so that the piece can hang from a chain.

    A wire that ends at the place goes on into the loop: a neck, and a round eye outside the piece, which
    closes against the neck. Where no wire ends within the loop's diameter, or has no room for it, the guide
    lists a jump ring instead and shows where it goes.
    """

    at: Place = "top"
    """Where: `top` (above the centre of gravity, so that the piece hangs as it is drawn), a point such as
    `[12 mm, 30 mm]` (as in `drawing.json`, y up), or the number of a junction (as in `drawing.svg`).
    """

    diameter: Annotated[float, length("0.5 mm", "100 mm", "5 mm")] = 5.0
    """Inside of the loop."""
