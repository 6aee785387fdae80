"""What dashes leave of a line: usually it is meant as a whole; a single dash is all that is seen of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wrapit.drawing.svg.cutting import stretches
from wrapit.drawing.svg.planar import Curve
from wrapit.drawing.svg.reading.model import Shape
from wrapit.drawing.svg.seen.parting import points, samples
from wrapit.geometry.polyline import lengths

# With more rounds of its pattern than these along a line, several dashes lie on it without counting.
_ROUNDS = 3
# In lengths of the line: a dash that ends where it begins, but for rounding, isn't on it. Programs that let a
# line draw itself give dashes of its length, in few digits.
_ROUNDING = 1e-4


@dataclass(frozen=True, eq=False)
class Dashed:
    """What of a curve is read, and how it is drawn: whole, in dashes, or less of it in one or no dash."""

    drawn: Literal["whole", "dashed", "less"]
    curve: Curve | None


def of_dashes(curve: Curve, shape: Shape) -> Dashed:
    """What the dashes of a shape show of one of its curves."""
    period = sum(shape.dashes)
    if not period > 0 or not any(gap > _capped(shape) for gap in shape.dashes[1::2]):
        return Dashed("whole", curve)
    if shape.cap == "butt" and not any(shape.dashes[::2]):
        return Dashed("less", None)
    at = samples(curve)
    along = lengths(points(curve.cubics, at))
    whole = float(along[-1])
    spans = _spans(shape, whole, curve.closed) if whole <= _ROUNDS * period else []
    if len(spans) > 1 or whole > _ROUNDS * period:
        return Dashed("dashed", curve)
    if not spans:
        return Dashed("less", None)
    ((start, end),) = spans
    turns = len(curve.cubics)
    first, last = (
        float(np.interp(place % whole if place > whole else place, along, at)) + turns * (place > whole)
        for place in (start, end)
    )
    part = stretches(curve.cubics, [first], [last])[0]
    if end - start >= whole:
        return Dashed("whole", curve)
    return Dashed("less", None if part is None else Curve(part, closed=False))


def _capped(shape: Shape) -> float:
    """How much of a gap the caps of the dashes beside it fill."""
    return shape.stroke_width if shape.cap in ("round", "square") else 0.0


def _spans(shape: Shape, whole: float, closed: bool) -> list[tuple[float, float]]:
    """Where along a line dashes lie; one over the seam of a closed line goes on beyond its length."""
    period, rounding = sum(shape.dashes), _ROUNDING * whole
    spans: list[tuple[float, float]] = []
    for turn in range(_ROUNDS + 2):
        at = turn * period - math.fmod(math.fmod(shape.dash_offset, period) + period, period)
        for dash, gap in zip(shape.dashes[::2], shape.dashes[1::2], strict=True):
            start, end = max(at, 0.0), min(at + dash, whole)
            touches = bool(dash) and (at + dash <= rounding or at >= whole - rounding)
            at += dash + gap
            if touches or end < start or (end == start and shape.cap == "butt"):
                continue
            if spans and start - spans[-1][1] <= _capped(shape):
                spans[-1] = (spans[-1][0], max(end, spans[-1][1]))
            else:
                spans.append((start, end))
    if closed and len(spans) > 1 and spans[0][0] + whole - spans[-1][1] <= _capped(shape):
        _, end = spans.pop(0)
        spans[-1] = (spans[-1][0], whole + end)
    return spans
