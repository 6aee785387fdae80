"""The room that beads on wires and beside them take up: nothing of any jig stands there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from wrapit.jig.openings.room import FOOT_MM
from wrapit.wires.model import Wire


def bead_obstacles(wires: Sequence[Wire], clearance_mm: float) -> Any:
    """Where no wall, pin or peg may stand because of the wires' beads, as shapely geometry."""
    import shapely

    return shapely.union_all(
        [
            shapely.Point(place).buffer(bead.diameter_mm / 2 + clearance_mm + FOOT_MM, quad_segs=32)
            for wire in wires
            for bead, place in zip(wire.beads, wire.bead_places, strict=True)
        ]
    )
