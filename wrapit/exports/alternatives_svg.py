"""Several decompositions of one drawing, side by side with what they cost."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape

from wrapit.decomposition.model import Energy, Solution
from wrapit.exports.decomposition_svg import decomposition_svg
from wrapit.exports.svgpage import FONT
from wrapit.wires.model import Wire

# Look of the page: between the pictures, and of the captions below.
GAP_MM, TEXT_MM = 6.0, 2.6
# What is taken out of each picture to set it beside others: its size, and names that may be there once only.
_SIZE = re.compile(r'viewBox="0 0 ([\d.]+) ([\d.]+)"')
_MM = re.compile(r'(width|height)="([\d.]+)mm"')
_IDS = re.compile(r' (?:id|aria-labelledby)="[^"]*"')


def alternatives_svg(choices: Sequence[tuple[Solution, Sequence[Wire]]]) -> str:
    """SVG in true millimetres: the best choice first, under each its number of wires, bends and weak wires.

    Raises ValueError when there is nothing to show.
    """
    if not choices:
        raise ValueError("there is nothing to choose from")
    body, left, height = [], 0.0, 0.0
    for number, (solution, wires) in enumerate(choices, start=1):
        picture = decomposition_svg(solution, wires)
        size = _SIZE.search(picture)
        assert size is not None
        width, tall = float(size[1]), float(size[2])
        inner = _MM.sub(r'\1="\2"', _IDS.sub("", picture[picture.index("<svg") :].strip()), count=2)
        body.append(inner.replace("<svg ", f'<svg x="{left:g}" y="0" ', 1))
        for line, words in enumerate(_caption(number, solution.energy)):
            y = tall + (1.6 + 1.4 * line) * TEXT_MM
            body.append(f'<text x="{left + width / 2:g}" y="{y:g}">{escape(words)}</text>')
        left += width + GAP_MM
        height = max(height, tall + 6 * TEXT_MM)
    left -= GAP_MM
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{left:g}mm" height="{height:g}mm"'
            f' viewBox="0 0 {left:g} {height:g}" font-family="{FONT}" font-size="{TEXT_MM}"'
            ' text-anchor="middle">',
            "<title>Ways to divide the drawing into wires</title>",
            f'<rect width="{left:g}" height="{height:g}" fill="#ffffff"/>',
            *body,
            "</svg>",
            "",
        ]
    )


def _caption(number: int, energy: Energy) -> tuple[str, ...]:
    wires = f"{energy.complexity} wire{'' if energy.complexity == 1 else 's'}"
    weak = f", {energy.robustness} weak" if energy.robustness else ""
    return (
        f"choice {number}: {wires}{weak}",
        f"bends at junctions {energy.smoothness_rad:.2f} rad in all",
        f"energy {energy.total:.3f}",
    )
