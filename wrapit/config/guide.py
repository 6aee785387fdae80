"""The `guide` block: binding wire, spare wire, language and units."""

from __future__ import annotations

from typing import Annotated, Literal

from wrapit.config.block import Block
from wrapit.config.quantities import length, whole, wire_gauge
from wrapit.units import awg_diameter_mm

Language = Literal["en", "de"]
LengthUnit = Literal["mm", "in"]
Paper = Literal["A4", "letter"]


class GuideConfig(Block):
    """The step-by-step guide."""

    binding_gauge: Annotated[float, wire_gauge("0.05 mm", "3 mm", "28 AWG")] = awg_diameter_mm(28)
    """Thin wire that ties the wires together."""

    binding_turns: Annotated[int, whole(1, 50)] = 5
    """Turns of binding wire at each connection."""

    margin: Annotated[float, length("0 mm", "1 m", "50 mm")] = 50.0
    """Extra wire to hold and bend, both ends of a wire together (at least 15 % of its length)."""

    language: Language = "en"
    """English or German."""

    units: LengthUnit = "mm"
    """Lengths in millimetres, or in inches to the sixteenth."""

    paper: Paper = "A4"
    """Sheets that `guide.pdf` is printed on: `A4` or US `letter`."""
