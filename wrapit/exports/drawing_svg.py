"""The traced drawing at true size, with the numbers that a config refers to."""

from __future__ import annotations

from collections import Counter
from xml.sax.saxutils import escape

import numpy as np

from wrapit.drawing.model import Drawing, Removal
from wrapit.exports.svgpage import (
    CROWDED_RINGS,
    FONT,
    MANY_LABELS,
    anchors,
    attributes,
    bounds_with_labels,
    label_size_mm,
    label_texts,
    page,
    text,
)
from wrapit.geometry import FloatArray
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame

# Colours that stay apart on white and on each other; segments' and junctions' numbers differ in slant as
# well.
INK, BRIDGE, SEGMENT_NUMBER, JUNCTION, REMOVED = "#1c1c1c", "#7a3fa0", "#0b5a8a", "#b02a1a", "#8a5a00"
# More numbers can't be read at any size that shows the drawing.
MOST_LABELS = 8000


def drawing_svg(drawing: Drawing) -> str:
    """SVG in true millimetres: segments in ink, numbered segments and junctions, and what was removed.

    No two numbers overlap; a number that finds no room beside its curve stands apart, on a thin line. In
    drawings with very many, some or all numbers are not written but shown where the pointer rests.
    """
    low, high = drawing.bounds_mm
    removed = np.array([removal.at for removal in drawing.removed]).reshape(-1, 2)
    low, high = np.vstack([low, removed]).min(axis=0), np.vstack([high, removed]).max(axis=0)
    labels = len(drawing.segments) + len(drawing.junctions)
    size_mm = label_size_mm([segment.curve for segment in drawing.segments], low, high, labels)
    legend = _legend(drawing)
    junctions, segments = _placed_numbers(drawing, removed, size_mm) if labels <= MOST_LABELS else ((), ())
    low, high = bounds_with_labels(low, high, (*junctions, *segments))
    frame = SvgFrame.around(low, high, 2 * size_mm, below_mm=1.6 * size_mm * len(legend))
    body = [f'<g font-family="{FONT}">']
    body += _ink(drawing, frame)
    body += [_cross(frame, removal, size_mm) for removal in drawing.removed]
    body += _numbers(drawing, junctions, segments, frame, size_mm)
    foot = frame.top - frame.height_mm
    body += [
        text(
            frame,
            (frame.left + 2 * size_mm, foot + 1.6 * size_mm * (len(legend) - index)),
            line,
            0.9 * size_mm,
            fill=colour,
            style="text-anchor:start",
        )
        for index, (line, colour) in enumerate(legend)
    ]
    body.append("</g>")
    return page(frame, "The drawing as it was read", ". ".join(line for line, _ in legend), body)


def _ink(drawing: Drawing, frame: SvgFrame) -> list[str]:
    width = drawing.stroke_width_mm or 0.5
    style = attributes(fill="none", stroke_linecap="round", stroke_linejoin="round", stroke_width=width)
    crowded = _is_crowded(drawing)
    lines = []
    for segment in drawing.segments:
        look = {"stroke": INK}
        if segment.kind == "bridge":
            look = {"stroke": BRIDGE, "stroke-dasharray": f"{2 * width:g} {2 * width:g}"}
        shape = attributes(id=f"segment-{segment.id}", d=frame.path(segment.curve), **look)
        tip = f"><title>segment {segment.id}</title></path>" if crowded else "/>"
        lines.append(f"<path {shape} {style}{tip}")
    return lines


def _placed_numbers(
    drawing: Drawing, removed: FloatArray, size_mm: float
) -> tuple[tuple[Label, ...], tuple[Label, ...]]:
    """Labels of the junctions and of the segments."""
    crowded = _is_crowded(drawing)
    rings = CROWDED_RINGS if crowded else None
    points = [junction.point[None] for junction in drawing.junctions]
    ink = np.vstack(
        [*(segment.curve.sampled(0.2 * size_mm) for segment in drawing.segments), *points, removed]
    )
    junctions = place_labels(
        [(str(index), point) for index, point in enumerate(points)], ink, size_mm, rings=rings
    )
    wanted = [(str(segment.id), anchors(segment.curve, quickly=crowded)) for segment in drawing.segments]
    return junctions, place_labels(wanted, ink, size_mm, junctions, rings)


def _numbers(
    drawing: Drawing,
    junctions: tuple[Label, ...],
    segments: tuple[Label, ...],
    frame: SvgFrame,
    size_mm: float,
) -> list[str]:
    crowded = _is_crowded(drawing)
    dots = []
    for junction in drawing.junctions:
        x, y = frame.at(junction.point)
        tip = f"><title>junction {junction.id}</title></circle>" if crowded else "/>"
        dots.append(f"<circle {attributes(cx=x, cy=y, r=0.28 * size_mm, fill=JUNCTION)}{tip}")
    return [
        *dots,
        '<g font-style="italic">',
        *label_texts(frame, junctions, size_mm, JUNCTION),
        '</g><g font-weight="bold">',
        *label_texts(frame, segments, size_mm, SEGMENT_NUMBER),
        "</g>",
    ]


def _cross(frame: SvgFrame, removal: Removal, size_mm: float) -> str:
    x, y = frame.at(removal.at)
    arm = 0.35 * size_mm
    data = f"M{x - arm:.4f},{y - arm:.4f}l{2 * arm:.4f},{2 * arm:.4f}m0,{-2 * arm:.4f}"
    data += f"l{-2 * arm:.4f},{2 * arm:.4f}"
    note = f"{removal.what}, {removal.length_mm:.2f} mm" + (f": {removal.reason}" if removal.reason else "")
    look = attributes(d=data, stroke=REMOVED, stroke_width=0.14 * size_mm, fill="none")
    return f'<path class="removed" {look}><title>{escape(note)}</title></path>'


def _legend(drawing: Drawing) -> list[tuple[str, str]]:
    lines = [
        ("bold blue number: segment", SEGMENT_NUMBER),
        ("dot and slanted red number: junction", JUNCTION),
    ]
    if _is_crowded(drawing):
        lines.append(("numbers without room are not written: rest the pointer on a line or dot", JUNCTION))
    if any(segment.kind == "bridge" for segment in drawing.segments):
        lines.append(("dashed: bridge that may be added", BRIDGE))
    if drawing.removed:
        kinds = Counter(removal.what for removal in drawing.removed)
        counted = ", ".join(f"{count} × {what}" for what, count in sorted(kinds.items()))
        lines.append((f"× changed by clean-up: {counted}", REMOVED))
    return lines


def _is_crowded(drawing: Drawing) -> bool:
    """Whether numbers at their usual size would cover the drawing."""
    return len(drawing.segments) + len(drawing.junctions) > MANY_LABELS
