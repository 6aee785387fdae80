"""Where a wire turns back to lie beside itself: a narrow loop, rounder than half a turn."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

from wrapit.wires.model import Side, Turn, Wire


@dataclass(frozen=True)
class Hairpin:
    """The end of a doubled stretch, from mm to mm along the wire, and the side to which it turns back."""

    start_mm: float
    end_mm: float
    side: Side

    @property
    def middle_mm(self) -> float:
        """Where it is turned by half."""
        return (self.start_mm + self.end_mm) / 2


def hairpins(wire: Wire) -> tuple[Hairpin, ...]:
    """Where a run ends and the next one comes back beside it, with no line of the drawing between them."""
    return tuple(
        Hairpin(out.end_mm, back.start_mm, out.side)
        for out, back in itertools.pairwise(wire.doubles)
        if out.other == back.other == wire.name
        and out.opposed
        and back.opposed
        and out.first
        and not back.first
        and not _line_between(wire, out.end_mm, back.start_mm)
    )


def is_hairpin(turn: Turn, wire: Wire) -> bool:
    """Whether a turn of the wire is the one of a hairpin."""
    return any(
        turn.inside == each.side and turn.start_mm < each.middle_mm < turn.end_mm for each in hairpins(wire)
    )


def _line_between(wire: Wire, start_mm: float, end_mm: float) -> bool:
    return any(start_mm <= low < high <= end_mm for low, high in wire.segment_spans_mm)
