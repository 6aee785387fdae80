"""What a drawing was before it was made fit: grey lines and numbers beneath it, and a list of changes."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Sequence

import numpy as np

from wrapit.drawing.model import Removal, Segment
from wrapit.exports.svgpage import CROWDED_RINGS, anchors, attributes, label_texts, text
from wrapit.fit.model import Fitted
from wrapit.geometry import FloatArray
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame

# Lines recede behind the ink; numbers are to be read, so they are darker.
LINE, NUMBER = "#d0d0d0", "#6e6e6e"
# More lines of the list aren't read: the report counts what they tell, `drawing.json` has them all.
MOST_LINES = 30
# Width of a letter as a share of the text height, as wide as it gets in the fonts that pages name.
_LETTER = 0.56
# Places nearer than files write them are the same.
_SAME_MM = 1e-6


def changes(fitted: Fitted) -> tuple[Removal, ...]:
    """What was changed to make a drawing fit, after what reading it changed."""
    return fitted.drawing.removed[len(fitted.original.removed) :]


def renumbered(fitted: Fitted) -> tuple[Segment, ...]:
    """Segments of the original that were left out or changed, or have another number now."""
    now = fitted.drawing.segments
    return tuple(
        segment
        for segment in fitted.original.segments
        if segment.id >= len(now) or not _is_same(segment, now[segment.id])
    )


def original_lines(fitted: Fitted, frame: SvgFrame) -> list[str]:
    """The original's segments in light grey."""
    width = fitted.original.stroke_width_mm or 0.5
    style = attributes(fill="none", stroke=LINE, stroke_linecap="round", stroke_width=width)
    return [
        f"<path {attributes(id=f'original-{segment.id}', d=frame.path(segment.curve))} {style}>"
        f"<title>segment {segment.id} as it was read</title></path>"
        for segment in fitted.original.segments
    ]


def original_numbers(
    segments: Sequence[Segment], ink: FloatArray, size_mm: float, taken: Sequence[Label], *, crowded: bool
) -> tuple[Label, ...]:
    """Labels of these segments, clear of those that are placed."""
    wanted = [(str(segment.id), anchors(segment.curve, quickly=crowded)) for segment in segments]
    return place_labels(wanted, ink, size_mm, taken, CROWDED_RINGS if crowded else None)


def grey_texts(frame: SvgFrame, labels: Sequence[Label], size_mm: float) -> list[str]:
    """The numbers of the original's segments."""
    return ['<g class="original">', *label_texts(frame, labels, size_mm, NUMBER), "</g>"] if labels else []


def counted(told: Sequence[Removal]) -> str:
    """How many of each kind.

    >>> counted([Removal("spur", (0, 0), 1.0), Removal("gap", (0, 0), 1.0), Removal("spur", (1, 0), 1.0)])
    '1 × gap, 2 × spur'
    """
    kinds = Counter(removal.what for removal in told)
    return ", ".join(f"{count} × {what}" for what, count in sorted(kinds.items()))


def told(removal: Removal) -> str:
    """One change in words.

    >>> told(Removal("dropped", (1.0, 2.5), 3.21, "saves a wire"))
    'dropped, 3.21 mm: saves a wire'
    """
    return f"{removal.what}, {removal.length_mm:.2f} mm" + (f": {removal.reason}" if removal.reason else "")


def listed(removals: Sequence[Removal], width_mm: float, size_mm: float) -> list[str]:
    """The changes with their places, one after the other, in lines of at most this width."""
    lines: list[str] = []
    for index, removal in enumerate(removals):
        x, y = removal.at
        said = f"at ({x:.1f}, {y:.1f}): {told(removal)}"
        wrapped = broken(said, width_mm, size_mm)
        if len(lines) + len(wrapped) > MOST_LINES:
            return [*lines, f"and {len(removals) - index} more"]
        lines += wrapped
    return lines


def broken(said: str, width_mm: float, size_mm: float) -> list[str]:
    """A sentence in lines of at most this width."""
    return textwrap.wrap(said, max(12, int(width_mm / (_LETTER * size_mm))), subsequent_indent="  ")


def small_print(
    frame: SvgFrame, lines: Sequence[str], top_mm: float, size_mm: float, colour: str
) -> list[str]:
    """Lines of text below one another from a height (the page's frame, y up) on."""
    left = frame.left + size_mm
    return [
        text(
            frame,
            (left, top_mm - 1.4 * size_mm * (index + 0.7)),
            line,
            size_mm,
            fill=colour,
            style="text-anchor:start",
        )
        for index, line in enumerate(lines)
    ]


def _is_same(before: Segment, now: Segment) -> bool:
    """Whether it is the same line; it may run the other way."""
    one, other = before.curve.points, now.curve.points
    return one.shape == other.shape and (
        np.allclose(one, other, rtol=0, atol=_SAME_MM)
        or np.allclose(one, other[::-1, ::-1], rtol=0, atol=_SAME_MM)
    )
