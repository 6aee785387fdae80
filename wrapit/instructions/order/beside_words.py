"""Two runs side by side, told: on which side the second is laid, where the first leaves room for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from wrapit.pages.model import Length, Text, text
from wrapit.wires.mirror import OTHER_SIDE
from wrapit.wires.model import DoubleRun, Wire


def beside_said(wire: Wire, wires: Sequence[Wire], within: Callable[[float], bool]) -> Iterator[Text]:
    """A sentence for each doubled stretch that starts within a step.

    `wires` are those of the same jig: beside what is made elsewhere nothing lies, and nothing comes to lie.
    """
    numbers = {other.name: other.number for other in (*wires, wire)}
    for run in wire.doubles:
        if run.other in numbers and within(run.start_mm):
            yield text(
                "note-leave-room" if run.first else "note-beside",
                way=_way(wire, run),
                side=run.side if run.first else OTHER_SIDE[run.side],
                wire=numbers[run.other],
                start=Length(run.start_mm),
                end=Length(run.end_mm),
            )


def _way(wire: Wire, run: DoubleRun) -> str:
    """How the second run goes along the lines: back, once more, or as another wire."""
    if run.other != wire.name:
        return "other"
    return "back" if run.opposed else "again"
