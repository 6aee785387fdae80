"""Wires as the jig has to bend them, so that they spring back to the drawing when they are let go."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.recurving import best_fit, recurved
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


def overbend(
    wire: Wire, loss_per_mm: float, config: JigConfig, held_mm: Sequence[tuple[float, float]] | None = None
) -> Overbent:
    """The wire with curvature κ + sign(κ) · loss, which κ_after = κ_bend − loss turns into κ again.

    Next to straight, the loss is added in proportion, so that the course has no jumps. It is added all
    along, or where walls hold the wire: `held_mm` are intervals of its length, which may overlap. Between
    walls a wire under tension is straight, and has nothing to lose.
    """
    drawn = wire.centreline
    within = None if held_mm is None else _united(ArcLength(drawn), held_mm)
    bent = recurved(drawn, lambda k: np.clip(k / STRAIGHT, -loss_per_mm, loss_per_mm), within)
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
        overbend_rad=_added(drawn, loss_per_mm, within),
        moved_mm=fit.apart_mm,
        residual_mm=best_fit(*_side_by_side(released(bent, loss_per_mm, within), drawn)).apart_mm,
    )


def released(
    spline: BSpline, loss_per_mm: float, within: Sequence[tuple[float, float]] | None = None
) -> BSpline:
    """What becomes of a bent wire that is let go: it loses curvature, all of it where it has no more.

    Everywhere, or `within` these intervals of its parameter.
    """
    return recurved(spline, lambda k: -np.clip(k, -loss_per_mm, loss_per_mm), within)


def _united(lengths: ArcLength, held_mm: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Intervals of the parameter in which a wire is held, none of which overlap."""
    united: list[tuple[float, float]] = []
    for start, end in sorted(held_mm):
        if united and start <= united[-1][1]:
            united[-1] = (united[-1][0], max(end, united[-1][1]))
        else:
            united.append((start, end))
    ends = lengths.parameter(np.array(united, dtype=float).ravel())
    return [(float(a), float(b)) for a, b in ends.reshape(-1, 2)]


def _added(drawn: BSpline, loss_per_mm: float, within: Sequence[tuple[float, float]] | None) -> float:
    lengths = ArcLength(drawn)
    at_mm = lengths.stations(STEP_MM)
    u = lengths.parameter((at_mm[:-1] + at_mm[1:]) / 2)
    held = np.ones(len(u), dtype=bool)
    if within is not None:
        held = np.array([any(a < each < b for a, b in within) for each in u])
    added = np.minimum(np.abs(drawn.curvature(u)) / STRAIGHT, loss_per_mm)
    return float((added * np.diff(at_mm))[held].sum())


def _side_by_side(first: BSpline, second: BSpline) -> tuple[FloatArray, FloatArray]:
    """Points of both curves at the same lengths along them."""
    lengths = [ArcLength(first), ArcLength(second)]
    count = len(lengths[1].stations(STEP_MM))
    points = [
        curve.at(along.parameter(np.linspace(0.0, along.total_mm, count)))
        for curve, along in zip((first, second), lengths, strict=True)
    ]
    return points[0], points[1]
