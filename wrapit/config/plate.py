"""The laser-cut jig."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from wrapit.config.block import Block
from wrapit.config.quantities import Length, PositiveLength

ProfileName = Literal["lightburn", "boxes", "service-red", "snijlab", "plain"]
CurveStyle = Literal["spline", "arc", "polyline"]


class PlateConfig(Block):
    """The laser-cut jig: sheets, kerf, fit, and how its file is written."""

    profile: ProfileName = "lightburn"
    """Layer names and colours that the laser's software or the cutting service expects.

    `plain`: everything on layer 0, lines and arcs only.
    """

    curves: CurveStyle = "spline"
    """How curves are written: exactly, or as arcs or short lines within `tolerance`."""

    tolerance: PositiveLength = 0.01
    """Largest distance of arcs or short lines from the exact curve."""

    kerf: Length = 0.15
    """Full width that the laser removes: about 0.15 mm in acrylic, 0.20 mm in plywood, 0.18 mm in MDF.

    `wrapit coupon` writes a test piece to measure yours.
    """

    fit: Length = 0.05
    """Gap on each side between a wall piece and the pocket that it is glued into."""

    sheet: PositiveLength = 3.0
    """Thickness of the sheet of the bottom plate and of the plate with the pockets."""

    wall_sheet: PositiveLength = 6.0
    """Thickness of the sheet of the wall pieces; the pocket swallows `sheet` of it."""

    sheet_width: PositiveLength = 300.0
    """Width of the sheets that the laser takes."""

    sheet_height: PositiveLength = 200.0
    """Height of the sheets that the laser takes."""

    spacing: PositiveLength = 3.0
    """Distance between parts on the sheet, and from its edge."""

    pin: PositiveLength = 2.0
    """Diameter of the pins (cocktail sticks, nails) that keep the two plates flush while they are glued."""

    min_wall_width: PositiveLength = 2.0
    """Thinner wall pieces break or burn and are left out."""

    min_wall_area: float = Field(default=6.0, ge=0)
    """Smaller wall pieces (mm²) can't be handled and are left out."""

    reference_bar: bool = False
    """Engrave a bar of 100 mm on each sheet, to check the scale of the cut."""
