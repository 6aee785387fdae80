"""Wires of one shape: they can be bent on one form, a mirrored one is turned over afterwards."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.jig.model import SameShape
from wrapit.wires.model import Wire

# How far wires of one shape may lie apart, laid upon one another, in mm: a third of what walls let a wire
# stray by. Petals traced from a bitmap of 1000 px differ by a few hundredths.
APART_MM = 0.1
# In how many places they are compared: each few mm of a wire of 300 mm.
PLACES = 96


def same_shapes(wires: Sequence[Wire]) -> tuple[SameShape, ...]:
    """For each wire that has the shape of an earlier one: which, and whether mirrored; from either end.

    Wires differ where one has a bail and the other none; one with beads has a place of its own, with seats.
    """
    places = [_places(wire) for wire in wires]
    alike: list[SameShape] = []
    firsts: list[int] = []
    for index, wire in enumerate(wires):
        for first in firsts:
            way = _laid_upon(wires[first], places[first], wire, places[index])
            if way is not None:
                alike.append(SameShape(wire.name, wires[first].name, *way))
                break
        else:
            firsts.append(index)
    return tuple(alike)


def _places(wire: Wire) -> FloatArray:
    lengths = ArcLength(wire.centreline)
    points = wire.centreline.at(lengths.parameter(np.linspace(0.0, lengths.total_mm, PLACES)))
    return np.asarray(points - points.mean(axis=0))


def _laid_upon(first: Wire, there: FloatArray, wire: Wire, here: FloatArray) -> tuple[bool, bool] | None:
    """Whether the wire lies upon the first turned over, and end for end; None if it never does."""
    if first.beads or wire.beads:
        return None
    if abs(first.length_mm - wire.length_mm) > APART_MM or (first.bail is None) != (wire.bail is None):
        return None
    ways = [(False, here), (True, here[::-1])] if first.bail is None else [(False, here)]
    for mirrored in (False, True):
        flip = np.array([-1.0, 1.0]) if mirrored else np.ones(2)
        for backwards, way in ways:
            if _apart(there, way * flip) <= APART_MM:
                return mirrored, backwards
    return None


def _apart(there: FloatArray, here: FloatArray) -> float:
    """How far apart the farthest of these points (n, 2) lie once one line is turned upon the other."""
    dot, cross = (here * there).sum(), (here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]).sum()
    angle = np.arctan2(cross, dot)
    cos, sin = np.cos(angle), np.sin(angle)
    turned = np.column_stack([cos * here[:, 0] - sin * here[:, 1], sin * here[:, 0] + cos * here[:, 1]])
    return float(np.linalg.norm(turned - there, axis=1).max())
