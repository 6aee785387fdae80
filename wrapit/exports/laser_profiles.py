"""Layer names and colours that lasers' programs and cutting services expect."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from wrapit.config.plate import ProfileName
from wrapit.jig.contours import Layer

# The order in which a laser has to work: nothing is engraved or cut on a piece that already fell out.
ORDER: Final[tuple[Layer, ...]] = ("ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER")


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


# The pure colours, which AutoCAD numbers 1 (red), 3 (green), 4 (cyan), 5 (blue) and 7 (black on white).
BLACK, RED, GREEN, BLUE, CYAN = (0, 0, 0), (255, 0, 0), (0, 255, 0), (0, 0, 255), (0, 255, 255)
# As the programs and services document their own; `boxes` is what Boxes.py writes.
PROFILES: Final[dict[ProfileName, dict[Layer, Look]]] = {
    "lightburn": {
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 5, BLUE),
        "CUT_INNER": Look("CUT_INNER", 3, (0, 0xE0, 0)),
        "CUT_OUTER": Look("CUT_OUTER", 1, RED),
    },
    # Red is never cut there, so it isn't used.
    "boxes": {
        "ENGRAVE": Look("ENGRAVE", 3, GREEN),
        "SCORE": Look("SCORE", 4, CYAN),
        "CUT_INNER": Look("CUT_INNER", 5, BLUE),
        "CUT_OUTER": Look("CUT_OUTER", 7, BLACK),
    },
    "service-red": {
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 5, BLUE),
        "CUT_INNER": Look("CUT_INNER", 1, RED),
        "CUT_OUTER": Look("CUT_OUTER", 1, RED),
    },
    "snijlab": {
        "ENGRAVE": Look("ENGRAVE", 7, BLACK),
        "SCORE": Look("SCORE", 1, RED),
        "CUT_INNER": Look("CUT_INNER", 5, BLUE),
        "CUT_OUTER": Look("CUT_OUTER", 5, BLUE),
    },
    "plain": {layer: Look("0", 7, BLACK) for layer in ORDER},
}
