"""Where beads sit along the wires that run through them or past them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from wrapit.fit.model import Bead
from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.model import Wire, WireBead

# How finely a wire is looked at for the place nearest to a bead: a tenth of the step in which beads are sold.
STEP_MM = 0.05


def with_beads(wires: Sequence[Wire], beads: Sequence[Bead]) -> tuple[Wire, ...]:
    """The wires with these beads: each on the wire that runs along its segment, or beside the nearest.

    A segment that is run along twice has its bead on the first run.
    """
    strung: list[list[WireBead]] = [[] for _ in wires]
    for bead in beads:
        runs = [
            (index, span)
            for index, wire in enumerate(wires)
            for traversal, span in zip(wire.traversals, wire.segment_spans_mm, strict=True)
            if traversal.segment == bead.segment
        ][:1]
        spans = runs or [(index, (0.0, wire.length_mm)) for index, wire in enumerate(wires)]
        found = [(index, *_nearest(wires[index], bead.at, *span)) for index, span in spans]
        index, at_mm, aside_mm = min(found, key=lambda each: (round(abs(each[2]), 3), each[0]))
        strung[index].append(WireBead(at_mm, bead.diameter_mm, 0.0 if runs else aside_mm))
    return tuple(
        replace(wire, beads=tuple(sorted(own, key=lambda bead: bead.at_mm))) if own else wire
        for wire, own in zip(wires, strung, strict=True)
    )


def _nearest(wire: Wire, at: FloatArray, start_mm: float, end_mm: float) -> tuple[float, float]:
    """Where a span of a wire comes nearest to a place, and how far to its left that is."""
    lengths = ArcLength(wire.centreline)
    at_mm = np.linspace(start_mm, end_mm, max(2, 1 + round((end_mm - start_mm) / STEP_MM)))
    along = lengths.parameter(at_mm)
    apart = at - wire.centreline.at(along)
    k = int(np.argmin(np.round(np.linalg.norm(apart, axis=1), 6)))
    ahead = wire.centreline.derivative(along[k : k + 1])[0]
    side = float(np.sign(ahead[0] * apart[k, 1] - ahead[1] * apart[k, 0]))
    return float(at_mm[k]), side * float(np.linalg.norm(apart[k]))
