"""Bends that are tighter than the wire takes are widened, line by line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.measuring import tight_bends
from wrapit.fit.merging.planarity import is_planar
from wrapit.fit.merging.straightness import straight_on
from wrapit.fit.model import Limits
from wrapit.fit.sketch import STEP_MM, Line, Sketch
from wrapit.geometry.bounded import Bounded, Bounding, bounded
from wrapit.geometry.polyline import lengths
from wrapit.geometry.steering.paths import Held

# How an end may be held where it can't be as firmly as it should.
_LOOSER: Final[dict[Held, Held]] = {"pinned": "placed", "placed": "placed", "free": "free"}


# An end that is held less firmly than it should counts as so much deviation, in least radii.
_LOOSENED: Final = 0.25


def smoothed(sketch: Sketch, limits: Limits) -> Sketch:
    """The sketch with each line no tighter than the least radius, where its ends allow that.

    A line that goes straight on into another keeps its direction there, one that ends on others its place; a
    loose end may move. An end is held less firmly where the line stays much nearer to the drawing so. A line
    that can't be widened without crossing another stays.
    """
    bends = tight_bends([line.curve for line in sketch.lines.values()], limits.radius_mm)
    tight = [n for n, count in zip(sketch.lines, bends, strict=True) if count]
    tight.sort(key=lambda n: (-round(sketch.lines[n].curve.length, 3), n))  # however they are numbered
    ways = {n: _ways(sketch, n, limits) for n in tight}  # of the sketch as it is now
    for n in tight:
        line = sketch.lines[n]
        for found in ways[n]:
            new = Line(line.start, line.end, found.curve, line.origin)
            nodes = {line.start: found.curve.start, line.end: found.curve.end}
            result = sketch.changed(lines={n: new}, nodes=nodes, told=_told(line, found, limits))
            if is_planar(result, {n: new}, sketch):
                sketch = result
                break
    return sketch


def _ways(sketch: Sketch, n: int, limits: Limits) -> Iterator[Bounded]:
    """How a line can be widened, the best first; what is dearer is looked for when it is asked for."""
    line, radius_mm = sketch.lines[n], limits.radius_mm
    if line.is_ring and len(sketch.arms[line.start]) == 2:
        ring = bounded(line.curve, radius_mm, "free", "free", closed=True)
        if ring is not None:
            yield ring
        return
    bounding = Bounding(line.curve, radius_mm)
    start, end = _held(sketch, n, last=False), _held(sketch, n, last=True)
    found: list[tuple[float, int, Bounded]] = []
    holds = ((start, end), (start, _LOOSER[end]), (_LOOSER[start], end), (_LOOSER[start], _LOOSER[end]))
    for way in dict.fromkeys(holds):
        loosened = (way[0] != start) + (way[1] != end)
        while found and found[0][0] < _LOOSENED * radius_mm * loosened:
            yield found.pop(0)[2]  # no way still to come is as good
        wide = bounding.held(*way)
        if wide is not None:
            found.append((wide.deviation + _LOOSENED * radius_mm * loosened, loosened, wide))
            found.sort(key=lambda each: each[:2])
            if wide.deviation <= _LOOSENED * radius_mm:
                break
    yield from (wide for *_, wide in found)


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
