"""Viewports: how a `viewBox` fits into its place, and how large the page is (SVG 2, chapter 8)."""

from __future__ import annotations

from wrapit.drawing.svg.reading.lengths import absolute_px, numbers
from wrapit.drawing.svg.reading.matrices import Matrix

Box = tuple[float, float, float, float]

# What browsers take for a page that says nothing of its size (CSS 2.1, 10.3.2).
_USUAL_PX = (300.0, 150.0)
_SHARES = {"min": 0.0, "mid": 0.5, "max": 1.0}


def view_box(text: str | None) -> Box | None:
    """x, y, width and height; None where it is missing or not in order."""
    found = numbers(text) if text else None
    if not found or len(found) != 4 or any(unit for _, unit in found) or found[2][0] < 0 or found[3][0] < 0:
        return None
    return (found[0][0], found[1][0], found[2][0], found[3][0])


def fitted(box: Box, width: float, height: float, ratio: str | None) -> Matrix | None:
    """The matrix from a `viewBox` to a place, by `preserveAspectRatio`; None where either is empty."""
    x, y, across, down = box
    if not (across > 0 and down > 0 and width > 0 and height > 0):
        return None
    words = [word for word in (ratio or "").split() if word != "defer"]
    align = words[0] if words else "xMidYMid"
    sx, sy = width / across, height / down
    if align == "none":
        return (sx, 0.0, 0.0, sy, -x * sx, -y * sy)
    shares = (_SHARES.get(align[1:4].lower()), _SHARES.get(align[5:8].lower()))
    if len(align) != 8 or align[0] != "x" or align[4] != "Y" or None in shares:
        shares, words = (0.5, 0.5), []
    scale = max(sx, sy) if words[1:] == ["slice"] else min(sx, sy)
    left = (width - across * scale) * (shares[0] or 0.0)
    top = (height - down * scale) * (shares[1] or 0.0)
    return (scale, 0.0, 0.0, scale, left - x * scale, top - y * scale)


def page_size(width: str | None, height: str | None, box: Box | None) -> tuple[float, float]:
    """Width and height of the page in px; what is missing, `auto`, or relative comes from the `viewBox`."""
    wide, high = (size if size and size > 0 else None for size in (absolute_px(width), absolute_px(height)))
    if box is not None and box[2] > 0 and box[3] > 0:
        if wide is None and high is None:
            return box[2], box[3]
        if wide is None and high is not None:
            return high * box[2] / box[3], high
        if high is None and wide is not None:
            return wide, wide * box[3] / box[2]
    return wide or _USUAL_PX[0], high or _USUAL_PX[1]
