"""The laser-cut jig."""

from __future__ import annotations

from typing import Annotated, Literal

from wrapit.config.block import Block
from wrapit.config.quantities import length, number

ProfileName = Literal["lightburn", "boxes", "service-red", "snijlab", "plain"]
CurveStyle = Literal["spline", "arc", "polyline"]
ShopName = Literal["none", "sendcutsend", "ponoko", "lasercut.parts"]


class PlateConfig(Block):
    """The laser-cut jig: sheets, kerf, fit, and how its file is written."""

    profile: ProfileName = "lightburn"
    """Layer names and colours that the laser's software or the cutting service expects.

    `plain`: cuts on layer 0, engraving on a layer ENGRAVE; lines and arcs only.
    """

    shop: ShopName = "none"
    """A cutting service whose published rules the sheets are held against; each breach is a finding."""

    curves: CurveStyle = "spline"
    """How curves are written: exactly, or as arcs or short lines within `tolerance`."""

    tolerance: Annotated[float, length("0.0001 mm", "1 mm", "0.01 mm")] = 0.01
    """Largest distance of arcs or short lines from the exact curve."""

    kerf: Annotated[float, length("0 mm", "5 mm", "0.15 mm")] = 0.15
    """Full width that the laser removes: about 0.15 mm in acrylic, 0.20 mm in plywood, 0.18 mm in MDF.

    `wrapit coupon` writes a test piece to measure yours.
    """

    fit: Annotated[float, length("0 mm", "2 mm", "0.05 mm")] = 0.05
    """Gap on each side between a wall piece and the pocket that it is glued into."""

    sheet: Annotated[float, length("0.2 mm", "50 mm", "3 mm")] = 3.0
    """Thickness of the sheet of the bottom plate and of the plate with the pockets."""

    wall_sheet: Annotated[float, length("0.2 mm", "50 mm", "6 mm")] = 6.0
    """Thickness of the sheet of the wall pieces; the pocket swallows `sheet` of it."""

    sheet_width: Annotated[float, length("20 mm", "5 m", "300 mm")] = 300.0
    """Width of the sheets that the laser takes."""

    sheet_height: Annotated[float, length("20 mm", "5 m", "200 mm")] = 200.0
    """Height of the sheets that the laser takes."""

    spacing: Annotated[float, length("0.1 mm", "100 mm", "3 mm")] = 3.0
    """Distance between parts on the sheet, and from its edge."""

    pin: Annotated[float, length("0.2 mm", "20 mm", "2 mm")] = 2.0
    """Diameter of the pins (cocktail sticks, nails) that keep the two plates flush while they are glued."""

    min_wall_width: Annotated[float, length("0.05 mm", "50 mm", "2 mm")] = 2.0
    """Thinner wall pieces break or burn and are left out."""

    min_wall_area: Annotated[float, number(0, 1_000)] = 6.0
    """Smaller wall pieces (mm²) can't be handled and are left out."""

    handle: Annotated[float, length("0 mm", "100 mm", "8 mm")] = 8.0
    """Walls are joined to few pieces, and shorter ones grow at their backs until they are as long: for the
    fingers, where there is room.

    0 mm leaves all walls as small as the wire needs them.
    """

    reference_bar: bool = False
    """Engrave a bar of 100 mm on each sheet, to check the scale of the cut."""
