"""Wires as the jig has to bend them, so that they spring back to the drawing when they are let go."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.config import Config, JigConfig
from wrapit.errors import Finding
from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.recurving import best_fit, recurved
from wrapit.materials import METALS
from wrapit.wires.model import Wire
from wrapit.wires.stacking import lay_wires, layers_of
from wrapit.wires.turns import find_turns

# How closely a wire is compared with itself let go, of which the worst place is told to 0.01 mm.
STEP_MM = 0.1
STRAIGHT = 0.2  # wires bent by less than this share of the loss count as nearly straight


@dataclass(frozen=True, eq=False)
class Overbent:
    """A wire as it lies in its jig, bent further than it is drawn.

    `overbend_rad` is how much further, all bends together; `moved_mm` how far it lies from where it is
    drawn at most, `residual_mm` how far the wire that is let go does (both after the best turn and shift).
    """

    wire: Wire
    overbend_rad: float
    moved_mm: float
    residual_mm: float


def overbend_wires(wires: Sequence[Wire], config: Config) -> tuple[tuple[Overbent, ...], tuple[Finding, ...]]:
    """Each wire overbent by what its metal springs back, alone: overbent wires don't meet as drawn."""
    loss = METALS[config.wire.metal].springback_per_mm(config.wire.gauge, config.wire.temper)
    bent = tuple(overbend(wire, loss, config.jig) for wire in wires)
    return bent, tuple(_finding(each) for each in bent)


def overbend(wire: Wire, loss_per_mm: float, config: JigConfig) -> Overbent:
    """The wire with curvature κ + sign(κ) · loss, which κ_after = κ_bend − loss turns into κ again.

    Next to straight, the loss is added in proportion, so that the course has no jumps.
    """
    drawn = wire.centreline
    bent = recurved(drawn, lambda k: np.clip(k / STRAIGHT, -loss_per_mm, loss_per_mm))
    fit = best_fit(*_side_by_side(bent, drawn))
    bent = fit.moved(bent)
    (lifts,) = lay_wires([bent], wire.diameter_mm)
    laid = dataclasses.replace(
        wire,
        centreline=bent,
        turns=find_turns(wire.name, bent, config)[0],
        lifts=lifts,
        layers=layers_of(lifts, wire.diameter_mm),
    )
    return Overbent(
        wire=laid,
        overbend_rad=_added(drawn, loss_per_mm),
        moved_mm=fit.apart_mm,
        residual_mm=best_fit(*_side_by_side(released(bent, loss_per_mm), drawn)).apart_mm,
    )


def released(spline: BSpline, loss_per_mm: float) -> BSpline:
    """What becomes of a bent wire that is let go: it loses curvature, all of it where it has no more."""
    return recurved(spline, lambda k: -np.clip(k, -loss_per_mm, loss_per_mm))


def _added(drawn: BSpline, loss_per_mm: float) -> float:
    lengths = ArcLength(drawn)
    at_mm = lengths.stations(STEP_MM)
    curvature = drawn.curvature(lengths.parameter((at_mm[:-1] + at_mm[1:]) / 2))
    return float((np.minimum(np.abs(curvature) / STRAIGHT, loss_per_mm) * np.diff(at_mm)).sum())


def _side_by_side(first: BSpline, second: BSpline) -> tuple[FloatArray, FloatArray]:
    """Points of both curves at the same lengths along them."""
    lengths = [ArcLength(first), ArcLength(second)]
    count = len(lengths[1].stations(STEP_MM))
    points = [
        curve.at(along.parameter(np.linspace(0.0, along.total_mm, count)))
        for curve, along in zip((first, second), lengths, strict=True)
    ]
    return points[0], points[1]


def _finding(bent: Overbent) -> Finding:
    return Finding(
        "note",
        "springback",
        bent.wire.name,
        f"its jig bends it {math.degrees(bent.overbend_rad):.0f}° further than drawn, all bends together;"
        f" there it lies up to {bent.moved_mm:.1f} mm beside the drawing,"
        f" and let go it springs back to within {bent.residual_mm:.2f} mm of it",
        "bend it in its own jig, and let go before you lay it beside the others",
    )
