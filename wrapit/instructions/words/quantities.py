"""Lengths, thicknesses, weights and times as people read them off a ruler, a label or a scale."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Final

from wrapit.units import MM_PER, SWG_MM, awg_diameter_mm

INCH_MM: Final = MM_PER["in"]  # one truth with what configs may say
# A ruler in inches has sixteenths; below an inch, for radii, its finer half has thirty-seconds.
SIXTEENTHS: Final = 16
OUNCE_G: Final = 28.349523125
# A gauge that shops sell is meant where it lies this near, as a share.
SAME_GAUGE: Final = 0.02


def half_millimetres(length_mm: float) -> float:
    """To the half millimetre below 100 mm, to the millimetre above: what a ruler gives."""
    return float(round(length_mm)) if length_mm >= 100 else round(2 * length_mm) / 2


def sixteenths(length_mm: float) -> int:
    """To the sixteenth of an inch."""
    return round(length_mm / INCH_MM * SIXTEENTHS)


def inches(count: int) -> str:
    """So many sixteenths of an inch.

    >>> inches(16), inches(22), inches(6)
    ('1 in', '1 3/8 in', '3/8 in')
    """
    whole, rest = divmod(count, SIXTEENTHS)
    parts = [str(whole)] * (whole > 0 or not rest) + [str(Fraction(rest, SIXTEENTHS))] * (rest > 0)
    return f"{' '.join(parts)} in"


def gauge(diameter_mm: float) -> str:
    """The gauge that shops sell, if there is one within SAME_GAUGE; else nothing.

    >>> gauge(1.024), gauge(1.219), gauge(0.95)
    ('18 AWG', '18 SWG', '')
    """
    names = {f"{number} AWG": awg_diameter_mm(number) for number in range(4, 37)}
    names |= {f"{number} SWG": size for number, size in SWG_MM.items()}
    near = (name for name, size in names.items() if abs(size - diameter_mm) <= SAME_GAUGE * diameter_mm)
    return next(near, "")


def hours_and_minutes(minutes: float) -> tuple[int, int]:
    """To what a rule of thumb knows: five minutes below half an hour, a quarter of an hour above.

    >>> hours_and_minutes(17), hours_and_minutes(70)
    ((0, 15), (1, 15))
    """
    step = 5 if minutes < 30 else 15
    hours, rest = divmod(step * max(1, math.floor(minutes / step + 0.5)), 60)
    return hours, rest
