"""Where the jig has to hold a wire: sharp turns, and long stretches between them (paper, section 5)."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.model import Side, Turn

# How closely curvature is looked at: with 0.035 or 0.065 the turns of three of our drawings (707 mm) are the
# same ones and change by 0.1 mm together.
STEP_MM = 0.05
MERGE_MM = 1.5  # a straighter gap this short inside a turn is part of it
END_CLEARANCE_MM = 3.0  # long stretches are held only where no turn's wall is near


@dataclass(frozen=True)
class _Span:
    start: int
    end: int
    sign: int
    turning_rad: float


def find_turns(name: str, spline: BSpline, config: JigConfig) -> tuple[tuple[Turn, ...], tuple[Finding, ...]]:
    """Turns in the order of the wire, and a finding for each bend too slight to get a wall."""
    lengths = ArcLength(spline)
    at_mm = lengths.stations(STEP_MM)
    curvature = spline.curvature(lengths.parameter((at_mm[:-1] + at_mm[1:]) / 2))
    turning = curvature * np.diff(at_mm)
    spans = _merged(_sharp_spans(curvature, turning, config.turn_curvature), at_mm, turning)
    kept = [span for span in spans if abs(span.turning_rad) >= config.turn_angle]
    turns = [_turn(name, span, at_mm, curvature) for span in kept]
    if config.support == "turns":
        turns += _long_stretches(name, kept, at_mm, turning, config.long_segment)
    dropped = tuple(
        Finding(
            "note",
            "slight-turn",
            f"{name} at {(at_mm[span.start] + at_mm[span.end]) / 2:.0f} mm",
            f"a bend of {np.degrees(abs(span.turning_rad)):.0f}° is left to the hand, without a wall",
            "lower jig.turn_angle to get one",
        )
        for span in spans
        if abs(span.turning_rad) < config.turn_angle and abs(span.turning_rad) > config.turn_angle / 2
    )
    return tuple(sorted(turns, key=lambda turn: turn.start_mm)), dropped


def _sharp_spans(curvature: FloatArray, turning: FloatArray, threshold: float) -> list[_Span]:
    side = np.where(np.abs(curvature) > threshold, np.sign(curvature), 0).astype(int)
    bounds = [0, *(np.flatnonzero(np.diff(side)) + 1), len(side)]
    return [
        _Span(int(a), int(b), int(side[a]), float(turning[a:b].sum()))
        for a, b in itertools.pairwise(bounds)
        if side[a]
    ]


def _merged(spans: list[_Span], at_mm: FloatArray, turning: FloatArray) -> list[_Span]:
    merged: list[_Span] = []
    for span in spans:
        last = merged[-1] if merged else None
        if last and last.sign == span.sign and at_mm[span.start] - at_mm[last.end] <= MERGE_MM:
            total = float(turning[last.start : span.end].sum())
            merged[-1] = _Span(last.start, span.end, span.sign, total)
        else:
            merged.append(span)
    return merged


def _turn(name: str, span: _Span, at_mm: FloatArray, curvature: FloatArray) -> Turn:
    return Turn(
        wire=name,
        start_mm=float(at_mm[span.start]),
        end_mm=float(at_mm[span.end]),
        inside="left" if span.sign > 0 else "right",
        max_curvature_per_mm=float(np.abs(curvature[span.start : span.end]).max()),
    )


def _long_stretches(
    name: str, turns: list[_Span], at_mm: FloatArray, turning: FloatArray, longest_mm: float
) -> list[Turn]:
    """Long stretches between turns, with a wall on their concave side (the left one of a straight line)."""
    bounds = [0, *itertools.chain(*((t.start, t.end) for t in turns)), len(at_mm) - 1]
    stretches = []
    for a, b in zip(bounds[::2], bounds[1::2], strict=True):
        if at_mm[b] - at_mm[a] > max(longest_mm, 3 * END_CLEARANCE_MM):
            inside: Side = "left" if turning[a:b].sum() >= 0 else "right"
            low, high = float(at_mm[a]) + END_CLEARANCE_MM, float(at_mm[b]) - END_CLEARANCE_MM
            stretches.append(Turn(name, low, high, inside, 0.0, stretch=True))
    return stretches
