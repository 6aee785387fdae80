"""One colour per wire: far apart, readable on white, and told apart by colour-blind eyes in pairs."""

from __future__ import annotations

import colorsys

# Hues far apart, each dark enough for white paper.
_FIRST = (
    "#c1440e", "#1f6fb2", "#2e8540", "#8a3ffc", "#b8860b", "#0f8b8d", "#c2185b", "#5d4037",
    "#3949ab", "#6b8e23", "#d2691e", "#7b1fa2",
)  # fmt: skip
# Further hues: steps of the golden ratio never come near one another twice.
_GOLDEN = 0.618034


def wire_colour(index: int) -> str:
    """Colour of the wire at an index, `#rrggbb`; never repeats within a piece."""
    if index < len(_FIRST):
        return _FIRST[index]
    hue, band = (index * _GOLDEN) % 1.0, index % 3
    red, green, blue = colorsys.hls_to_rgb(hue, 0.32 + 0.07 * band, 0.75)
    return f"#{round(red * 255):02x}{round(green * 255):02x}{round(blue * 255):02x}"
