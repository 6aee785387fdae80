"""What the SVG writers share: the page, text, and the places along a curve where a number may stand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.arclength import piece
from wrapit.geometry.label_places import DIGIT_WIDTH, PADDING, Label
from wrapit.geometry.polyline import at_lengths, lengths
from wrapit.geometry.svgframe import SvgFrame, number

# One of these is on every system; their digits are about equally wide, so labels fit in each.
FONT = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
# From here on labels would cover the drawing at their usual size.
MANY_LABELS = 200
# Where there are many labels, those that find no place so near are left out.
CROWDED_RINGS = 6
# Where along a curve its number stands, the best place first.
ANCHOR_SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)


def page(frame: SvgFrame, title: str, description: str, body: Iterable[str]) -> str:
    """A true-size SVG document with title and description for those who can't see it."""
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" {frame.size} viewBox="{frame.view_box}" role="img"'
            ' aria-labelledby="title description">',
            f'<title id="title">{escape(title)}</title>',
            f'<desc id="description">{escape(description)}</desc>',
            f'<rect width="{number(frame.width_mm)}" height="{number(frame.height_mm)}" fill="#ffffff"/>',
            *body,
            "</svg>",
            "",
        ]
    )


def attributes(**values: str | float) -> str:
    """XML attributes; underscores become hyphens."""
    return " ".join(
        f"{key.replace('_', '-')}={quoteattr(value if isinstance(value, str) else number(value))}"
        for key, value in values.items()
    )


def text(frame: SvgFrame, point: Iterable[float], content: str, size_mm: float, **style: str | float) -> str:
    """Centred text with a white halo, so that it stays readable on a line."""
    x, y = frame.at(point)
    halo = attributes(stroke="#ffffff", stroke_width=0.25 * size_mm, paint_order="stroke")
    place = attributes(x=x, y=y + 0.36 * size_mm, font_size=size_mm, text_anchor="middle", **style)
    return f"<text {place} {halo}>{escape(content)}</text>"


def leader(frame: SvgFrame, label: Label, colour: str, size_mm: float) -> str:
    """The thin line from a label that stands apart to what it names."""
    centre, anchor, half = np.array(label.centre), np.array(label.anchor), np.array(label.half_size)
    away = anchor - centre
    share = float(np.min(half / np.maximum(np.abs(away), 1e-9)))
    data = frame.polyline(np.array([centre + min(share, 1.0) * away, anchor]))
    return f"<path {attributes(d=data, stroke=colour, stroke_width=0.06 * size_mm, fill='none')}/>"


def label_texts(frame: SvgFrame, labels: Sequence[Label], size_mm: float, colour: str) -> list[str]:
    """Placed labels with their leaders."""
    leaders = [leader(frame, label, colour, size_mm) for label in labels if label.leader]
    return leaders + [text(frame, label.centre, label.text, size_mm, fill=colour) for label in labels]


def anchors(curve: BezierChain, *, quickly: bool) -> FloatArray:
    """Points (m, 2) on the curve where its number may stand, the best first; quickly means about there."""
    if quickly:
        points = curve.sampled(curve.length / 32)
        along = lengths(points)
        return at_lengths(points, along, np.array(ANCHOR_SHARES) * along[-1])
    return np.array([piece(curve, 0.0, share * curve.length).end for share in ANCHOR_SHARES])


def label_size_mm(curves: Sequence[BezierChain], low: FloatArray, high: FloatArray, labels: int) -> float:
    """Text height for these curves: as tall as the page allows, smaller where curves are short.

    Where there are very many labels it is smaller still, to be read enlarged on a screen.
    """
    longest_side = float(np.max(high - low))
    typical = float(np.median([curve.length for curve in curves]))
    return crowded_size_mm(float(np.clip(min(longest_side / 22, typical / 3), 1.0, 3.0)), low, high, labels)


def crowded_size_mm(size_mm: float, low: FloatArray, high: FloatArray, labels: int) -> float:
    """Text height of at most `size_mm` at which very many labels take a quarter of the page or less."""
    if labels <= MANY_LABELS:
        return size_mm
    longest_side = float(np.max(high - low))
    digits = len(str(labels))
    each = (digits * DIGIT_WIDTH + 2 * PADDING) * (1 + 2 * PADDING)
    page_mm2 = float(np.prod(np.maximum(high - low, longest_side / 10)))
    return min(size_mm, float(np.sqrt(page_mm2 / (4 * each * labels))))


def bounds_with_labels(
    low: FloatArray, high: FloatArray, labels: Sequence[Label]
) -> tuple[FloatArray, FloatArray]:
    """The corners that also hold these labels."""
    boxes = np.array([[*label.centre, *label.half_size] for label in labels]).reshape(-1, 4)
    lows, highs = boxes[:, :2] - boxes[:, 2:], boxes[:, :2] + boxes[:, 2:]
    return np.vstack([low, lows]).min(axis=0), np.vstack([high, highs]).max(axis=0)
