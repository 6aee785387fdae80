"""Free ground beside wires that need no wall there: where fingers go."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from wrapit.jig.channel import SIDES, Channels
from wrapit.jig.paired.leaning import beside_mm
from wrapit.jig.wrapping.passage import beside
from wrapit.wires.model import Side, Turn, Wire

# How finely free ground is laid: its edge is where fingers go, not where a wire lies.
STEP_MM = 0.5
# Free ground ends this far from a wall's own ends, so that it doesn't cut into them where the wire bends.
APART_MM = 1.0
# How many bands are remembered from one round of planning to the next: those of the largest piece.
_REMEMBERED = 4000


def free_sides(channels: Channels, held: Iterable[Turn], room_mm: float) -> Any:
    """The ground within `room_mm` beyond the channel, on each side of each wire where no span is held."""
    import shapely

    sides: tuple[Side, Side] = ("left", "right")
    spans = list(held)
    bands = [
        _band(channels, Turn(wire.name, start, end, side, 0.0), room_mm)
        for wire in channels.wires
        for side in sides
        for start, end in _loose(wire, side, spans, beside_mm(wire, channels.wires, side))
    ]
    return shapely.union_all(bands)


def _loose(
    wire: Wire, side: Side, held: Iterable[Turn], others: Iterable[tuple[float, float]]
) -> list[tuple[float, float]]:
    """Where nothing is held on a side of a wire, and no other run lies there, from mm to mm."""
    walls = ((span.start_mm, span.end_mm) for span in held if (span.wire, span.inside) == (wire.name, side))
    taken = sorted([*walls, *others])
    loose, at_mm = [], 0.0
    for start, end in [*taken, (wire.length_mm, wire.length_mm)]:
        low = at_mm + APART_MM if at_mm > 0 else 0.0
        high = start - APART_MM if start < wire.length_mm else start
        if high > low + STEP_MM:
            loose.append((low, high))
        at_mm = max(at_mm, end)
    return loose


@lru_cache(_REMEMBERED)
def _band(channels: Channels, span: Turn, room_mm: float) -> Any:
    _, points, normals, _ = channels.stations(span, STEP_MM)
    reach = channels.reach_mm
    return beside(points, normals, SIDES[span.inside], reach, reach + room_mm)
