"""Where a wire passes over what already lies in the jig: wires laid before it, and its own earlier course."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import runs
from wrapit.instructions.model import Crossing
from wrapit.wires.model import Wire
from wrapit.wires.stacking import SELF_DIAMETERS, STEP_MM

# Two passes this near each other along the wire are one to the hand: it lies on the others all the while.
ONE_PASS_DIAMETERS: Final = 2.0


def crossings_over(wire: Wire, laid: Sequence[Wire]) -> tuple[Crossing, ...]:
    """Places in the order of the wire where it is nearer than a diameter to what lies there already."""
    at_mm, points = _stations(wire)
    below = {each.number: _near(points, _stations(each)[1], wire.diameter_mm) for each in laid}
    below[wire.number] = _near_itself(at_mm, points, wire.diameter_mm)
    over = np.any(list(below.values()), axis=0)
    gap = round(ONE_PASS_DIAMETERS * wire.diameter_mm / STEP_MM)
    passes: list[tuple[int, int]] = []
    for first, last in runs(over):
        if passes and first - passes[-1][1] <= gap:
            passes[-1] = (passes[-1][0], last)
        else:
            passes.append((first, last))
    return tuple(
        Crossing(
            float(at_mm[first] + at_mm[last]) / 2,
            tuple(number for number, mask in below.items() if mask[first : last + 1].any()),
        )
        for first, last in passes
    )


def _stations(wire: Wire) -> tuple[FloatArray, FloatArray]:
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    return at_mm, wire.centreline.at(lengths.parameter(at_mm))


def _near(points: FloatArray, others: FloatArray, within_mm: float) -> FloatArray:
    from scipy.spatial import cKDTree

    distance, _ = cKDTree(others).query(points, distance_upper_bound=within_mm)
    return np.asarray(distance < within_mm)


def _near_itself(at_mm: FloatArray, points: FloatArray, within_mm: float) -> FloatArray:
    """Where the wire is near a place that it ran through before, farther back than it can help."""
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(within_mm, output_type="ndarray")
    earlier, later = pairs.min(axis=1), pairs.max(axis=1)
    apart = at_mm[later] - at_mm[earlier] > SELF_DIAMETERS * within_mm
    mask = np.zeros(len(points), bool)
    mask[later[apart]] = True
    return mask
