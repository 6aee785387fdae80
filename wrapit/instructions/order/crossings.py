"""Where a wire passes over what already lies in the jig: wires laid before it, and its own earlier course."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import runs
from wrapit.instructions.model import Crossing
from wrapit.wires.model import Wire
from wrapit.wires.nearness import Near, Neighbours
from wrapit.wires.stacking import SELF_DIAMETERS, STEP_MM

# Two passes this near each other along the wire are one to the hand: it lies on the others all the while.
ONE_PASS_DIAMETERS: Final = 2.0
# Runs side by side are a diameter apart but for what curves are fitted to; one that passes over the other
# comes nearer than this.
BESIDE_DIAMETERS: Final = 0.9


def crossings_in(wires: Sequence[Wire]) -> tuple[tuple[Crossing, ...], ...]:
    """For each wire in the order of laying, where it is nearer than a diameter to what lies there already.

    All have one diameter.
    """
    stations = [_stations(wire) for wire in wires]
    cloud = Neighbours.of(np.concatenate([points for _, points in stations]), wires[0].diameter_mm)
    at_mm = np.concatenate([places for places, _ in stations])
    owner = np.repeat([wire.number for wire in wires], [len(places) for places, _ in stations])
    found, first = [], 0
    for wire, (places, _) in zip(wires, stations, strict=True):
        laid = slice(first, first + len(places))
        found.append(_crossings(wire, wires, cloud, laid, at_mm, owner))
        first = laid.stop
    return tuple(found)


def _crossings(
    wire: Wire, wires: Sequence[Wire], cloud: Neighbours, laid: slice, at_mm: FloatArray, owner: FloatArray
) -> tuple[Crossing, ...]:
    below: dict[int, set[int]] = {}
    for near in cloud.before(laid):
        own = owner[near.earlier] == wire.number
        apart = at_mm[near.later] - at_mm[near.earlier] > SELF_DIAMETERS * wire.diameter_mm
        over_it = (~own | apart) & ~_side_by_side(wire, wires, near, at_mm, owner)
        for later, earlier in zip(near.later[over_it], near.earlier[over_it], strict=True):
            below.setdefault(int(later) - laid.start, set()).add(int(owner[earlier]))
    places = at_mm[laid]
    over = np.zeros(len(places), bool)
    over[list(below)] = True
    gap = round(ONE_PASS_DIAMETERS * wire.diameter_mm / STEP_MM)
    passes: list[tuple[int, int]] = []
    for first, last in runs(over):
        if passes and first - passes[-1][1] <= gap:
            passes[-1] = (passes[-1][0], last)
        else:
            passes.append((first, last))
    return tuple(
        Crossing(
            float(places[first] + places[last]) / 2,
            tuple(sorted(set().union(*(below.get(each, set()) for each in range(first, last + 1))))),
        )
        for first, last in passes
    )


def _side_by_side(
    wire: Wire, wires: Sequence[Wire], near: Near, at_mm: FloatArray, owner: FloatArray
) -> NDArray[np.bool_]:
    """Which of these pairs of places (k,) lie beside one another in two runs along the same lines."""
    beside = np.zeros(len(near.later), bool)
    for other in wires:
        if any(run.other == other.name for run in wire.doubles):
            beside |= (
                (owner[near.earlier] == other.number)
                & _doubled(wire, other, at_mm[near.later])
                & _doubled(other, wire, at_mm[near.earlier])
            )
    return beside & (near.apart2 >= (BESIDE_DIAMETERS * wire.diameter_mm) ** 2)


def _doubled(wire: Wire, other: Wire, at_mm: FloatArray) -> NDArray[np.bool_]:
    """Which places (k,) along a wire lie where a run of the other is beside it, a step more or less."""
    runs = [run for run in wire.doubles if run.other == other.name]
    spans = [(run.start_mm - STEP_MM, run.end_mm + STEP_MM) for run in runs]
    return np.any([(at_mm >= start) & (at_mm <= end) for start, end in spans], axis=0)


def _stations(wire: Wire) -> tuple[FloatArray, FloatArray]:
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    return at_mm, wire.centreline.at(lengths.parameter(at_mm))
