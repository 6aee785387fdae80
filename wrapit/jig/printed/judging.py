"""An independent judge: the kernel cuts the finished jig with each wire as it is laid, and with its channel.

The jig is made without any boolean operation, from outlines that are checked in the plane; here the kernel's
own booleans say whether metal and jig, or the room that a wire needs and jig, have anything in common.
"""

from __future__ import annotations

import dataclasses

from wrapit.config import Config
from wrapit.errors import Finding, KernelError
from wrapit.jig.made import Made, Wires
from wrapit.wires.model import Wire

# How high over the plate is a wire held for that, in mm? Lying on it, both share what is only rounding: 1e-5
# to 1e-4 mm³ over three wires, as heights are right to 0.004 mm.
_OVER_PLATE_MM = 0.01
# By how much is a channel narrower than the wire with its clearance on both sides, in mm? Walls are right to
# 2.5e-4.
_WITHIN_MM = 1e-3
# What is nothing, in mm³? A cube with a side of a hundredth of a mm.
NOTHING_MM3 = 1e-6


def judged(made: Made, wires: Wires, config: Config) -> Made:
    """The jig with `interference_mm3` among its numbers, and a note for each wire that can't be judged.

    Raises KernelError where jig and wire, or jig and channel, have more than nothing in common.
    """
    assert made.handling is not None
    total, findings = 0.0, []
    jig_of = {wire.name: bench.name for bench in made.handling.benches for wire in bench.wires}
    for wire in wires:
        if wire.name not in jig_of:
            continue  # nothing of it is bent, or it is bent in another's place: no jig is made round it
        part = next(part for part in made.parts if part.name == jig_of[wire.name])
        base_mm = config.jig.base_thickness
        gap_mm = min(config.jig.inside_gap, config.jig.clearance)
        # The wire as it lies, over others too; and its channel, as a wire as thick as that along the plate.
        channel = dataclasses.replace(
            wire, diameter_mm=wire.diameter_mm + 2 * (gap_mm - _WITHIN_MM), lifts=()
        )
        for what, round_one in (("", wire), ("'s channel", channel)):
            shared = _common_mm3(part.solid, round_one, base_mm)
            if shared is None:
                findings.append(_not_judged(wire, what))
            elif shared > NOTHING_MM3:
                raise KernelError(
                    f"the finished jig and {wire.name}{what} have {shared:.2g} mm³ in common",
                    part.name,
                    "change the size or jig.clearance a little",
                )
            else:
                total += shared
    return dataclasses.replace(
        made,
        numbers={**made.numbers, "interference_mm3": round(total, 6)},
        findings=(*made.findings, *findings),
    )


def _common_mm3(jig: object, wire: Wire, base_mm: float) -> float | None:
    """What jig and wire share; None where the wire has no sound solid."""
    from wrapit.kernel.interference import common_mm3
    from wrapit.kernel.objects import FilePart, moved
    from wrapit.kernel.round_wires.sweeps import round_wire

    solid = round_wire(wire.centreline, wire.diameter_mm, wire.lifts, wire.name).solid
    if solid is None:
        return None
    up_mm = base_mm + wire.diameter_mm / 2 + _OVER_PLATE_MM
    lying = moved(FilePart(wire.name, solid, wire.colour), (0.0, 0.0, up_mm))
    return common_mm3(jig, lying.solid, wire.name)


def _not_judged(wire: Wire, what: str) -> Finding:
    return Finding(
        "note",
        "not-judged",
        wire.name,
        f"{wire.name}{what} bends more tightly than it is thick, so the kernel's booleans can't judge it",
        "make the piece larger if you want that proof",
    )
