"""What can't be made where two runs lie side by side: beads between them, and springing back made up for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from wrapit.errors import Finding, JigError
from wrapit.wires.model import Wire


def bead_findings(wires: Iterable[Wire]) -> Iterator[Finding]:
    """A warning for each bead that is where another run lies close beside its wire."""
    for wire in wires:
        for bead in wire.beads:
            side = "left" if bead.aside_mm > 0 else "right"
            if any(
                run.start_mm <= bead.at_mm <= run.end_mm and (bead.threaded or run.side == side)
                for run in wire.doubles
            ):
                yield Finding(
                    "warning",
                    "bead-between-runs",
                    f"{wire.name} at {bead.at_mm:.0f} mm",
                    f"another run lies close beside the wire, where the bead of {bead.diameter_mm:g} mm is",
                    "move the bead to where the wire runs alone, or bend the other run round it by hand",
                    wire=wire.name,
                    places_mm=(bead.at_mm,),
                )


def refuse_bent_further(wires: Sequence[Wire]) -> None:
    """Raises JigError where a wire that is to be bent further lies beside itself: it wouldn't any more."""
    beside = [wire.name for wire in wires if any(run.other == wire.name for run in wire.doubles)]
    if beside:
        raise JigError(
            f"{', '.join(beside)} comes to lie beside itself; bent further, its two runs would not fit",
            "jig.springback",
            "set jig.springback to report",
        )
