"""What of an SVG file's lines is not read, or not as it is drawn: what, where and how much."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from wrapit.drawing.spots import Spot
from wrapit.geometry import FloatArray

# clipped: outside of the page, a viewport or a clip path. hidden: under later ink. erasing: strokes in the
# colour of what they lie on. dots: no length to speak of. dashed: read as whole lines. undrawn: no dash
# falls on it, or one that is shorter. masked: read as if there were no mask.
What = Literal["clipped", "hidden", "erasing", "dots", "dashed", "undrawn", "masked"]


@dataclass(frozen=True, eq=False)
class Loss:
    """One stretch: its middle (2,) and length in px, the line of its element, and a name to know it by."""

    what: What
    at: FloatArray
    length_px: float
    line: int
    name: str = ""
    width_px: float = 0.0
    """Of the ink, for dots."""


def dots_of(losses: Iterable[Loss]) -> list[Spot]:
    """The dots among what is lost."""
    return [
        Spot((float(loss.at[0]), float(loss.at[1])), loss.width_px) for loss in losses if loss.what == "dots"
    ]
