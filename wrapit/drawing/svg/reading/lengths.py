"""Lengths with units, in user units; SVG 2 (8.9) and CSS Values 4 (6).

A unit that depends on a font takes the usual proportions of one, as no font is loaded.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

# A number of SVG and CSS; each branch takes time in proportion to its length, also where it doesn't fit.
NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_LENGTH = re.compile(rf"({NUMBER})(%|[A-Za-z]*)")
_SEVERAL = re.compile(rf"\s*,?\s*({NUMBER})(%|[A-Za-z]*)")

# CSS Values 4: 96 px to the inch, 16 px to the usual font.
_PX = {
    "": 1.0,
    "px": 1.0,
    "in": 96.0,
    "pt": 4 / 3,
    "pc": 16.0,
    "cm": 96 / 2.54,
    "mm": 96 / 25.4,
    "q": 24 / 25.4,
}
FONT_PX = 16.0
# CSS Values 4 where a font doesn't tell: half an em for x and for 0. A line of text is 1.2 em in browsers.
_EX, _LINE = 0.5, 1.2
# Which length of the viewport a percentage is of.
Side = Literal["width", "height", "both"]


@dataclass(frozen=True)
class Measure:
    """What lengths are relative to: font sizes in user units, the nearest viewport and the page's."""

    font: float = FONT_PX
    root_font: float = FONT_PX
    width: float = 0.0
    height: float = 0.0
    page: tuple[float, float] = (0.0, 0.0)

    def of(self, side: Side) -> float:
        """What a percentage is of; of both sides it is the diagonal over the square root of two."""
        if side == "both":
            return math.hypot(self.width, self.height) / math.sqrt(2)
        return self.width if side == "width" else self.height

    def user_units(self, amount: float, unit: str, side: Side) -> float | None:
        """A length in user units; None if the unit is none."""
        unit = unit.lower()
        if unit in _PX:
            return amount * _PX[unit]
        page = self.page
        relative = {
            "%": self.of(side) / 100,
            "em": self.font,
            "rem": self.root_font,
            "ex": _EX * self.font,
            "ch": _EX * self.font,
            "lh": _LINE * self.font,
            "rlh": _LINE * self.root_font,
            "vw": page[0] / 100,
            "vh": page[1] / 100,
            "vmin": min(page) / 100,
            "vmax": max(page) / 100,
        }.get(unit)
        return None if relative is None else amount * relative


def length(text: str | None, measure: Measure, side: Side) -> float | None:
    """A length in user units; None where the text is none, as for `auto`."""
    found = _LENGTH.fullmatch(text.strip()) if text else None
    return measure.user_units(float(found[1]), found[2], side) if found else None


def absolute_px(text: str | None) -> float | None:
    """A length in px that depends on nothing, or None: percentages and `em` are no size of a page."""
    found = _LENGTH.fullmatch(text.strip()) if text else None
    factor = _PX.get(found[2].lower()) if found else None
    return float(found[1]) * factor if found and factor else None


def is_length(text: str) -> bool:
    """Whether a text is a length of any unit."""
    return length(text, Measure(), "both") is not None


def number(text: str | None) -> float | None:
    """A number or a percentage as a share; None where it is neither."""
    found = _LENGTH.fullmatch(text.strip()) if text else None
    if found is None or found[2] not in ("", "%"):
        return None
    return float(found[1]) / (100 if found[2] else 1)


def numbers(text: str) -> list[tuple[float, str]] | None:
    """All numbers of a list with their units; None where something else is in it."""
    found, at = [], 0
    while match := _SEVERAL.match(text, at):
        found.append((float(match[1]), match[2]))
        at = match.end()
    return found if not text[at:].strip() else None


def lengths_of(declared: dict[str, str], measure: Measure) -> Callable[[str, Side], float | None]:
    """Gives lengths of properties by their names."""
    return lambda name, side: length(declared.get(name), measure, side)
