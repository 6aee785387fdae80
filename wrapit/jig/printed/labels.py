"""Each wire's number beside the hole where it starts, on free plate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from wrapit.errors import Finding
from wrapit.jig.channel import Channels
from wrapit.jig.model import Label
from wrapit.jig.printed.digits import number_polygon
from wrapit.jig.printed.smoothed import ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM, smoothed

# How a number is engraved: as large as there is room for, in a line that a nozzle of 0.4 mm leaves open, two
# layers of 0.2 mm deep.
HEIGHTS_MM = (4.0, 3.2, 2.5)
STROKE_MM = 0.6
DEPTH_MM = 0.4
# Plate that stays between a number and whatever else there is, and around all at the plate's edge.
GAP_MM = 0.4
EDGE_MM = 1.0
# Where places are tried: on rings round the start, nearer ones first, up to 17 mm off. With rings up to 13 mm
# one of the mandala's sixteen numbers finds no room, up to 9 mm two of the lotus's five; all other changes of
# these by 30 %, and of GAP, leave all numbers of butterfly, dolphin, leaf and lotus on their plates.
RING_STEP_MM = 1.0
RINGS = 18
DIRECTIONS = 16


def wire_labels(
    channels: Channels, taken: Any, plate: Any, most_depth_mm: float
) -> tuple[tuple[Label, ...], tuple[Finding, ...]]:
    """A label for each wire, as near to its start as there is room beside what is `taken`.

    Places beside the wires are preferred to places under them. A wire without room gets a finding.
    """
    import shapely

    room = plate.buffer(-EDGE_MM)
    under = shapely.union_all([taken, channels.area])
    shapely.prepare(room)
    depth = min(DEPTH_MM, most_depth_mm)
    labels, missing = [], []
    for wire in channels.wires:
        spot = _spot(wire.number, tuple(wire.ends[0].tolist()), room, (under, taken))
        if spot is None:
            missing.append(wire.name)
            continue
        grown = spot.buffer(GAP_MM)
        strokes = tuple(
            smoothed(part, grown, ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM) for part in shapely.get_parts(spot)
        )
        labels.append(Label(str(wire.number), strokes, depth))
        taken, under = taken.union(grown), under.union(grown)
    findings: list[Finding] = []
    if missing:
        findings.append(
            Finding("note", "no-room-for-number", ", ".join(missing), "there is no free plate for its number")
        )
    return tuple(labels), tuple(findings)


def _spot(number: int, start: tuple[float, float], room: Any, blocked: Sequence[Any]) -> Any:
    import shapely

    for obstacle in blocked:
        for height in HEIGHTS_MM:
            glyph = number_polygon(number, height, STROKE_MM)
            frame = shapely.box(*glyph.bounds).buffer(GAP_MM, join_style="mitre")
            shapely.prepare(obstacle)
            for ring in range(2, RINGS):
                for step in range(DIRECTIONS):
                    # Start below the hole, where a label reads most naturally, then go round.
                    angle = -math.pi / 2 + 2 * math.pi * step / DIRECTIONS
                    x = start[0] + ring * RING_STEP_MM * math.cos(angle)
                    y = start[1] + ring * RING_STEP_MM * math.sin(angle)
                    here = shapely.affinity.translate(frame, x, y)
                    if room.contains(here) and not obstacle.intersects(here):
                        return shapely.affinity.translate(glyph, x, y)
    return None
