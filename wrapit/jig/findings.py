"""What the maker should know about a jig: turns that it holds badly, and why it was split."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.jig.channel import Channels
from wrapit.jig.model import Pin, TurnSupport
from wrapit.jig.support import support_by_wire

# Turns with wall along less than this share are named: more of them is left to the hand than to the wall.
WEAK = 0.5


def support_findings(
    channels: Channels, pins: Iterable[Pin], support: Iterable[TurnSupport], config: JigConfig
) -> tuple[Finding, ...]:
    """A finding for each turn or long stretch that is held badly: a pin takes it, or what could be done."""
    pin_in = {pin.turn: pin for pin in pins}
    findings = []
    for one in support:
        where = channels.place(one.turn)
        if one.turn in pin_in:
            diameter = pin_in[one.turn].diameter_mm
            findings.append(
                Finding(
                    "note",
                    "pin",
                    where,
                    f"this turn is too tight for a wall; put a pin of {diameter:.1f} mm into its hole",
                    "bend the wire around the pin",
                )
            )
        elif one.share < WEAK and one.turn.stretch:
            findings.append(
                Finding(
                    "warning",
                    "weak-stretch",
                    where,
                    f"{one.share:.0%} of this long stretch has a wall on either side",
                    "keep it straight by hand, make the piece larger, or set jig.split to per-wire",
                    severity=1 - one.share,
                )
            )
        elif one.share < WEAK:
            findings.append(
                Finding(
                    "warning",
                    "weak-turn",
                    where,
                    f"{one.share:.0%} of this turn has a wall on the inside",
                    _remedy(channels, one, config),
                    severity=1 - one.share,
                )
            )
    return tuple(findings)


def unheld_findings(held: Iterable[TurnSupport], config: JigConfig) -> tuple[Finding, ...]:
    """An error for each wire most of whose turns nothing holds."""
    return tuple(
        Finding(
            "error",
            "unheld-wire",
            wire,
            f"the jig holds {share:.0%} of this wire's turns; the others are left to the hand",
            "make the piece larger, take thinner wire, or set jig.split to per-wire",
            severity=1 - share,
        )
        for wire, share in sorted(support_by_wire(held).items())
        if share < config.least_support
    )


def split_finding(shared: Mapping[str, float], jigs: int, wanted: float) -> Finding:
    """Says why there are several jigs."""
    weakest = min(shared, key=lambda name: (shared[name], name))
    return Finding(
        "note",
        "split",
        weakest,
        f"in one jig, other wires would leave it wall along {shared[weakest]:.0%} of its turns"
        f" (less than {wanted:.0%}), so there are {jigs} jigs",
        "set jig.split to single to get one all the same",
    )


def free_finding(wire: str) -> Finding:
    """Says why a wire is in no jig."""
    return Finding(
        "note",
        "no-jig",
        wire,
        "it has neither turns nor long stretches to hold, so it is in none of the jigs",
        "bend it by hand over the drawing, or set jig.split to single",
    )


def _remedy(channels: Channels, one: TurnSupport, config: JigConfig) -> str:
    bend = one.turn.max_curvature_per_mm
    if bend > 0 and 2 * (1 / bend - channels.reach_mm) < config.min_wall_width:
        return "bend it with round-nose pliers, make the piece larger, or use thinner wire"
    return "hold it by hand there, make the piece larger, or set jig.split to per-wire"
