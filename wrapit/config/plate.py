"""The laser-cut jig."""

from __future__ import annotations

from typing import Literal

from wrapit.config.block import Block
from wrapit.config.quantities import Length, PositiveLength


class PlateConfig(Block):
    """The laser-cut jig: sheets, kerf and layer colours."""

    profile: Literal["lightburn"] = "lightburn"
    """Layer names and colours that the laser's software expects."""

    kerf: Length = 0.15
    """Full width that the laser removes."""

    sheet: PositiveLength = 3.0
    """Thickness of the sheet."""
