"""Bends that are tighter than the wire takes are widened, line by line."""

from __future__ import annotations

from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.measuring import tight_bends
from wrapit.fit.merging import is_planar, straight_on
from wrapit.fit.mirrored import mirror_pairs
from wrapit.fit.model import Limits
from wrapit.fit.sketch import STEP_MM, Line, Sketch
from wrapit.geometry.bounded import Bounded, bounded
from wrapit.geometry.polyline import lengths
from wrapit.geometry.steering.paths import Held

# How an end may be held where it can't be as firmly as it should.
_LOOSER: Final[dict[Held, Held]] = {"pinned": "placed", "placed": "placed", "free": "free"}


def smoothed(sketch: Sketch, limits: Limits) -> Sketch:
    """The sketch with each line no tighter than the least radius, where its ends allow that.

    A line that goes straight on into another keeps its direction there, one that ends on others its place; a
    loose end may move. A line that can't be widened without crossing another stays.
    """
    pairs = mirror_pairs(sketch)
    tight = {n for n, line in sketch.lines.items() if tight_bends(line.curve, limits.radius_mm)}
    twins = {tuple(sorted({n, pairs.get(n, n)} & tight)) for n in tight}
    # The longest first, whatever they are numbered; images together, so that neither is in the other's way.
    for numbers in sorted(twins, key=lambda each: (-round(sketch.lines[each[0]].curve.length, 3), each)):
        alike = [[ways[0], ways[-1]] for ways in (_ways(sketch, n) for n in numbers)]
        together = _gentle(sketch, limits, numbers, alike) if len(numbers) > 1 else None
        if together is not None:
            sketch = together
            continue
        for n in numbers:
            sketch = _gentle(sketch, limits, (n,), [_ways(sketch, n)]) or sketch
    return sketch


def _gentle(
    sketch: Sketch, limits: Limits, numbers: tuple[int, ...], ways: list[list[tuple[Held, Held]]]
) -> Sketch | None:
    """The sketch with lines widened in the first of the ways of each in which all of them can be."""
    for held in zip(*ways, strict=True):
        lines: dict[int, Line] = {}
        result = sketch
        for n, (start, end) in zip(numbers, held, strict=True):
            line = sketch.lines[n]
            found = _widened(line, limits, start, end, closed=_is_alone(sketch, n))
            if found is None:
                break
            lines[n] = Line(line.start, line.end, found.curve, line.origin)
            nodes = {line.start: found.curve.start, line.end: found.curve.end}
            result = result.changed(lines={n: lines[n]}, nodes=nodes, told=_told(line, found, limits))
        if len(lines) == len(numbers) and is_planar(result, lines, sketch):
            return result
    return None


def _widened(line: Line, limits: Limits, start: Held, end: Held, *, closed: bool) -> Bounded | None:
    if closed:
        return bounded(line.curve, limits.radius_mm, "free", "free", closed=True)
    return bounded(line.curve, limits.radius_mm, start, end)


def _is_alone(sketch: Sketch, n: int) -> bool:
    """Whether a line is a ring that nothing else meets."""
    return sketch.lines[n].is_ring and len(sketch.arms[sketch.lines[n].start]) == 2


def _ways(sketch: Sketch, n: int) -> list[tuple[Held, Held]]:
    """How a line's ends are held, the firmest first."""
    firm = _held(sketch, n, last=False), _held(sketch, n, last=True)
    ways = [
        firm,
        (firm[0], _LOOSER[firm[1]]),
        (_LOOSER[firm[0]], firm[1]),
        (_LOOSER[firm[0]], _LOOSER[firm[1]]),
    ]
    return list(dict.fromkeys(ways))


def _held(sketch: Sketch, n: int, *, last: bool) -> Held:
    line = sketch.lines[n]
    if len(sketch.arms[line.end if last else line.start]) == 1:
        return "free"
    return "placed" if straight_on(sketch, (n, last)) is None else "pinned"


def _told(line: Line, found: Bounded, limits: Limits) -> tuple[Removal, ...]:
    told = []
    points = line.curve.sampled(STEP_MM)
    along = lengths(points)
    for a, b in found.spans:
        # A span of a ring may run on over where it starts.
        x, y = points[np.argmin(np.abs(along - (a + b) / 2 % line.curve.length))]
        told.append(
            Removal(
                "faired",
                (float(x), float(y)),
                b - a,
                f"a bend tighter than {limits.radius_mm:.2f} mm; moved by {found.deviation:.2f} mm at most",
            )
        )
    return tuple(told)
