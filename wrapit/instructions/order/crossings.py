"""Where a wire passes over what already lies in the jig: wires laid before it, and its own earlier course."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.arrays import IntArray, runs
from wrapit.instructions.model import Crossing
from wrapit.wires.beside.pairs import side_by_side
from wrapit.wires.model import DoubleRun, Wire
from wrapit.wires.nearness import Neighbours
from wrapit.wires.stacking import SELF_DIAMETERS, STEP_MM

# Two passes this near each other along the wire are one to the hand: it lies on the others all the while.
ONE_PASS_DIAMETERS: Final = 2.0


def crossings_in(wires: Sequence[Wire]) -> tuple[tuple[Crossing, ...], ...]:
    """For each wire in the order of laying, where it is nearer than a diameter to what lies there already.

    All have one diameter.
    """
    stations = [_stations(wire) for wire in wires]
    cloud = Neighbours.of(np.concatenate([points for _, points in stations]), wires[0].diameter_mm)
    at_mm = np.concatenate([places for places, _ in stations])
    owner = np.repeat([wire.number for wire in wires], [len(places) for places, _ in stations])
    doubles = {wire.number: wire.doubles for wire in wires}
    found, first = [], 0
    for wire, (places, _) in zip(wires, stations, strict=True):
        laid = slice(first, first + len(places))
        found.append(_crossings(wire, doubles, cloud, laid, at_mm, owner))
        first = laid.stop
    return tuple(found)


def _crossings(
    wire: Wire,
    doubles: Mapping[int, Sequence[DoubleRun]],
    cloud: Neighbours,
    laid: slice,
    at_mm: FloatArray,
    owner: IntArray,
) -> tuple[Crossing, ...]:
    below: dict[int, set[int]] = {}
    for near in cloud.before(laid):
        own = owner[near.earlier] == wire.number
        apart = at_mm[near.later] - at_mm[near.earlier] > SELF_DIAMETERS * wire.diameter_mm
        beside = side_by_side(wire.number, near, at_mm, owner, doubles, wire.diameter_mm)
        over_it = (~own | apart) & ~beside
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


def _stations(wire: Wire) -> tuple[FloatArray, FloatArray]:
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    return at_mm, wire.centreline.at(lengths.parameter(at_mm))
