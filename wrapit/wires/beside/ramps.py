"""How the shift of a run goes over to that of the line before and after it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from wrapit.wires.beside.shifting import Ramp, Shift

# The steepest bend of 6 x⁵ - 15 x⁴ + 10 x³: its second derivative at x = (3 - √3) / 6.
BEND: Final = 10 / math.sqrt(3)
# A ramp on a straight line bends by so many least radii, so that a corner next to it has room left.
RADII = 4.0
# It is shortened to this where it has no room, and then bends 2.8 times as tightly: by 1.4 radii.
SHORTEST = 0.6


@dataclass(frozen=True)
class Level:
    """A part of a line with one shift to the left; `double` says that another run lies beside it there."""

    start_mm: float
    end_mm: float
    shift_mm: float
    double: bool

    @property
    def middle_mm(self) -> float:
        """Halfway along."""
        return (self.start_mm + self.end_mm) / 2


def ramp_mm(rise_mm: float, radius_mm: float) -> float:
    """Length of a ramp: so that it bends by no less than RADII least radii."""
    return math.sqrt(BEND * abs(rise_mm) * RADII * radius_mm)


def shift_of(levels: Sequence[Level], radius_mm: float) -> Shift:
    """The shift of a whole line: ramps lie on single lines where these have room for them.

    A shorter single line between two runs goes over from one to the other at once, or stays beside its own
    place; a short one at the end of the wire has its ramp on the double line next to it.
    """
    merged: list[Level] = []
    for level in levels:
        if merged and not level.double and not merged[-1].double:
            merged[-1] = Level(merged[-1].start_mm, level.end_mm, 0.0, False)
        else:
            merged.append(level)
    ramps: list[Ramp] = []
    first_mm = merged[0].shift_mm
    for index, level in enumerate(merged):
        before = merged[index - 1] if index else None
        after = merged[index + 1] if index + 1 < len(merged) else None
        if not level.double:
            ramps += _across(before, level, after, radius_mm)
        elif after is not None and after.double:
            ramps += _at_once(level, level.end_mm, after, radius_mm)
    return Shift(first_mm, tuple(ramps))


def _across(before: Level | None, level: Level, after: Level | None, radius_mm: float) -> list[Ramp]:
    p, q = (each.shift_mm if each else 0.0 for each in (before, after))
    down, up = ramp_mm(p, radius_mm), ramp_mm(q, radius_mm)
    share = min(1.0, (level.end_mm - level.start_mm) / max(down + up, 1e-9))
    if share >= SHORTEST:
        down, up = share * down, share * up
        ramps = [Ramp(level.start_mm, level.start_mm + down, p, 0.0)] if p else []
        return [*ramps, Ramp(level.end_mm - up, level.end_mm, 0.0, q)] if q else ramps
    if before and after:
        return _at_once(before, level.middle_mm, after, radius_mm)
    if before:
        return [Ramp(max(before.middle_mm, level.end_mm - down), level.end_mm, p, 0.0)]
    assert after is not None
    return [Ramp(level.start_mm, min(after.middle_mm, level.start_mm + up), 0.0, q)]


def _at_once(before: Level, at_mm: float, after: Level, radius_mm: float) -> list[Ramp]:
    """From one double line to another, about a place between them."""
    if before.shift_mm == after.shift_mm:
        return []
    half = ramp_mm(after.shift_mm - before.shift_mm, radius_mm) / 2
    start_mm, end_mm = max(before.middle_mm, at_mm - half), min(after.middle_mm, at_mm + half)
    return [Ramp(start_mm, end_mm, before.shift_mm, after.shift_mm)]
