"""The printed jig's part of the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.jig.made import reported
from wrapit.jig.model import SEEN_MM, Course, Jig, JigSet, TurnSupport
from wrapit.jig.support import held_share, really_held, stretch_support, total_support
from wrapit.jig.taut.deviation import largest_within
from wrapit.wires.model import Turn, Wire


def jig_numbers(jigs: JigSet, wires: Sequence[Wire]) -> dict[str, Any]:
    """The `jig` block, over all jigs of the piece."""
    support = [each for jig in jigs.jigs for each in jig.support]
    by_wire = {
        wire.name: round(total_support(each for each in support if each.turn.wire == wire.name), 4)
        for wire in wires
    }
    weakest = min(by_wire, key=lambda name: (by_wire[name], name))
    distances = [jig.min_wall_to_wire_mm for jig in jigs.jigs if jig.min_wall_to_wire_mm is not None]
    seats = sum(len(jig.plan.seats) for jig in jigs.jigs)
    return {
        "kind": "printed",
        "split": jigs.split,
        "jigs": len(jigs.jigs),
        "solids": sum(jig.solids for jig in jigs.jigs),
        "valid": all(jig.valid for jig in jigs.jigs),
        "volume_mm3": round(sum(jig.volume_mm3 for jig in jigs.jigs), 3),
        "walls": sum(len(jig.walls) for jig in jigs.jigs),
        "holes": sum(len(jig.plan.holes) for jig in jigs.jigs),
        **({"seats": seats} if seats else {}),
        "turn_support": round(total_support(support), 4),
        "turn_support_by_wire": by_wire,
        "weakest": {"wire": weakest, "turn_support": by_wire[weakest]},
        "held": round(held_share(_held(jigs)), 4),
        "stretch_support": round(stretch_support(support), 4),
        "turns": [_turn_numbers(jig, each) for jig in jigs.jigs for each in jig.support],
        "taut": taut_numbers([course for jig in jigs.jigs for course in jig.plan.laid]),
        "channel_share": round(_hemmed(jigs), 4),
        "forms": _forms(jigs),
        "min_wall_to_wire_mm": round(min(distances), 6) if distances else None,
        "size_mm": [reported(max(jig.size_mm[axis] for jig in jigs.jigs)) for axis in range(3)],
    }


def _strays(turn: Turn, laid: Sequence[Course]) -> float:
    """The furthest that a turn's wire lies off, laid under tension."""
    course = next(course for course in laid if course.wire == turn.wire)
    span_mm = np.array([[turn.start_mm, turn.end_mm]])
    return float(largest_within(course.off_mm, course.at_mm, span_mm)[0])


def _held(jigs: JigSet) -> list[TurnSupport]:
    """What is held in the end: by walls, by pins, or because the taut wire keeps to the drawing."""
    return [one for jig in jigs.jigs for one in really_held(jig.support, jig.plan.pins, jig.plan.laid)]


def taut_numbers(laid: Sequence[Course]) -> dict[str, Any]:
    """How far wires laid under tension lie off the drawing."""
    off_mm = np.concatenate([course.off_mm for course in laid])
    return {
        "p95_mm": reported(np.quantile(off_mm, 0.95)),
        "max_mm": reported(off_mm.max()),
        "share_over_half_mm": round(float((off_mm > SEEN_MM).mean()), 4),
        "by_wire": {
            course.wire: {
                "p95_mm": reported(np.quantile(course.off_mm, 0.95)),
                "max_mm": reported(course.off_mm.max()),
                "share_over_half_mm": round(course.share_off, 4),
            }
            for course in laid
        },
    }


def _hemmed(jigs: JigSet) -> float:
    lengths = [sum(float(course.at_mm[-1]) for course in jig.plan.laid) for jig in jigs.jigs]
    return sum(jig.hemmed * mm for jig, mm in zip(jigs.jigs, lengths, strict=True)) / sum(lengths)


def _forms(jigs: JigSet) -> list[dict[str, Any]]:
    """Forms that serve several wires, each with its own wire first."""
    forms = []
    for jig in jigs.jigs:
        for wire in jig.wires:
            others = [[form.wire, form.mirrored] for form in jigs.forms if form.like == wire]
            if others:
                forms.append({"jig": jig.name, "wires": [[wire, False], *others]})
    return forms


def _turn_numbers(jig: Jig, support: TurnSupport) -> dict[str, Any]:
    turn = support.turn
    pin = next((pin.diameter_mm for pin in jig.plan.pins if pin.turn == turn), None)
    bend = turn.max_curvature_per_mm
    return {
        "wire": turn.wire,
        "from_mm": reported(turn.start_mm),
        "to_mm": reported(turn.end_mm),
        "inside": turn.inside,
        "min_radius_mm": reported(1 / bend) if bend > 0 else None,
        "support": round(support.share, 4),
        "taut_mm": reported(_strays(turn, jig.plan.laid)),
        "pin_mm": pin,
    }
