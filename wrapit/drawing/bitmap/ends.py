"""Where a stroke ends, and how: half a width before the edge of the ink."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, Ending
from wrapit.drawing.bitmap.centre_lines import sample
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray


def place_end(arm: Arm, ink: Ink) -> tuple[FloatArray, Ending]:
    """The end point of a stroke with a round cap, and its outward (into the stroke) tangent.

    Marches from the last clean point along the stroke's own curve to the edge of the ink and steps back
    by half the width.
    """
    width = arm.width_px
    steps = np.arange(0.0, 3 * width, 0.5)
    a, b, _ = arm.model
    # The curve goes on as its tangent, a quadratic would curl.
    start, slope = a, b / max(float(np.linalg.norm(b)), 1e-9)
    levels = sample(ink.grey, start[None], -slope[None], steps)[0] - ink.half
    light = np.flatnonzero(levels > 0)
    if not len(light) or light[0] == 0:
        return start, Ending(slope, np.zeros((0, 2)), arm.cut)
    at = int(light[0])
    before, after = float(levels[at - 1]), float(levels[at])
    edge = steps[at - 1] + 0.5 * (-before / (after - before))
    back = edge - width / 2
    if back >= 0:
        return start - back * slope, Ending(slope, np.zeros((0, 2)), arm.cut)
    inside = min(-back, arm.length / 2)
    first = int(np.searchsorted(arm.along, inside, side="right"))
    place, direction = arm.at(inside)
    return place, Ending(direction, np.zeros((0, 2)), arm.cut + first)
