"""Layer names and colours that lasers' programs and cutting services expect."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from wrapit.config.plate import ProfileName
from wrapit.jig.contours import Layer

# The order in which a laser has to work: nothing is engraved or cut on a piece that already fell out. What is
# only to be read comes first, under all the rest.
ORDER: Final[tuple[Layer, ...]] = ("NOTE", "ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER")


@dataclass(frozen=True)
class Look:
    """A layer as the file shows it: its name, its AutoCAD colour index and its true colour."""

    name: str
    aci: int
    rgb: tuple[int, int, int]

    @property
    def css(self) -> str:
        """The colour as `#rrggbb`."""
        return "#{:02x}{:02x}{:02x}".format(*self.rgb)


# The pure colours, which AutoCAD numbers 1 (red), 3 (green), 4 (cyan), 5 (blue), 7 (black on white); 8 is
# grey.
BLACK, RED, GREEN, BLUE, CYAN = (0, 0, 0), (255, 0, 0), (0, 255, 0), (0, 0, 255), (0, 255, 255)
# No service has work for grey.
GREY_NOTE: Final = Look("NOTE", 8, (128, 128, 128))
# As the programs and services document their own; `boxes` is what Boxes.py writes.
PROFILES: Final[dict[ProfileName, dict[Layer, Look]]] = {
    # Its colour for what is never sent to the laser ("tool layer" T1) is this orange.
    "lightburn": {
        "NOTE": Look("NOTE", 30, (0xF3, 0x69, 0x26)),
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 5, BLUE),
        "CUT_INNER": Look("CUT_INNER", 3, (0, 0xE0, 0)),
        "CUT_OUTER": Look("CUT_OUTER", 1, RED),
    },
    # Red is never cut there: it is for annotations.
    "boxes": {
        "NOTE": Look("NOTE", 1, RED),
        "ENGRAVE": Look("ENGRAVE", 3, GREEN),
        "SCORE": Look("SCORE", 4, CYAN),
        "CUT_INNER": Look("CUT_INNER", 5, BLUE),
        "CUT_OUTER": Look("CUT_OUTER", 7, BLACK),
    },
    "service-red": {
        "NOTE": GREY_NOTE,
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 5, BLUE),
        "CUT_INNER": Look("CUT_INNER", 1, RED),
        "CUT_OUTER": Look("CUT_OUTER", 1, RED),
    },
    "snijlab": {
        "NOTE": GREY_NOTE,
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 1, RED),
        "CUT_INNER": Look("CUT_INNER", 5, BLUE),
        "CUT_OUTER": Look("CUT_OUTER", 5, BLUE),
    },
    # Who cuts all of layer 0 cuts no engraving with it.
    "plain": {
        "NOTE": GREY_NOTE,
        "ENGRAVE": Look("ENGRAVE", 5, BLUE),
        "SCORE": Look("SCORE", 4, CYAN),
        "CUT_INNER": Look("0", 7, BLACK),
        "CUT_OUTER": Look("0", 7, BLACK),
    },
}
