"""Which places are bound, how much binding wire each takes, and in which order wires are laid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from wrapit.instructions.model import Tie
from wrapit.wires.model import Wire


@dataclass(frozen=True)
class Placement:
    """One stage of the assembly: lay these wires, which meet those that lie there, then make these ties."""

    wires: tuple[int, ...]
    joins: tuple[int, ...]
    ties: tuple[Tie, ...]


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


def assembly_order(groups: Sequence[Sequence[Wire]], ties: Sequence[Tie]) -> tuple[Placement, ...]:
    """The group with the longest wire first, then always the one with most ties to those in place.

    A group is what comes out of a jig at once. Each tie is made as soon as its last wire lies; equal
    candidates go by their longest wire, then by their order.
    """
    waiting = list(groups)
    placed: set[int] = set()
    placements = []
    while waiting:
        best = max(waiting, key=lambda group: (_joints(group, placed, ties), max(w.length_mm for w in group)))
        waiting.remove(best)
        mine = {wire.number for wire in best}
        before = frozenset(placed)
        placed |= mine
        ready = tuple(tie for tie in ties if mine & set(tie.wires) and set(tie.wires) <= placed)
        joins = {other for tie in ties if mine & set(tie.wires) for other in tie.wires if other in before}
        placements.append(Placement(tuple(sorted(mine)), tuple(sorted(joins)), ready))
    return tuple(placements)


def _joints(group: Sequence[Wire], placed: set[int], ties: Sequence[Tie]) -> int:
    mine = {wire.number for wire in group}
    return sum(bool(mine & set(tie.wires)) and bool(placed & set(tie.wires)) for tie in ties)


def _letter(index: int) -> str:
    """A … Z, AA, AB …"""
    text = ""
    index += 1
    while index:
        index, rest = divmod(index - 1, 26)
        text = chr(ord("A") + rest) + text
    return text
