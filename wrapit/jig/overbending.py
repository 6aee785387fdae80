"""Jigs that make up for springback: how far each wire is bent further, and what it is once it is let go.

A wire under tension lies on its walls and is straight between them. So it springs back along walls alone, and
there alone it is bent further than drawn; how near it comes to the drawing is told of the taut wire.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.geometry.arrays import runs
from wrapit.geometry.polyline import evenly
from wrapit.geometry.recurving import best_fit
from wrapit.jig.openings.pins import pin_discs
from wrapit.jig.paired.no_room import refuse_bent_further
from wrapit.jig.walls_and_pins import StandingWalls, standing_walls
from wrapit.jig.wrapping.let_go import Bends
from wrapit.materials import METALS
from wrapit.wires.model import Wire
from wrapit.wires.springback import Overbent, overbend

# Distances from a drawn place to the taut wire agree so far: a hundredth of the tolerance for straying.
NEAR_MM = 3e-3


def overbend_wires(wires: Sequence[Wire], config: Config) -> tuple[tuple[Overbent, ...], tuple[Finding, ...]]:
    """Each wire overbent by what its metal springs back, alone: overbent wires don't meet as drawn.

    Raises JigError where a wire comes to lie beside itself.
    """
    refuse_bent_further(wires)
    loss = METALS[config.wire.metal].springback_per_mm(config.wire.gauge, config.wire.temper)
    bent = tuple(_overbent(wire, loss, config) for wire in wires)
    return bent, tuple(_finding(each) for each in bent)


def _overbent(wire: Wire, loss_per_mm: float, config: Config) -> Overbent:
    walls = standing_walls((wire,), config.jig)
    bent = overbend(wire, loss_per_mm, config.jig, _held_mm(walls))
    (bends,) = bends_round(standing_walls((bent.wire,), config.jig))
    free, drawn = bends.let_go(loss_per_mm), walls.plan.laid[0].drawn
    apart_mm = best_fit(evenly(free, len(drawn)), evenly(drawn, len(drawn))).apart_mm
    return dataclasses.replace(bent, residual_mm=apart_mm)


def _held_mm(walls: StandingWalls) -> list[tuple[float, float]]:
    """Stretches of a wire, alone in its jig, that lie on a wall or a pin when it is taut."""
    import shapely

    (course,), (bends,) = walls.plan.laid, bends_round(walls)
    lying = np.stack([bends.points[:-1], bends.points[1:]], axis=1)[bends.lies_mm > 0]
    if not len(lying):
        return []
    # The taut wire passes each drawn place at `off_mm`: on a wall, if a step that lies on one is as near.
    apart_mm = shapely.distance(shapely.points(course.drawn), shapely.multilinestrings(lying))
    last_mm, half = float(course.at_mm[-1]), float(course.at_mm[1]) / 2
    return [
        (max(0.0, float(course.at_mm[a]) - half), min(last_mm, float(course.at_mm[b]) + half))
        for a, b in runs(apart_mm <= course.off_mm + NEAR_MM)
    ]


def bends_round(walls: StandingWalls) -> tuple[Bends, ...]:
    """The bends of each wire round walls and pins, in the order of the courses."""
    stand = [*(polygon for polygon, _ in walls.plan.polygons), *pin_discs(walls.plan.pins)]
    return tuple(Bends.of(course, stand, walls.channels.diameter_mm) for course in walls.plan.laid)


def loose_ends(walls: StandingWalls, config: Config) -> tuple[Finding, ...]:
    """A note for each wire whose end springs off its last wall, past its hole, before it is in there."""
    loss = METALS[config.wire.metal].springback_per_mm(config.wire.gauge, config.wire.temper)
    findings = []
    for course, bends in zip(walls.plan.laid, bends_round(walls), strict=True):
        moved_mm = bends.end_moves_mm(loss)
        if moved_mm > max(hole.diameter_mm for hole in walls.plan.holes if course.wire in hole.wires) / 2:
            findings.append(
                Finding(
                    "note",
                    "loose-end",
                    f"{course.wire} at {course.at_mm[-1]:.0f} mm",
                    f"let go after its last wall, its end springs {moved_mm:.1f} mm aside, past its hole",
                    "hold the end with pliers until it is bent down into its hole",
                    severity=moved_mm,
                    wire=course.wire,
                    places_mm=(float(course.at_mm[-1]),),
                )
            )
    return tuple(findings)


def _finding(bent: Overbent) -> Finding:
    return Finding(
        "note",
        "springback",
        bent.wire.name,
        f"its jig bends it {math.degrees(bent.overbend_rad):.0f}° further than drawn, all bends together;"
        f" there it lies up to {bent.moved_mm:.1f} mm beside the drawing,"
        f" and wrapped tight and let go it springs back to within {bent.residual_mm:.2f} mm of it",
        "bend it in its own jig, and let go before you lay it beside the others",
    )
