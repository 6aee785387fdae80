"""Ties that hold two runs together between the junctions at their ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.model import Binding, DoubleRun, Wire

# Two runs are tied so often that none gapes: as long as a thumb is broad.
EVERY_MM = 20.0
# How finely the other run is looked at for the place beside.
STEP_MM = 0.1


def with_pair_ties(wires: Sequence[Wire], first_number: int) -> tuple[Wire, ...]:
    """The wires with a tie on every EVERY_MM of runs that lie side by side, spread evenly.

    Such a tie stands at no junction of the drawing; it is numbered on from `first_number` instead.
    """
    by_name = {wire.name: wire for wire in wires}
    added: dict[str, list[Binding]] = {wire.name: [] for wire in wires}
    number = first_number
    for wire in wires:
        for run in wire.doubles:
            if not run.first:
                continue
            other = by_name[run.other]
            for at_mm, beside_mm, point in _places(wire, run, other):
                added[wire.name].append(Binding(number, at_mm, (other.name,), point))
                added[other.name].append(Binding(number, beside_mm, (wire.name,), point))
                number += 1
    return tuple(
        replace(wire, bindings=tuple(sorted((*wire.bindings, *more), key=lambda tie: tie.at_mm)))
        if more
        else wire
        for wire, more in ((wire, added[wire.name]) for wire in wires)
    )


def _places(wire: Wire, run: DoubleRun, other: Wire) -> Iterator[tuple[float, float, tuple[float, float]]]:
    """Where a run is tied: on its own wire, on the other, and half way between."""
    count = int((run.end_mm - run.start_mm) // EVERY_MM)
    at_mm = np.linspace(run.start_mm, run.end_mm, count + 2)[1:-1]
    others_mm = np.concatenate(
        [
            np.arange(each.start_mm, each.end_mm, STEP_MM)
            for each in other.doubles
            if not each.first and each.other == wire.name
        ]
        or [np.empty(0)]
    )
    if not len(at_mm) or not len(others_mm):
        return
    points, cloud = _points(wire, at_mm), _points(other, others_mm)
    for own_mm, point in zip(at_mm.tolist(), points, strict=True):
        nearest = int(np.argmin(np.hypot(*(cloud - point).T)))
        x, y = ((point + cloud[nearest]) / 2).tolist()
        yield own_mm, float(others_mm[nearest]), (x, y)


def _points(wire: Wire, at_mm: FloatArray) -> FloatArray:
    return np.asarray(wire.centreline.at(ArcLength(wire.centreline).parameter(at_mm)))
