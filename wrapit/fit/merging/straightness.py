"""Which line goes straight on into which."""

from __future__ import annotations

import math
from typing import Final

from wrapit.fit.sketch import Arm, Sketch
from wrapit.geometry import FloatArray

# A line goes straight on into another where it turns by less than this (rad): as crossings are told apart.
_STRAIGHT: Final = math.radians(40)


def straight_on(sketch: Sketch, arm: Arm) -> Arm | None:
    """The arm at the same node that goes straight on from one, if they are one another's straightest."""
    node = sketch.lines[arm[0]].end if arm[1] else sketch.lines[arm[0]].start
    arms = [other for other in sketch.arms[node] if other != arm]
    best = straightest(sketch, arm, arms)
    if best is None or straightest(sketch, best, [o for o in sketch.arms[node] if o != best]) != arm:
        return None
    return best


def straightest(sketch: Sketch, arm: Arm, others: list[Arm]) -> Arm | None:
    turns = [(_turn_rad(sketch.heading(arm), sketch.heading(other)), other) for other in others]
    turns = [each for each in turns if each[0] < _STRAIGHT]
    return min(turns)[1] if turns else None


def _turn_rad(one: FloatArray, other: FloatArray) -> float:
    """Between the way in along one direction and the way out along the other, in plain numbers."""
    (x, y), (other_x, other_y) = one.tolist(), other.tolist()
    return math.acos(max(-1.0, min(1.0, -(x * other_x + y * other_y))))
