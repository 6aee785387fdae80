"""The wires of a drawing at true size, coloured and numbered."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wrapit.decomposition.model import Solution
from wrapit.exports.svgpage import (
    CROWDED_RINGS,
    FONT,
    MANY_LABELS,
    attributes,
    bounds_with_labels,
    crowded_size_mm,
    leader,
    page,
    text,
)
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.arclength import piece
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame
from wrapit.wires.model import Wire

# Near black: rims of wire ends and numbers, on any of the wires' colours.
OUTLINE = "#222222"


def decomposition_svg(solution: Solution, wires: Sequence[Wire]) -> str:
    """SVG in true millimetres: each wire in its colour and thickness, its number where it starts.

    Wire ends have a dark ring; a segment that is run along twice is drawn as two lines side by side.
    Of very many wires those without room have no number; each says its own where the pointer rests on it.
    """
    low, high = solution.decomposition.drawing.bounds_mm
    crowded = len(wires) > MANY_LABELS
    size_mm = crowded_size_mm(float(np.clip(np.max(high - low) / 18, 1.6, 3.5)), low, high, len(wires))
    ink = np.vstack([chain_of(wire.centreline).sampled(0.3 * size_mm) for wire in wires])
    wanted = [(str(wire.number), wire.ends[:1]) for wire in wires]
    labels = place_labels(wanted, ink, size_mm, rings=CROWDED_RINGS if crowded else None)
    low, high = bounds_with_labels(low, high, labels)
    frame = SvgFrame.around(low, high, size_mm)
    doubled = set(solution.doubled)
    body = [f'<g font-family="{FONT}" font-weight="bold">']
    seen: set[int] = set()
    for wire in wires:
        body += _strokes(wire, doubled, seen, frame, named=crowded)
    for wire in wires:
        body += _ends(wire, frame)
    body += [*_numbers(wires, labels, frame, size_mm), "</g>"]
    count = f"{len(wires)} wire{'s' if len(wires) != 1 else ''}"
    lengths = ", ".join(f"{wire.number}: {wire.length_mm:.0f} mm" for wire in wires)
    return page(frame, f"The drawing divided into {count}", f"Lengths: {lengths}", body)


def _strokes(wire: Wire, doubled: set[int], seen: set[int], frame: SvgFrame, *, named: bool) -> list[str]:
    """The wire as paths; `seen` collects the doubled segments drawn so far, by any wire."""
    chain = chain_of(wire.centreline)
    shapes: list[str] = []
    plain_from = 0.0
    for traversal, (start, end) in zip(wire.traversals, wire.segment_spans_mm, strict=True):
        if traversal.segment not in doubled:
            continue
        if start - plain_from > 1e-6:
            shapes.append(frame.path(piece(chain, plain_from, start)))
        # Both passes are seen from the segment's own direction, so that they lie on opposite sides.
        side = -1.0 if traversal.segment in seen else 1.0
        seen.add(traversal.segment)
        shift = side * (-1.0 if traversal.reversed else 1.0) * 0.55 * wire.diameter_mm
        shapes.append(frame.polyline(_beside(piece(chain, start, end), shift)))
        plain_from = end
    if chain.length - plain_from > 1e-6:
        shapes.append(frame.path(piece(chain, plain_from, chain.length)))
    style = attributes(
        stroke=wire.colour,
        stroke_width=wire.diameter_mm * (0.6 if doubled else 0.8),
        fill="none",
        stroke_linecap="round",
        stroke_linejoin="round",
    )
    drawn = [f"<path {attributes(d=shape)}/>" for shape in shapes]
    tip = [f"<title>wire {wire.number}</title>"] if named else []
    return [f'<g id="{wire.name}" {style}>', *tip, *drawn, "</g>"]


def _beside(chain: BezierChain, shift_mm: float) -> FloatArray:
    points = chain.sampled(0.1)
    along = unit(np.gradient(points, axis=0))
    return points + shift_mm * np.column_stack([-along[:, 1], along[:, 0]])


def _ends(wire: Wire, frame: SvgFrame) -> list[str]:
    look = attributes(
        r=0.55 * wire.diameter_mm, fill="#ffffff", stroke=OUTLINE, stroke_width=0.2 * wire.diameter_mm
    )
    ends = wire.ends[:1] if wire.closed else wire.ends
    return [f'<circle {attributes(cx=x, cy=y)} {look} class="end"/>' for x, y in map(frame.at, ends)]


def _numbers(wires: Sequence[Wire], labels: Sequence[Label], frame: SvgFrame, size_mm: float) -> list[str]:
    shapes = []
    colours = {str(wire.number): wire.colour for wire in wires}
    for label in labels:
        if label.leader:
            shapes.append(leader(frame, label, OUTLINE, size_mm))
        x, y = frame.at(label.centre)
        half_x, half_y = label.half_size
        box = attributes(
            x=x - half_x, y=y - half_y, width=2 * half_x, height=2 * half_y, rx=0.3 * size_mm,
            fill="#ffffff", stroke=colours[label.text], stroke_width=0.14 * size_mm,
        )  # fmt: skip
        shapes += [f"<rect {box}/>", text(frame, label.centre, label.text, size_mm, fill=OUTLINE)]
    return shapes
