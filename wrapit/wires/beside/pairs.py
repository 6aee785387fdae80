"""Which places that are near one another lie beside one another, in two runs along the same lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from wrapit.decomposition.json_file import wire_name
from wrapit.geometry import FloatArray
from wrapit.geometry.arrays import IntArray
from wrapit.wires.model import DoubleRun
from wrapit.wires.nearness import Near

# Runs side by side are a diameter apart but for what curves are fitted to; one that passes over the other
# comes nearer than this.
BESIDE_DIAMETERS: Final = 0.9
# So far (mm) beyond the ends of a double run are still of it: a station of both, which are 0.1 mm apart.
AT_ENDS_MM: Final = 0.1


def side_by_side(
    number: int,
    near: Near,
    at_mm: FloatArray,
    owner: IntArray,
    doubles: Mapping[int, Sequence[DoubleRun]],
    diameter_mm: float,
) -> NDArray[np.bool_]:
    """Which of the pairs (k,), whose later places are of the wire `number`, lie beside one another.

    `at_mm` (n,) and `owner` (n,) are place and wire number of every station, `doubles` those of each wire.
    """
    beside = np.zeros(len(near.later), bool)
    for other, theirs in doubles.items():
        if any(run.other == wire_name(other - 1) for run in doubles[number]):
            beside |= (
                (owner[near.earlier] == other)
                & _doubled(doubles[number], other, at_mm[near.later])
                & _doubled(theirs, number, at_mm[near.earlier])
            )
    return beside & (near.apart2 >= (BESIDE_DIAMETERS * diameter_mm) ** 2)


def _doubled(doubles: Sequence[DoubleRun], other: int, at_mm: FloatArray) -> NDArray[np.bool_]:
    """Which places (k,) lie where a run of the other wire is beside, a step more or less."""
    spans = [
        (run.start_mm - AT_ENDS_MM, run.end_mm + AT_ENDS_MM)
        for run in doubles
        if run.other == wire_name(other - 1)
    ]
    if not spans:
        return np.zeros(len(at_mm), bool)
    return np.any([(at_mm >= start) & (at_mm <= end) for start, end in spans], axis=0)
