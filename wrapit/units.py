"""Numbers with units as people write them, and the wire gauges of the craft.

Everything inside wrapit is in millimetres and radians; these functions stand at the door.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Final

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
_QUANTITY: Final = re.compile(rf"^\s*{_NUMBER}\s*((?:(?<=\s)1/)?[^\d\s.,+_-].*?)?\s*$")
_GAUGE: Final = re.compile(r"^\s*(?:(awg|swg)\s*[-#]?\s*(\d{1,3})|(\d{1,3})\s*(awg|swg))\s*$", re.IGNORECASE)

MM_PER: Final = {
    "mm": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "in": 25.4,
    "inch": 25.4,
    '"': 25.4,
    "um": 1e-3,
    "µm": 1e-3,
}
PER_MM: Final = {"/mm": 1.0, "1/mm": 1.0, "mm^-1": 1.0, "/cm": 0.1, "1/cm": 0.1, "/m": 1e-3, "1/m": 1e-3}
RADIANS_PER: Final = {"deg": math.pi / 180, "°": math.pi / 180, "degrees": math.pi / 180, "rad": 1.0}
SECONDS_PER: Final = {
    "s": 1.0,
    "sec": 1.0,
    "seconds": 1.0,
    "min": 60.0,
    "minutes": 60.0,
    "h": 3600.0,
    "hours": 3600.0,
}

LONGEST_TEXT: Final = 60
"""Characters of a value with a unit; longer ones are something else."""
LONGEST_SHOWN: Final = 60
LONGEST_NUMBER: Final = 25
"""Digits of a whole number that a message repeats."""

# British standard wire gauge (BS 3737), diameters in mm.
SWG_MM: Final = {
    12: 2.64, 14: 2.03, 16: 1.63, 18: 1.22, 19: 1.02, 20: 0.91, 21: 0.81, 22: 0.71, 24: 0.56, 26: 0.46,
    28: 0.38, 30: 0.32,
}  # fmt: skip


def awg_diameter_mm(gauge: int) -> float:
    """Diameter of an American wire gauge (ASTM B258).

    >>> round(awg_diameter_mm(18), 2)
    1.02
    """
    return 0.127 * 92.0 ** ((36 - gauge) / 39)


class UnitMissingError(ValueError):
    """A bare number: `number` is its text, to which a unit could be added."""

    def __init__(self, given: str, number: str, example: str) -> None:
        super().__init__(f"{given} has no unit; write for example {example!r}")
        self.given, self.number = given, number


def shown(value: object) -> str:
    """What somebody wrote, as a message shows it: on one line, never long, whatever it is."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        names = {
            list: "a list",
            tuple: "a list",
            dict: "a block",
            type(None): "nothing",
            bool: "true or false",
        }
        return names.get(type(value), type(value).__name__)
    if isinstance(value, str):
        return repr(shortened(value, LONGEST_SHOWN))  # which spells out what can't be printed
    if isinstance(value, int):
        return str(value) if abs(value) < 10**LONGEST_NUMBER else "a number of endless digits"
    return f"{value:g}"


def shortened(text: str, length: int) -> str:
    """The text, cut where it is longer than `length`."""
    return text if len(text) <= length else f"{text[: length - 1]}…"


def printable(text: str) -> str:
    """The text with what can't be printed (control characters, halves of characters) spelled out.

    >>> printable("é\\x07")
    'é\\\\x07'
    """
    return "".join(each if each.isprintable() else ascii(each)[1:-1] for each in text)


def _quantity(value: object, units: Mapping[str, float], example: str) -> float:
    remedy = f"write for example {example!r}"
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError(f"expected a value with a unit, but got {shown(value)}; {remedy}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{value} is not a finite number; {remedy}")
    if isinstance(value, int | float):
        raise UnitMissingError(shown(value), shown(value), example)
    match = _QUANTITY.match(value) if len(value) <= LONGEST_TEXT else None
    if match is None:
        raise ValueError(f"{shown(value)} is not a value with a unit; {remedy}")
    number, unit = float(match[1]), (match[2] or "").replace(" ", "").lower()
    unit = unit.replace("\N{GREEK SMALL LETTER MU}", "\N{MICRO SIGN}")  # which look alike
    if not unit:
        raise UnitMissingError(shown(value), match[1], example)
    if unit not in units:
        raise ValueError(
            f"unknown unit {shown(unit)}; use one of {', '.join(units)}, for example {example!r}"
        )
    if not math.isfinite(number):
        raise ValueError(f"{shown(value)} is not a finite number; {remedy}")
    return number * units[unit]


def length_mm(value: object, example: str = "40 mm") -> float:
    """Millimetres of a length such as `40 mm`, `1.5 in`; ValueError with a hint otherwise.

    >>> length_mm("1.5 in")
    38.1
    """
    return round(_quantity(value, MM_PER, example), 9)


def curvature_per_mm(value: object, example: str = "0.08 /mm") -> float:
    """Curvature in 1/mm of `0.08 /mm`, `0.8 /cm`; ValueError with a hint otherwise."""
    return _quantity(value, PER_MM, example)


def angle_rad(value: object, example: str = "60 deg") -> float:
    """Radians of an angle such as `60 deg`; ValueError with a hint otherwise."""
    return _quantity(value, RADIANS_PER, example)


def duration_s(value: object, example: str = "120 s") -> float:
    """Seconds of a time such as `120 s`, `5 min`; ValueError with a hint otherwise.

    >>> duration_s("5 min")
    300.0
    """
    return _quantity(value, SECONDS_PER, example)


def gauge_diameter_mm(value: object, example: str = "1.0 mm") -> float:
    """Diameter in mm of `18 AWG`, `awg18`, `swg18` or `1.0 mm`; ValueError with a hint otherwise.

    >>> gauge_diameter_mm("swg 18")
    1.22
    """
    match = _GAUGE.match(value) if isinstance(value, str) else None
    if match is None:
        return length_mm(value, example)
    system, number = (match[1] or match[4]).lower(), int(match[2] or match[3])
    if system == "awg":
        if not 0 <= number <= 40:
            raise ValueError(f"{value!r}: AWG sizes run from 0 to 40; write for example '18 AWG'")
        return awg_diameter_mm(number)
    if number not in SWG_MM:
        raise ValueError(
            f"{value!r}: known SWG sizes are {', '.join(map(str, SWG_MM))}; or give a diameter in mm"
        )
    return SWG_MM[number]


def in_mm(value_mm: float) -> str:
    """A length as the config writes it, `40 mm`."""
    return f"{value_mm:.9g} mm"


def in_per_mm(value_per_mm: float) -> str:
    """A curvature as the config writes it, `0.08 /mm`."""
    return f"{value_per_mm:.9g} /mm"


def in_degrees(value_rad: float) -> str:
    """An angle as the config writes it, `60 deg`."""
    return f"{math.degrees(value_rad):.9g} deg"


def in_seconds(value_s: float) -> str:
    """A time as the config writes it, `120 s`."""
    return f"{value_s:.9g} s"
