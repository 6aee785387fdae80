"""Pairs of runs side by side, made directly from arcs and lines: two wires, or one that folds back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tests.jig.metal import AWG18_MM, arcs, wires_of
from wrapit.config import JigConfig
from wrapit.geometry import BezierChain
from wrapit.wires.model import DoubleRun, Side, Wire

D = AWG18_MM
# (radius, degrees) of an arc, positive to the left, or (length, 0) of a line: the line between both runs.
Parts = Sequence[tuple[float, float]]
STRAIGHT: Parts = ((40, 0),)
ARC: Parts = ((12, 0), (6, 100), (12, 0))
RIGHT: Parts = ((12, 0), (6, -100), (12, 0))
S_SHAPE: Parts = ((12, 0), (7, 110), (9, 0), (7, -110), (12, 0))
SHAPES = {"straight": STRAIGHT, "arc": ARC, "right": RIGHT, "S": S_SHAPE}


def beside(parts: Parts, left: float) -> list[tuple[float, float]]:
    """The run that lies `left` mm to the left of these parts."""
    return [(size - (left if turn > 0 else -left), turn) if turn else (size, turn) for size, turn in parts]


def backwards(parts: Parts) -> list[tuple[float, float]]:
    """The same way from its end to its start."""
    return [(size, -turn) for size, turn in reversed(parts)]


def length_mm(parts: Parts) -> float:
    return sum(size * (math.radians(abs(turn)) if turn else 1.0) for size, turn in parts)


def two_wires(parts: Parts, *, opposed: bool = False, config: JigConfig | None = None) -> tuple[Wire, Wire]:
    """Wire 1 half a diameter to the right of the line, wire 2 as far to its left, opposed or not."""
    right, left = beside(parts, -D / 2), beside(parts, D / 2)
    first = arcs((0, -D / 2), 0, *right)
    second = arcs((0, D / 2), 0, *left)
    if opposed:
        second = second.reversed()
    one, two = wires_of([first, second], config)
    side: Side = "left" if opposed else "right"
    return (
        replace(one, doubles=(DoubleRun(0, one.length_mm, two.name, "left", opposed, True),)),
        replace(two, doubles=(DoubleRun(0, two.length_mm, one.name, side, opposed, False),)),
    )


def meeting(radius_mm: float, degrees: float) -> tuple[Wire, Wire]:
    """A straight wire, and one that comes to its left side, goes along with it for 20 mm, and leaves it."""
    here, along = (20.0, D / 2), 20.0
    coming = arcs(here, math.pi, (radius_mm, -degrees), (15, 0)).reversed()
    leaving = arcs(here, 0, (along, 0), (radius_mm, degrees), (15, 0))
    points = np.concatenate([coming.points, leaving.points])
    points[len(coming.points) - 1, 3] = points[len(coming.points), 0]
    one, two = wires_of([arcs((0, -D / 2), 0, (60, 0)), BezierChain(points)])
    met = length_mm(((radius_mm, degrees), (15, 0)))
    return (
        replace(one, doubles=(DoubleRun(here[0], here[0] + along, two.name, "left", False, True),)),
        replace(two, doubles=(DoubleRun(met, met + along, one.name, "right", False, False),)),
    )


def hairpin(parts: Parts, radius_mm: float = 1.6, config: JigConfig | None = None) -> Wire:
    """One wire along these parts, round a bulb to the left, and back on its own left."""
    out, back = beside(parts, -D / 2), backwards(beside(parts, D / 2))
    away = math.degrees(math.acos((D + 2 * radius_mm) / (4 * radius_mm)))
    bulb = [(radius_mm, -away), (radius_mm, 180 + 2 * away), (radius_mm, -away)]
    (wire,) = wires_of([arcs((0, -D / 2), 0, *out, *bulb, *back)], config)
    there, round_mm = length_mm(out), length_mm(bulb)
    ends = there, there + round_mm
    return replace(
        wire,
        lifts=(),
        layers=1,
        doubles=(
            DoubleRun(0, ends[0], wire.name, "left", True, True),
            DoubleRun(ends[1], wire.length_mm, wire.name, "left", True, False),
        ),
    )
