"""Which places are bound, how much binding wire each takes, and in which order wires are laid."""

from __future__ import annotations

import math
from collections.abc import Sequence

from wrapit.instructions.model import Placement, Tie
from wrapit.wires.model import Wire

# Both tails of the binding wire, to hold and pull tight, 4 cm each.
TAILS_MM = 80.0


def binding_length_mm(frame_mm: float, binding_mm: float, turns: int, passes: int = 2) -> float:
    """Binding wire for one tie: n · (π(D + d) + 2(m − 1)D) + 80 mm around m parallel passes of frame wire.

    >>> round(binding_length_mm(1.0, 0.3, 5))
    110
    """
    around = math.pi * (frame_mm + binding_mm) + 2 * (passes - 1) * frame_mm
    return turns * around + TAILS_MM


def find_ties(wires: Sequence[Wire], binding_mm: float, turns: int) -> tuple[Tie, ...]:
    """One tie for each junction where wires meet, lettered in the order in which the wires reach them."""
    strands: dict[int, list[int]] = {}
    points: dict[int, tuple[float, float]] = {}
    for number, wire in enumerate(wires, start=1):
        for binding in wire.bindings:
            strands.setdefault(binding.junction, []).append(number)
            points.setdefault(binding.junction, binding.point)
    frame_mm = max((wire.diameter_mm for wire in wires), default=0.0)
    return tuple(
        Tie(
            letter=_letter(index),
            junction=junction,
            point=points[junction],
            wires=tuple(sorted(set(numbers))),
            passes=max(2, len(numbers)),
            binding_mm=binding_length_mm(frame_mm, binding_mm, turns, max(2, len(numbers))),
        )
        for index, (junction, numbers) in enumerate(strands.items())
    )


def assembly_order(wires: Sequence[Wire], ties: Sequence[Tie]) -> tuple[Placement, ...]:
    """The longest wire first, then always the one with most ties to those in place.

    Each tie is made as soon as its last wire lies; equal candidates go by their number.
    """
    waiting = list(range(1, len(wires) + 1))
    placed: list[int] = []
    placements = []
    while waiting:
        best = max(waiting, key=lambda number: (_joints(number, placed, ties), wires[number - 1].length_mm))
        waiting.remove(best)
        placed.append(best)
        ready = tuple(tie for tie in ties if best in tie.wires and set(tie.wires) <= set(placed))
        joins = {other for tie in ties if best in tie.wires for other in tie.wires if other in placed}
        placements.append(Placement(best, tuple(sorted(joins - {best})), ready))
    return tuple(placements)


def _joints(number: int, placed: Sequence[int], ties: Sequence[Tie]) -> int:
    return sum(number in tie.wires and any(other in placed for other in tie.wires) for tie in ties)


def _letter(index: int) -> str:
    """A … Z, AA, AB …"""
    text = ""
    index += 1
    while index:
        index, rest = divmod(index - 1, 26)
        text = chr(ord("A") + rest) + text
    return text
