"""Several decompositions of one drawing, side by side with what they cost."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import degrees
from xml.sax.saxutils import escape

from wrapit.decomposition.graph import most_of_a_piece
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


Drawn = tuple[Solution, Sequence[Wire]]
"""Wires-to-be, and the wires drawn of them."""


def alternatives_svg(choices: Sequence[Drawn]) -> str:
    """SVG in true millimetres: the best choice first, under each its number of wires, bends and weak wires.

    Raises ValueError when there is nothing to show.
    """
    captions = [_energies(number, solution.energy) for number, (solution, _) in enumerate(choices, start=1)]
    return _in_a_row("Ways to divide the drawing into wires", choices, captions)


def fewer_wires_svg(front: Sequence[Drawn]) -> str:
    """SVG in true millimetres: the most wires first, under each what fewer of them cost, and their lengths.

    The first is without `max_wires`; each other one says the number that asks for it.
    Raises ValueError when there is nothing to show.
    """
    captions = [_costs(number, solution, wires) for number, (solution, wires) in enumerate(front)]
    return _in_a_row("Fewer wires, for lines that are run along twice", front, captions)


def _in_a_row(title: str, choices: Sequence[Drawn], captions: Sequence[Sequence[str]]) -> str:
    """The pictures beside one another, each with its lines below."""
    if not choices:
        raise ValueError("there is nothing to choose from")
    body, left, height = [], 0.0, 0.0
    for (solution, wires), caption in zip(choices, captions, strict=True):
        picture = decomposition_svg(solution, wires)
        size = _SIZE.search(picture)
        assert size is not None
        width, tall = float(size[1]), float(size[2])
        inner = _MM.sub(r'\1="\2"', _IDS.sub("", picture[picture.index("<svg") :].strip()), count=2)
        body.append(inner.replace("<svg ", f'<svg x="{left:g}" y="0" ', 1))
        for line, words in enumerate(caption):
            y = tall + (1.6 + 1.4 * line) * TEXT_MM
            body.append(f'<text x="{left + width / 2:g}" y="{y:g}">{escape(words)}</text>')
        left += width + GAP_MM
        height = max(height, tall + (1.8 + 1.4 * len(caption)) * TEXT_MM)
    left -= GAP_MM
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{left:g}mm" height="{height:g}mm"'
            f' viewBox="0 0 {left:g} {height:g}" font-family="{FONT}" font-size="{TEXT_MM}"'
            ' text-anchor="middle">',
            f"<title>{title}</title>",
            f'<rect width="{left:g}" height="{height:g}" fill="#ffffff"/>',
            *body,
            "</svg>",
            "",
        ]
    )


def _energies(number: int, energy: Energy) -> tuple[str, ...]:
    weak = f", {energy.robustness} weak" if energy.robustness else ""
    return (
        f"choice {number}: {_wires(energy.complexity)}{weak}",
        f"bends at junctions {energy.smoothness_rad:.2f} rad in all",
        f"energy {energy.total:.3f}",
    )


def _costs(number: int, solution: Solution, wires: Sequence[Wire]) -> tuple[str, ...]:
    return (
        f"max_wires: {most_of_a_piece(solution)}" if number else "no max_wires",
        f"{_wires(len(wires))}, {solution.doubled_mm:.0f} mm run twice",
        f"bends {degrees(solution.energy.smoothness_rad):.0f}° in all",
        *(f"{wire.name}: {wire.length_mm:.0f} mm" for wire in wires),
    )


def _wires(count: int) -> str:
    return f"{count} wire{'' if count == 1 else 's'}"
