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
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.svgframe import SvgFrame
from wrapit.wires.model import Wire

# Near black: rims of wire ends and numbers, on any of the wires' colours.
OUTLINE = "#222222"


def decomposition_svg(solution: Solution, wires: Sequence[Wire]) -> str:
    """SVG in true millimetres: each wire in its colour and thickness, its number where it starts.

    Wire ends have a dark ring. Two runs along one segment lie side by side, as the wires do.
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
    body = [f'<g font-family="{FONT}" font-weight="bold">']
    for wire in wires:
        body += _strokes(wire, frame, named=crowded)
    for wire in wires:
        body += _ends(wire, frame)
    body += [*_numbers(wires, labels, frame, size_mm), "</g>"]
    count = f"{len(wires)} wire{'s' if len(wires) != 1 else ''}"
    lengths = ", ".join(f"{wire.number}: {wire.length_mm:.0f} mm" for wire in wires)
    return page(frame, f"The drawing divided into {count}", f"Lengths: {lengths}", body)


def _strokes(wire: Wire, frame: SvgFrame, *, named: bool) -> list[str]:
    style = attributes(
        stroke=wire.colour,
        stroke_width=0.8 * wire.diameter_mm,
        fill="none",
        stroke_linecap="round",
        stroke_linejoin="round",
    )
    tip = [f"<title>wire {wire.number}</title>"] if named else []
    path = f"<path {attributes(d=frame.path(chain_of(wire.centreline)))}/>"
    return [f'<g id="{wire.name}" {style}>', *tip, path, "</g>"]


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
