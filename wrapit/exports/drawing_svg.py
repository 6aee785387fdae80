"""The traced drawing at true size, with the numbers that a config refers to."""

from __future__ import annotations

from xml.sax.saxutils import escape

import numpy as np

from wrapit.drawing.model import Drawing, Removal, Segment
from wrapit.exports.before_fit import (
    NUMBER,
    broken,
    changes,
    counted,
    grey_texts,
    listed,
    original_lines,
    original_numbers,
    renumbered,
    small_print,
    told,
)
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
from wrapit.fit.model import Fitted
from wrapit.geometry import FloatArray
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame

# Colours that stay apart on white and on each other; segments' and junctions' numbers differ in slant as
# well.
INK, BRIDGE, SEGMENT_NUMBER, JUNCTION, REMOVED = "#1c1c1c", "#7a3fa0", "#0b5a8a", "#b02a1a", "#8a5a00"
# More numbers can't be read at any size that shows the drawing.
MOST_LABELS = 8000


def drawing_svg(drawing: Drawing, fitted: Fitted | None = None) -> str:
    """SVG in true millimetres: segments in ink, numbered segments and junctions, and what was removed.

    Where it was made fit, what it was lies in grey beneath, with grey numbers where they aren't the same, and
    the changes are listed below.

    No two numbers overlap; a number that finds no room beside its curve stands apart, on a thin line. In
    drawings with very many, some or all numbers are not written but shown where the pointer rests.
    """
    low, high = drawing.bounds_mm
    removed = np.array([removal.at for removal in drawing.removed]).reshape(-1, 2)
    low, high = np.vstack([low, removed]).min(axis=0), np.vstack([high, removed]).max(axis=0)
    before = renumbered(fitted) if fitted is not None else ()
    if fitted is not None:
        corners = np.vstack([low, high, *fitted.original.bounds_mm])
        low, high = corners.min(axis=0), corners.max(axis=0)
    labels = len(drawing.segments) + len(drawing.junctions) + len(before)
    size_mm = label_size_mm([segment.curve for segment in drawing.segments], low, high, labels)
    small_mm = 0.6 * size_mm
    junctions, segments, grey = (
        _placed_numbers(drawing, removed, before, size_mm) if labels <= MOST_LABELS else ((), (), ())
    )
    low, high = bounds_with_labels(low, high, (*junctions, *segments, *grey))
    legend, changed = _legend(drawing, fitted, labels), []
    if fitted is not None:
        width_mm = float(high[0] - low[0])
        legend = [(part, colour) for line, colour in legend for part in broken(line, width_mm, 0.9 * size_mm)]
        changed = listed(changes(fitted), width_mm, small_mm)
    print_mm = 1.4 * small_mm * (len(changed) + 1) if changed else 0.0
    frame = SvgFrame.around(low, high, 2 * size_mm, below_mm=1.6 * size_mm * len(legend) + print_mm)
    body = [f'<g font-family="{FONT}">']
    body += original_lines(fitted, frame) if fitted is not None else []
    body += _ink(drawing, frame, labels)
    body += [_cross(frame, removal, size_mm) for removal in drawing.removed]
    body += _numbers(drawing, junctions, segments, frame, size_mm, labels)
    body += grey_texts(frame, grey, size_mm)
    foot = frame.top - frame.height_mm + print_mm
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
    body += small_print(frame, changed, foot + 0.8 * small_mm, small_mm, REMOVED)
    body.append("</g>")
    title = "The drawing as it was read" if fitted is None else "The drawing made fit for wire"
    return page(frame, title, ". ".join(line for line, _ in legend), body)


def _ink(drawing: Drawing, frame: SvgFrame, labels: int) -> list[str]:
    width = drawing.stroke_width_mm or 0.5
    style = attributes(fill="none", stroke_linecap="round", stroke_linejoin="round", stroke_width=width)
    crowded = labels > MANY_LABELS
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
    drawing: Drawing, removed: FloatArray, before: tuple[Segment, ...], size_mm: float
) -> tuple[tuple[Label, ...], tuple[Label, ...], tuple[Label, ...]]:
    """Labels of the junctions, of the segments, and of those of before."""
    crowded = len(drawing.segments) + len(drawing.junctions) + len(before) > MANY_LABELS
    rings = CROWDED_RINGS if crowded else None
    points = [junction.point[None] for junction in drawing.junctions]
    ink = np.vstack(
        [*(segment.curve.sampled(0.2 * size_mm) for segment in drawing.segments), *points, removed]
    )
    junctions = place_labels(
        [(str(index), point) for index, point in enumerate(points)], ink, size_mm, rings=rings
    )
    wanted = [(str(segment.id), anchors(segment.curve, quickly=crowded)) for segment in drawing.segments]
    segments = place_labels(wanted, ink, size_mm, junctions, rings)
    grey = original_numbers(before, ink, size_mm, (*junctions, *segments), crowded=crowded) if before else ()
    return junctions, segments, grey


def _numbers(
    drawing: Drawing,
    junctions: tuple[Label, ...],
    segments: tuple[Label, ...],
    frame: SvgFrame,
    size_mm: float,
    labels: int,
) -> list[str]:
    crowded = labels > MANY_LABELS
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
    look = attributes(d=data, stroke=REMOVED, stroke_width=0.14 * size_mm, fill="none")
    return f'<path class="removed" {look}><title>{escape(told(removal))}</title></path>'


def _legend(drawing: Drawing, fitted: Fitted | None, labels: int) -> list[tuple[str, str]]:
    lines = [
        ("bold blue number: segment", SEGMENT_NUMBER),
        ("dot and slanted red number: junction", JUNCTION),
    ]
    if labels > MANY_LABELS:
        lines.append(("numbers without room are not written: rest the pointer on a line or dot", JUNCTION))
    if any(segment.kind == "bridge" for segment in drawing.segments):
        lines.append(("dashed: bridge that may be added", BRIDGE))
    if fitted is not None:
        lines.append(("grey number: segment as it was read (where it differs), for keep and drop", NUMBER))
    cleaned = drawing.removed if fitted is None else fitted.original.removed
    if cleaned:
        lines.append((f"× changed by clean-up: {counted(cleaned)}", REMOVED))
    if fitted is not None and changes(fitted):
        lines.append((f"× changed to be fit: {counted(changes(fitted))}", REMOVED))
    return lines
