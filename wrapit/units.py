"""Numbers with units as people write them, and the wire gauges of the craft.

Everything inside wrapit is in millimetres and radians; these functions stand at the door.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from typing import Final

# `40`, `1.5`, `1,5`, `1e3`, `1/2`, `1 1/2`, `1-1/2`.
_NUMBER: Final = (
    r"(?P<sign>[-+]?)(?:(?:(?P<whole>\d+)(?:\s+|\s*-\s*))?(?P<parts>\d+)\s*/\s*(?P<of>\d+)"
    r"|(?P<decimal>(?:\d*,\d+|\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))"
)
_QUANTITY: Final = re.compile(rf"^\s*(?P<number>{_NUMBER})\s*(?P<unit>(?:(?<=\s)1/)?[^\d\s.,+_-].*?)?\s*$")
# `1,500` is a thousand and a half for some and one and a half for others; `1.500,5` is no better.
_THOUSANDS: Final = re.compile(r"^\s*[-+]?([1-9]\d{0,2}(?:,\d{3})+|\d{1,3}(?:[.,]\d{3})+[.,]\d+)(?![\d.,])")
# `18 AWG`, `18ga`, `18-gauge`, `#18`, `No. 18`, `swg18`, `18 gauge SWG`.
_GAUGE_WORDS: Final = r"(?:awg|swg|b&s|gauge|gage|ga|g|#|no|nr)(?:[\s.-]*(?:awg|swg|b&s|gauge|gage|ga|#))*"
_GAUGE: Final = re.compile(
    rf"^\s*(?P<before>{_GAUGE_WORDS})?(?(before)[\s.-]*)(?P<number>\d{{1,3}})"
    rf"(?:[\s-]*(?P<after>{_GAUGE_WORDS})\.?)?\s*$",
    re.IGNORECASE,
)
_MEANS_GAUGE: Final = re.compile(r"#|(?:\b|\d)(?:awg|swg|gauge|gage|ga)(?:\b|\d)", re.IGNORECASE)

MM_PER: Final = {
    "mm": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "in": 25.4,
    '"': 25.4,
    "ft": 304.8,
    "um": 1e-3,
    "µm": 1e-3,
}
PER_MM: Final = {"/mm": 1.0, "1/mm": 1.0, "mm^-1": 1.0, "/cm": 0.1, "1/cm": 0.1, "/m": 1e-3, "1/m": 1e-3}
RADIANS_PER: Final = {"deg": math.pi / 180, "°": math.pi / 180, "degrees": math.pi / 180, "rad": 1.0}
_SPELLED: Final = {
    "mm": ("millimeter", "millimetre"),
    "cm": ("centimeter", "centimetre"),
    "m": ("meter", "metre"),
    "um": ("micrometer", "micrometre", "micron"),
    "in": ("inch", "inche", "''", "″", "”"),
    "ft": ("foot", "feet", "'", "′", "’"),
    "deg": ("degree",),
    "rad": ("radian",),
    "s": ("second",),
    "min": ("minute",),
    "h": ("hour", "hr"),
}
"""Other spellings of units, without the `s` of many."""
_SHORT: Final = {spelled: unit for unit, others in _SPELLED.items() for spelled in others}
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
    text = _with_plain_fractions(value) if len(value) <= LONGEST_TEXT else ""
    if _THOUSANDS.match(text):
        if text.count(",") == 1 and "." not in text:
            remedy = "write " + " or ".join(repr(text.strip().replace(",", mark)) for mark in (".", ""))
        raise ValueError(f"{shown(value)} may mean thousands or decimals; {remedy}")
    match = _QUANTITY.match(text)
    if match is None or (match["of"] and int(match["of"]) == 0):
        raise ValueError(f"{shown(value)} is not a value with a unit; {remedy}")
    number, unit = _number(match), _unit(match["unit"] or "", units)
    if not unit:
        raise UnitMissingError(shown(value), " ".join(match["number"].split()), example)
    if unit not in units:
        raise ValueError(
            f"unknown unit {shown(unit)}; use one of {', '.join(units)}, for example {example!r}"
        )
    if not math.isfinite(number):
        raise ValueError(f"{shown(value)} is not a finite number; {remedy}")
    return number * units[unit]


def _with_plain_fractions(text: str) -> str:
    """`1½` as `1 1/2`, and other slashes of fractions as the plain one."""
    spelled = (
        f" {unicodedata.normalize('NFKC', each)}"
        if unicodedata.decomposition(each).startswith("<fraction>")
        else each
        for each in text
    )
    return "".join(spelled).replace("\N{FRACTION SLASH}", "/").replace("\N{DIVISION SLASH}", "/")


def _number(match: re.Match[str]) -> float:
    if match["decimal"]:
        number = float(match["decimal"].replace(",", "."))
    else:
        number = int(match["whole"] or 0) + int(match["parts"]) / int(match["of"])
    return -number if match["sign"] == "-" else number


def _unit(written: str, units: Mapping[str, float]) -> str:
    """The unit as `units` spells it, where they know it."""
    unit = written.replace(" ", "").lower().rstrip(".")
    unit = unit.replace("\N{GREEK SMALL LETTER MU}", "\N{MICRO SIGN}")  # which look alike
    short = _SHORT.get(unit, _SHORT.get(unit.removesuffix("s"), ""))
    return short if unit not in units and short in units else unit


def length_mm(value: object, example: str = "40 mm") -> float:
    """Millimetres of a length such as `40 mm`, `1 1/2 inches`, `4,5 cm`; ValueError with a hint otherwise.

    >>> length_mm("1.5 in"), length_mm('1½"'), length_mm("3,81 Centimetres")
    (38.1, 38.1, 38.1)
    >>> length_mm("1,500 mm")
    Traceback (most recent call last):
    ValueError: '1,500 mm' may mean thousands or decimals; write '1.500 mm' or '1500 mm'
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
    """Diameter in mm of `18 AWG`, `18 gauge`, `#18`, `swg18` or `1.0 mm`; ValueError with a hint otherwise.

    A gauge that doesn't say which is American.

    >>> gauge_diameter_mm("swg 18"), gauge_diameter_mm("18ga") == gauge_diameter_mm("awg18")
    (1.22, True)
    """
    text = value if isinstance(value, str) and len(value) <= LONGEST_TEXT else ""
    match = _GAUGE.match(text)
    words = f"{match['before'] or ''} {match['after'] or ''}".lower() if match else ""
    if match is None or not words.strip():
        if _MEANS_GAUGE.search(text):
            raise ValueError(
                f"{shown(value)} is no wire gauge; write one whole number such as '18 AWG', or '1.0 mm'"
            )
        return length_mm(value, example)
    number = int(match["number"])
    if "swg" not in words:
        thicker = number == 0 and len(match["number"]) > 1  # 00 is a gauge of its own, and thicker than 0
        if thicker or not 0 <= number <= 40:
            raise ValueError(f"{value!r}: AWG sizes run from 0 to 40; write for example '18 AWG'")
        return awg_diameter_mm(number)
    if "awg" in words:
        raise ValueError(f"{shown(value)} names both gauges; write '{number} AWG' or '{number} SWG'")
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
