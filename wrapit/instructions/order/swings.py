"""How a wire turns along its length, and where it swings to one side, to the other, or runs straight."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import runs
from wrapit.wires.model import Wire

# How often a wire is looked at: a tenth of the thickness of the usual one.
STEP_MM: Final = 0.1
# Less turning than this is straight to a hand.
STRAIGHT_RAD: Final = math.radians(12)
# Where a wire bends less than this share of a curve's mean, along so much, it is a straight run within it.
SLACK_SHARE: Final = 0.25
SLACK_MM: Final = 3.0
# A straight run shorter than this is no run: the hand goes from one bend into the next.
LEAST_RUN_MM: Final = 1.5
# A wire goes round a wall's corner where it bends so many times more than along most of it, by so much.
CORNER_RATIO: Final = 2.5
CORNER_RAD: Final = math.radians(40)
# Less turning than this in one step is none: on straight runs rounding leaves 1e-15 to either side.
NO_TURN_RAD: Final = 1e-9


@dataclass(frozen=True, eq=False)
class Line:
    """Places (n + 1,) along a wire, and its turning (n,) between them in rad."""

    at_mm: FloatArray
    turning: FloatArray

    @staticmethod
    def of(wire: Wire) -> Line:
        """Every STEP_MM."""
        lengths = ArcLength(wire.centreline)
        at_mm = lengths.stations(STEP_MM)
        tangents = wire.centreline.derivative(lengths.parameter(at_mm))
        headings = np.unwrap(np.arctan2(tangents[:, 1], tangents[:, 0]))
        return Line(at_mm, np.diff(headings))

    @property
    def count(self) -> int:
        """How many steps there are."""
        return len(self.turning)

    def turned(self, first: int, last: int) -> float:
        """Between two places, positive to the left."""
        return float(self.turning[first:last].sum())

    def length(self, first: int, last: int) -> float:
        """Between two places, in mm."""
        return float(self.at_mm[last] - self.at_mm[first])

    def index(self, at_mm: float) -> int:
        """The first place that is not before this length."""
        return int(np.clip(np.searchsorted(self.at_mm, at_mm - 1e-9), 0, self.count))


def swings(line: Line, first: int, last: int) -> list[tuple[int, int]]:
    """The span parted where the wire bends to the other side; slight swings join their neighbours."""
    if last <= first:
        return []
    bounds = [first, *(first + 1 + np.flatnonzero(np.diff(_sides(line.turning[first:last])))), last]
    spans = [(int(a), int(b)) for a, b in itertools.pairwise(bounds)]
    while len(spans) > 1:
        turned = [abs(line.turned(a, b)) for a, b in spans]
        least = int(np.argmin(turned))
        if turned[least] >= STRAIGHT_RAD:
            break
        low, high = max(0, least - 1), min(len(spans), least + 2)
        spans[low:high] = [(spans[low][0], spans[high - 1][1])]
    return spans


def parted(line: Line, first: int, last: int) -> list[tuple[int, int]]:
    """A swing with its straight runs cut out: where it bends much less than on the whole."""
    turned = abs(line.turned(first, last))
    if turned < STRAIGHT_RAD:
        return [(first, last)]
    slack = np.abs(line.turning[first:last]) < SLACK_SHARE * turned / (last - first)
    cuts = {first, last}
    for a, b in runs(slack):
        # At the ends of a swing, any straight run that is one; within it, long ones alone.
        at_end = a == 0 or b == last - first - 1
        if line.length(first + a, first + b + 1) >= (LEAST_RUN_MM if at_end else SLACK_MM):
            cuts |= {first + a, first + b + 1}
    return list(itertools.pairwise(sorted(cuts)))


def at_corners(line: Line, first: int, last: int) -> list[tuple[int, int]]:
    """A wrap parted where it goes round corners of its wall: a hand wraps one side, then round the tip.

    It stays whole where a part of it would bend to the other side.
    """
    bends = np.abs(line.turning[first:last])
    cuts = {first, last}
    # Where most of a wrap is straight, its corner is what bends more than on the whole.
    for a, b in runs(bends > max(CORNER_RATIO * np.median(bends), bends.mean())):
        if abs(line.turned(first + a, first + b + 1)) >= CORNER_RAD:
            cuts |= {first + a, first + b + 1}
    parts = list(itertools.pairwise(sorted(cuts)))
    side = np.sign(line.turned(first, last))
    one_way = all(side * line.turned(a, b) > -NO_TURN_RAD for a, b in parts)
    return parts if one_way else [(first, last)]


def _sides(turning: FloatArray) -> FloatArray:
    """To which side (1 or -1) a wire bends in each step (n,); straight ones go with those before them."""
    sides = np.where(np.abs(turning) > NO_TURN_RAD, np.sign(turning), 0.0)
    bent = np.flatnonzero(sides)
    if not len(bent):
        return sides
    before = np.maximum(np.searchsorted(bent, np.arange(len(sides)), side="right") - 1, 0)
    return np.asarray(sides[bent[before]])
