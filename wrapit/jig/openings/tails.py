"""Where the wires' tails go down: at the ends, or a little further out where that leaves more wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import FloatArray, unit
from wrapit.jig.channel import Channels
from wrapit.jig.openings.room import FOOT_MM
from wrapit.jig.wall_ground import FACE_STEP_MM, TOUCH_MM, face_probes

# How far out a hole may lie: the wire's end stays so far inside it (30 % up or down moves the
# walls' area by 0.1 % and the support by 0.002).
INSIDE_MM = 0.15
# Places that are tried, as shares of the furthest one; each end chooses beside the others' choices, so often.
SHARES = (1.0, 0.5, 0.0)
SWEEPS = 2


@dataclass(frozen=True, eq=False)
class Tail:
    """One end of a wire and the unit direction in which it goes on."""

    wire: str
    end: FloatArray
    outward: FloatArray


@dataclass(frozen=True, eq=False)
class Slot:
    """The middle line of a tail's hole, (2, 2); the first point is the centre of the round part."""

    wire: str
    line: FloatArray


def tail_slots(channels: Channels, diameter_mm: float, config: JigConfig) -> tuple[Slot, ...]:
    """A slot for each end of each wire, in the order of the wires.

    A hole is wider than the channel, so around the end itself it takes the foot of the walls there. It
    lies up to a radius further out, where the tail goes down anyway, if that leaves more wall to the
    turns, or as much and more to the stretches. One end after the other takes its best place beside the
    others; all begin at the ends themselves.
    """
    tails = [tail for wire in channels.wires for tail in _tails(wire.centreline.poles, wire.name)]
    faces = _faces(channels)
    furthest = max(0.0, diameter_mm / 2 - INSIDE_MM)
    choices = [[_line(tail, share * furthest, config.tail_slot) for share in SHARES] for tail in tails]
    taken = [[_taken(line, diameter_mm, faces) for line in lines] for lines in choices]
    chosen = [len(SHARES) - 1] * len(tails)
    for _ in range(SWEEPS):
        for index in range(len(tails)):
            others = [taken[i][chosen[i]] for i in range(len(tails)) if i != index]
            lost = [_counts(mine, others) for mine in taken[index]]
            chosen[index] = lost.index(min(lost))
    return tuple(
        Slot(tail.wire, lines[pick]) for tail, lines, pick in zip(tails, choices, chosen, strict=True)
    )


def _tails(poles: FloatArray, wire: str) -> list[Tail]:
    tails = []
    for end in (poles, poles[::-1]):
        apart = np.linalg.norm(end - end[0], axis=1)
        tails.append(Tail(wire, end[0], unit(end[0] - end[int(np.argmax(apart > 1e-6))])))
    return tails


def _line(tail: Tail, moved_mm: float, slot_mm: float) -> FloatArray:
    return tail.end + np.array([[moved_mm], [moved_mm + slot_mm]]) * tail.outward


def _faces(channels: Channels) -> tuple[Any, Any]:
    """Points along the walls' faces that no channel takes away: those of the turns, those of stretches."""
    import shapely

    kinds: tuple[list[FloatArray], list[FloatArray]] = ([np.empty((0, 2))], [np.empty((0, 2))])
    for turn in channels.turns:
        kinds[turn.stretch].append(face_probes(channels, turn, FACE_STEP_MM, TOUCH_MM))
    shapely.prepare(channels.area)
    points = [shapely.points(np.concatenate(kind)) for kind in kinds]
    turns, stretches = (each[~shapely.contains(channels.area, each)] for each in points)
    return turns, stretches


def _taken(line: FloatArray, diameter_mm: float, faces: tuple[Any, Any]) -> tuple[Any, Any]:
    """Which points of the walls' faces a hole takes away."""
    import shapely

    hole = shapely.LineString(line).buffer(diameter_mm / 2 + FOOT_MM)
    shapely.prepare(hole)
    return shapely.contains(hole, faces[0]), shapely.contains(hole, faces[1])


def _counts(mine: tuple[Any, Any], others: Sequence[tuple[Any, Any]]) -> tuple[int, int]:
    """How many points of turns and of stretches a hole takes that no other takes."""
    already = [np.any([other[kind] for other in others], axis=0) for kind in (0, 1)]
    return int((mine[0] & ~already[0]).sum()), int((mine[1] & ~already[1]).sum())
