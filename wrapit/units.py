"""Numbers with units as people write them, and the wire gauges of the craft.

Everything inside wrapit is in millimetres and radians; these functions stand at the door.
"""

from __future__ import annotations

import math
import re
from typing import Final, Literal

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
_QUANTITY: Final = re.compile(rf"^\s*{_NUMBER}\s*([^\d\s].*?)?\s*$")
_GAUGE: Final = re.compile(r"^\s*(?:(awg|swg)\s*[-#]?\s*(\d+)|(\d+)\s*(awg|swg))\s*$", re.IGNORECASE)

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


def _quantity(value: object, units: dict[str, float], example: str) -> float:
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError(f"expected a value with a unit, such as {example!r}, but got {_shown(value)}")
    if isinstance(value, int | float):
        raise ValueError(f"{value} has no unit; write for example {f'{value:g}{_suffix(example)}'!r}")
    match = _QUANTITY.match(value)
    if match is None:
        raise ValueError(f"{value!r} is not a value with a unit; write for example {example!r}")
    number, unit = float(match[1]), (match[2] or "").replace(" ", "").lower()
    if not unit:
        raise ValueError(f"{value!r} has no unit; write for example {f'{match[1]}{_suffix(example)}'!r}")
    if unit not in units:
        raise ValueError(f"unknown unit {unit!r}; use one of {', '.join(units)}, for example {example!r}")
    if not math.isfinite(number):
        raise ValueError(f"{value!r} is not a finite number")
    return number * units[unit]


def _shown(value: object) -> str:
    return {list: "a list", dict: "a block", bool: "true or false", type(None): "nothing"}.get(
        type(value), type(value).__name__
    )


def _suffix(example: str) -> str:
    return example[len(example.split(maxsplit=1)[0]) :]


def length_mm(value: object) -> float:
    """Millimetres of a length such as `40 mm`, `1.5 in`; ValueError with a hint otherwise.

    >>> length_mm("1.5 in")
    38.1
    """
    return round(_quantity(value, MM_PER, "40 mm"), 9)


def curvature_per_mm(value: object) -> float:
    """Curvature in 1/mm of `0.08 /mm`, `0.8 /cm`; ValueError with a hint otherwise."""
    return _quantity(value, PER_MM, "0.08 /mm")


def angle_rad(value: object) -> float:
    """Radians of an angle such as `60 deg`; ValueError with a hint otherwise."""
    return _quantity(value, RADIANS_PER, "60 deg")


def gauge_diameter_mm(value: object) -> float:
    """Diameter in mm of `18 AWG`, `awg18`, `swg18` or `1.0 mm`; ValueError with a hint otherwise.

    >>> gauge_diameter_mm("swg 18")
    1.22
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        raise ValueError(f"{value} has no unit; write '{value:g} AWG', 'swg{value:g}' or '{value:g} mm'")
    match = _GAUGE.match(value) if isinstance(value, str) else None
    if match is None:
        return _quantity(value, MM_PER, "1.0 mm")
    system, number = (match[1] or match[4]).lower(), int(match[2] or match[3])
    if system == "awg":
        if not 0 <= number <= 40:
            raise ValueError(f"{value!r}: AWG sizes run from 0 to 40")
        return awg_diameter_mm(number)
    if number not in SWG_MM:
        raise ValueError(
            f"{value!r}: known SWG sizes are {', '.join(map(str, SWG_MM))}; or give a diameter in mm"
        )
    return SWG_MM[number]


def point_mm(value: object) -> tuple[float, float]:
    """A point in mm of `[12 mm, 30 mm]`; ValueError with a hint otherwise.

    >>> point_mm(["1 cm", "-2.5 mm"])
    (10.0, -2.5)
    """
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise ValueError(f"expected a point such as [12 mm, 30 mm], but got {_shown(value)}")
    return length_mm(value[0]), length_mm(value[1])


def place_mm(value: object) -> Literal["top"] | int | tuple[float, float]:
    """`top`, the number of a junction, or a point in mm of `[12 mm, 30 mm]`; ValueError otherwise."""
    if value == "top":
        return "top"
    if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
        return value
    if isinstance(value, list | tuple):
        return point_mm(value)
    raise ValueError(f"{value!r} is no place; write top, the number of a junction, or [12 mm, 30 mm]")


def point_in_mm(point: tuple[float, float]) -> list[str]:
    """A point as the config writes it."""
    return [in_mm(point[0]), in_mm(point[1])]


def place_in_mm(place: str | int | tuple[float, float]) -> str | int | list[str]:
    """A place as the config writes it."""
    return point_in_mm(place) if isinstance(place, tuple) else place


def in_mm(value_mm: float) -> str:
    """A length as the config writes it, `40 mm`."""
    return f"{value_mm:.9g} mm"


def in_per_mm(value_per_mm: float) -> str:
    """A curvature as the config writes it, `0.08 /mm`."""
    return f"{value_per_mm:.9g} /mm"


def in_degrees(value_rad: float) -> str:
    """An angle as the config writes it, `60 deg`."""
    return f"{math.degrees(value_rad):.9g} deg"
