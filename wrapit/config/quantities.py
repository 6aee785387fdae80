"""The numbers of a config: lengths, angles, … with the range that a crafter would call sane.

Used as `kerf: Annotated[float, length("0 mm", "5 mm", "0.15 mm")] = 0.15`. Quantities are read from text,
kept in mm, radians or seconds, and written back as text.
"""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal

from wrapit import units
from wrapit.config.choices import spelled
from wrapit.config.ranges import Mark, NumberRange, QuantityRange, Unit
from wrapit.units import shown

LENGTH: Final = Unit(units.length_mm, units.in_mm, (" mm",))
GAUGE: Final = Unit(units.gauge_diameter_mm, units.in_mm, (" AWG", " mm"))
CURVATURE: Final = Unit(units.curvature_per_mm, units.in_per_mm, (" /mm",))
ANGLE: Final = Unit(units.angle_rad, units.in_degrees, (" deg",))
TIME: Final = Unit(units.duration_s, units.in_seconds, (" s", " min"))
"""Kinds of quantities: how each is read and written, and the units that a bare number may have meant."""


def length(at_least: str, at_most: str, example: str) -> QuantityRange:
    """A length, kept in mm."""
    return QuantityRange(LENGTH, at_least, at_most, example)


def wire_gauge(at_least: str, at_most: str, example: str) -> QuantityRange:
    """A wire's thickness as gauge number or diameter, kept in mm."""
    return QuantityRange(GAUGE, at_least, at_most, example)


def curvature(at_least: str, at_most: str, example: str) -> QuantityRange:
    """A curvature, kept in 1/mm."""
    return QuantityRange(CURVATURE, at_least, at_most, example)


def angle(at_least: str, at_most: str, example: str) -> QuantityRange:
    """An angle, kept in radians."""
    return QuantityRange(ANGLE, at_least, at_most, example)


def duration(at_least: str, at_most: str, example: str) -> QuantityRange:
    """A time, kept in seconds."""
    return QuantityRange(TIME, at_least, at_most, example)


def number(at_least: float, at_most: float) -> NumberRange:
    """A number without unit."""
    return NumberRange(at_least, at_most, "number")


def whole(at_least: int, at_most: int) -> NumberRange:
    """A whole number."""
    return NumberRange(at_least, at_most, "integer")


class PointRange(Mark):
    """A point such as `[12 mm, 30 mm]`, kept in mm; `coordinate` is the range of x and of y."""

    def __init__(self, coordinate: QuantityRange) -> None:
        self.coordinate = coordinate

    def check(self, value: object) -> tuple[float, float]:
        """The point in mm; ValueError with a hint otherwise.

        >>> Point.__metadata__[0].check(["1 cm", "-2.5 mm"])
        (10.0, -2.5)
        """
        if not isinstance(value, list | tuple) or len(value) != 2:
            raise ValueError(f"expected a point, but got {shown(value)}; write for example [12 mm, 30 mm]")
        return self.coordinate.check(value[0]), self.coordinate.check(value[1])

    def write(self, value: tuple[float, float]) -> list[str]:
        return [self.coordinate.write(each) for each in value]

    def describe(self) -> dict[str, Any]:
        items = self.coordinate.describe()
        del items["examples"]
        return {
            "type": "array",
            "items": items,
            "minItems": 2,
            "maxItems": 2,
            "examples": [["12 mm", "30 mm"]],
        }


class PlaceRange(Mark):
    """`top`, the number of a junction, or a point."""

    def __init__(self, junction: NumberRange, point: PointRange) -> None:
        self.junction, self.point = junction, point

    def check(self, value: object) -> Literal["top"] | int | tuple[float, float]:
        if value == "top":
            return "top"
        if isinstance(value, list | tuple):
            return self.point.check(value)
        if isinstance(value, int) and not isinstance(value, bool):
            return int(self.junction.check(value))
        raise ValueError(
            f"{shown(value)} is no place; write top, the number of a junction, or [12 mm, 30 mm]"
        )

    def write(self, value: str | int | tuple[float, float]) -> str | int | list[str]:
        return self.point.write(value) if isinstance(value, tuple) else value

    def describe(self) -> dict[str, Any]:
        return {
            "anyOf": [{"const": "top"}, spelled(["top"]), self.junction.describe(), self.point.describe()]
        }


NUMBER_IN_DRAWING: Final = whole(0, 99_999)
"""Of a segment or a junction, as `drawing.svg` shows it."""

COORDINATE: Final = length("-2 m", "2 m", "12 mm")
"""Twice the largest piece, on each side of the origin."""

Point = Annotated[tuple[float, float], PointRange(COORDINATE)]
Place = Annotated[
    Literal["top"] | int | tuple[float, float], PlaceRange(NUMBER_IN_DRAWING, PointRange(COORDINATE))
]
Numbered = Annotated[int, whole(-1, 99_999)]
"""A segment or junction of a wish; the stage that knows the drawing names those that it lacks, -1 too."""
