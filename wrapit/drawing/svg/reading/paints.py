"""Paints of `fill` and `stroke`: colours, gradients and patterns of the file, or nothing (SVG 2, 13.2)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

Colour = tuple[float, float, float, float]

# What stands behind a paint: `url(#name)` with what is painted if there is none of that name.
_SERVER = re.compile(r"url\(\s*(?:\"([^\"]*)\"|'([^']*)'|([^\s\"')]*))\s*\)(.*)", re.DOTALL)
# Spaces whose first coordinate is lightness, and what white has there (CSS Color 4).
_LIGHTNESS = {"lab": 100.0, "lch": 100.0, "oklab": 1.0, "oklch": 1.0}
# As many paints are remembered; a drawing has a few.
_REMEMBERED = 1_000


@dataclass(frozen=True)
class PaintValue:
    """What a property says: a colour (red, green, blue, alpha from 0 to 1), or where the paint comes from."""

    kind: Literal["none", "colour", "current", "server", "context-fill", "context-stroke"]
    colour: Colour | None = None
    server: str = ""
    fallback: PaintValue | None = None


# What `fill` and `stroke` are at first, by the specification: black and nothing.
NOTHING = PaintValue("none")
BLACK = PaintValue("colour", (0.0, 0.0, 0.0, 1.0))

# Values that are one word (SVG 2, 13.2).
_WORDS = {
    "none": NOTHING,
    "currentcolor": PaintValue("current"),
    "context-fill": PaintValue("context-fill"),
    "context-stroke": PaintValue("context-stroke"),
}


@lru_cache(_REMEMBERED)
def colour(text: str) -> Colour | None:
    """A colour of CSS Color 4 as red, green, blue and alpha; None where it is none, or `currentcolor`."""
    from tinycss2.color4 import parse_color

    found = parse_color(text)
    if found is None or isinstance(found, str):
        return None
    if found.space in ("hsl", "hwb"):
        found = found.to("srgb")
    red, green, blue, alpha = found
    if found.space in _LIGHTNESS:
        # Only what is nearly white is told from other colours, and for that the lightness is enough.
        red = green = blue = (red or 0) / _LIGHTNESS[found.space]
    return (float(red or 0), float(green or 0), float(blue or 0), float(1 if alpha is None else alpha))


@lru_cache(_REMEMBERED)
def paint_value(text: str) -> PaintValue | None:
    """What `fill` or `stroke` says; None where it is not in order."""
    text = text.strip()
    word = text.lower()
    if word in _WORDS:
        return _WORDS[word]
    if word.startswith("url("):
        found = _SERVER.fullmatch(text)
        if not found:
            return None
        server = found[1] or found[2] or found[3] or ""
        return PaintValue(
            "server", server=server, fallback=paint_value(found[4]) if found[4].strip() else None
        )
    # A colour for print may follow the colour for screens.
    known = colour(text) or (colour(text.partition("icc-color")[0].strip()) if "icc-color" in text else None)
    return PaintValue("colour", known) if known else None


def background(declared: dict[str, str]) -> Colour | None:
    """The colour that CSS puts behind a page; None where there is none to see."""
    for name in ("background-color", "background"):
        for word in (declared.get(name, ""), *declared.get(name, "").split()):
            known = colour(word.strip())
            if known and known[3] > 0:
                return known
    return None
