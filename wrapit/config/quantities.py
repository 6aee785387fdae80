"""Config fields that carry a unit: read from text, kept in mm or radians, written back as text."""

from __future__ import annotations

from typing import Annotated, Final, Literal

from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema

from wrapit import units


def _text(example: str) -> WithJsonSchema:
    return WithJsonSchema({"type": "string", "examples": [example]})


_POINT: Final = {
    "type": "array",
    "items": {"type": "string"},
    "minItems": 2,
    "maxItems": 2,
    "examples": [["12 mm", "30 mm"]],
}

Length = Annotated[
    float, BeforeValidator(units.length_mm), PlainSerializer(units.in_mm), _text("40 mm"), Field(ge=0)
]
PositiveLength = Annotated[Length, Field(gt=0)]
Gauge = Annotated[
    float,
    BeforeValidator(units.gauge_diameter_mm),
    PlainSerializer(units.in_mm),
    _text("18 AWG"),
    Field(gt=0.05, lt=10),
]
Curvature = Annotated[
    float,
    BeforeValidator(units.curvature_per_mm),
    PlainSerializer(units.in_per_mm),
    _text("0.08 /mm"),
    Field(gt=0),
]
Angle = Annotated[
    float, BeforeValidator(units.angle_rad), PlainSerializer(units.in_degrees), _text("60 deg"), Field(ge=0)
]
Point = Annotated[
    tuple[float, float],
    BeforeValidator(units.point_mm),
    PlainSerializer(units.point_in_mm),
    WithJsonSchema(_POINT),
]
Place = Annotated[
    Literal["top"] | int | tuple[float, float],
    BeforeValidator(units.place_mm),
    PlainSerializer(units.place_in_mm),
    WithJsonSchema({"anyOf": [{"const": "top"}, {"type": "integer", "minimum": 0}, _POINT]}),
]
