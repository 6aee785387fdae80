"""Config fields that carry a unit: read from text, kept in mm or radians, written back as text."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema

from wrapit import units


def _text(example: str) -> WithJsonSchema:
    return WithJsonSchema({"type": "string", "examples": [example]})


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
