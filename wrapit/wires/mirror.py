"""The mirror image of wires, for the other one of a pair of earrings."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Final

import numpy as np

from wrapit.geometry import BSpline
from wrapit.wires.model import JumpRing, Side, Wire

# What a mirror with a vertical axis does to sides and to coordinates.
OTHER_SIDE: Final[dict[Side, Side]] = {"left": "right", "right": "left"}
_FLIP = np.array([-1.0, 1.0])


def mirrored(wires: Sequence[Wire]) -> tuple[Wire, ...]:
    """The wires with left and right exchanged (x → −x); lengths, heights and connections stay.

    Traversals still name the segments of the drawing, which is not mirrored.
    """
    return tuple(_mirrored(wire) for wire in wires)


def mirrored_ring(ring: JumpRing | None) -> JumpRing | None:
    """The jump ring in the mirror image."""
    if ring is None:
        return None
    return dataclasses.replace(ring, point=flipped(ring.point), outward=flipped(ring.outward))


def _mirrored(wire: Wire) -> Wire:
    line = wire.centreline
    return dataclasses.replace(
        wire,
        centreline=BSpline(line.degree, line.poles * _FLIP, line.knots),
        bail=wire.bail and dataclasses.replace(wire.bail, centre=flipped(wire.bail.centre)),
        turns=tuple(dataclasses.replace(turn, inside=OTHER_SIDE[turn.inside]) for turn in wire.turns),
        bindings=tuple(
            dataclasses.replace(binding, point=flipped(binding.point)) for binding in wire.bindings
        ),
        doubles=tuple(dataclasses.replace(run, side=OTHER_SIDE[run.side]) for run in wire.doubles),
        beads=tuple(dataclasses.replace(bead, aside_mm=-bead.aside_mm) for bead in wire.beads),
    )


def flipped(point: tuple[float, float]) -> tuple[float, float]:
    """A point with x → −x."""
    return -point[0], point[1]
