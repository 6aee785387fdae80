"""Bends and lengths in the words of the craft."""

from __future__ import annotations

import itertools
import math
from typing import Final

import numpy as np

from wrapit.errors import Finding
from wrapit.geometry import BezierChain, FloatArray
from wrapit.units import SWG_MM, awg_diameter_mm

# Headings that change by less than this along a stretch count as straight.
STRAIGHT_RAD = math.radians(12)
# What the hand does where the jig alone doesn't, by the finding.
BY_HAND: Final = {
    "strays": "Press the wire to the line with your thumb there, and hold it while you go on.",
    "hemmed": "Press the wire in with a rounded stick there.",
    "weak-turn": "Bend it there with round-nose pliers before you lay it.",
    "weak-stretch": "Keep it straight by hand there.",
    "turn-without-wall": "Bend it there with round-nose pliers before you lay it.",
    "loose-end": "Hold the end with pliers until it is bent down into its hole.",
}
# Headings are taken so often: a tenth of the thickness of the usual wire.
_STEP_MM = 0.1


def thickness(diameter_mm: float) -> str:
    """The gauge that shops sell, if there is one within two percent: `18 AWG (1.02 mm)`."""
    names = {f"{gauge} AWG": awg_diameter_mm(gauge) for gauge in range(4, 37)}
    names |= {f"{gauge} SWG": size for gauge, size in SWG_MM.items()}
    fitting = [name for name, size in names.items() if abs(size - diameter_mm) <= 0.02 * diameter_mm]
    return f"{fitting[0]} ({diameter_mm:.2f} mm)" if fitting else f"{diameter_mm:.2f} mm"


def millimetres(length_mm: float) -> str:
    """To the half millimetre below 100 mm, which is what a ruler gives."""
    rounded = round(length_mm) if length_mm >= 100 else round(2 * length_mm) / 2
    return f"{rounded:g} mm"


def caution(finding: Finding) -> str:
    """What a finding of the jig says to the hand: `At 41 mm: it will cut the corner by 1.1 mm. Press …`."""
    places = listed([f"{at_mm:.0f}" for at_mm in finding.places_mm])
    return f"At {places} mm: {finding.message}. {BY_HAND[finding.code]}"


def duration(minutes: float) -> str:
    """To what a rule of thumb knows: `45 min`, `1 h 15 min`."""
    quarters = max(1, round(minutes / 15))
    hours, rest = divmod(15 * quarters, 60)
    parts = [f"{hours} h"] * (hours > 0) + [f"{rest} min"] * (rest > 0)
    return " ".join(parts)


def listed(items: list[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def joint_phrase(angle_rad: float) -> str:
    """How to go on at a meeting place; positive angles turn left."""
    degrees = round(math.degrees(abs(angle_rad)) / 5) * 5
    side = "left" if angle_rad > 0 else "right"
    if degrees < 10:
        return "Go straight on"
    if degrees >= 160:
        return "Fold the wire back on itself"
    strength = "slightly " if degrees <= 30 else "sharply " if degrees >= 90 else ""
    return f"Bend {strength}to the {side}, about {degrees}°"


def shape_phrase(chain: BezierChain) -> str:
    """The shape of a stretch of wire, as seen when you follow it: straight, a curve, an S, a spiral."""
    swings = _swings(chain)
    length = millimetres(chain.length)
    if not swings:
        return f"keep it straight for {length}"
    if len(swings) == 1:
        return f"{_curve(swings[0], chain.length)} over {length}"
    if len(swings) == 2:
        sides = [f"{_side(swing)} (about {_degrees(swing)}°)" for swing in swings]
        return f"make an S: first to the {sides[0]}, then to the {sides[1]}, over {length}"
    sides = [f"{_side(swing)} {_degrees(swing)}°" for swing in swings]
    return f"follow the waves over {length}: {', '.join(sides)}"


def bend_at(arriving: FloatArray, leaving: FloatArray) -> float:
    """Signed angle between two unit directions of travel, positive to the left."""
    cross = arriving[0] * leaving[1] - arriving[1] * leaving[0]
    return math.atan2(float(cross), float(arriving @ leaving))


def _swings(chain: BezierChain) -> list[float]:
    """Signed turning (rad) of each stretch that turns one way, slight ones left out."""
    points = chain.sampled(_STEP_MM)
    steps = np.diff(points, axis=0)
    headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turning = np.diff(headings)
    swings = [float(sum(run)) for _, run in itertools.groupby(turning, key=lambda angle: angle > 0)]
    # Wiggles smaller than a hand can follow join the swings beside them.
    while len(swings) > 1 and min(map(abs, swings)) < STRAIGHT_RAD:
        index = min(range(len(swings)), key=lambda each: abs(swings[each]))
        low, high = max(0, index - 1), min(len(swings), index + 2)
        swings[low:high] = [sum(swings[low:high])]
    return [swing for swing in swings if abs(swing) >= STRAIGHT_RAD]


def _curve(swing_rad: float, length_mm: float) -> str:
    radius_mm = length_mm / abs(swing_rad)
    kind = "tight" if radius_mm < 4 else "wide" if radius_mm > 15 else "round"
    if abs(swing_rad) > math.radians(405):
        return f"wind a spiral to the {_side(swing_rad)}, about {abs(swing_rad) / math.tau:.1f} turns,"
    if abs(swing_rad) > math.radians(330):
        return f"make a full loop to the {_side(swing_rad)}"
    return f"make a {kind} curve to the {_side(swing_rad)}, about {_degrees(swing_rad)}° in all,"


def _side(angle_rad: float) -> str:
    return "left" if angle_rad > 0 else "right"


def _degrees(angle_rad: float) -> int:
    return round(math.degrees(abs(angle_rad)) / 5) * 5
