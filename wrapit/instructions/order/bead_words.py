"""Beads as sentences: which to thread or to sew where, and which to have at hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Final

from wrapit.pages.model import Length, Table, Text, Thickness, text
from wrapit.wires.model import Wire, WireBead

# From a bead to the wire's end at most, where nothing but that end holds it: what fit leaves beyond a bead at
# the end of a line (2 mm and half a wire), and as much again where the line's end was drawn a little longer.
LAST_MM: Final = 5.0


def threading_said(wire: Wire, within: Callable[[float], bool]) -> Iterator[Text]:
    """What to thread before a stretch of a wire is bent, and what stays on by a loop of the wire's end."""
    for bead in wire.beads:
        if bead.threaded and within(bead.at_mm):
            yield text(
                "thread-bead",
                size=Thickness(bead.diameter_mm),
                wire=wire.number,
                at=Length(bead.at_mm),
            )
            if _is_last(wire, bead):
                yield text("bead-at-end")


def sewing_said(wire: Wire, within: Callable[[float], bool]) -> Iterator[Text]:
    """Beads that lie beside a stretch, to be sewn on later."""
    for bead in wire.beads:
        if not bead.threaded and within(bead.at_mm):
            side = "left" if bead.aside_mm > 0 else "right"
            yield text("sew-bead", size=Thickness(bead.diameter_mm), at=Length(bead.at_mm), side=side)


def beads_table(wires: Sequence[Wire], pieces: int) -> Iterator[Table]:
    """The beads of so many pieces by size, the largest first; no table without any."""
    counts = Counter(bead.diameter_mm for wire in wires for bead in wire.beads)
    if counts:
        rows = tuple(
            (text("thickness", value=Thickness(size_mm)), text("number", value=pieces * counts[size_mm]))
            for size_mm in sorted(counts, reverse=True)
        )
        yield Table(text("beads-table"), (text("beads-head-size"), text("beads-head-count")), rows)


def _is_last(wire: Wire, bead: WireBead) -> bool:
    """Whether one end of the wire is just behind a bead."""
    if wire.closed:
        return False
    return min(bead.at_mm, wire.length_mm - bead.at_mm) < bead.diameter_mm / 2 + LAST_MM
