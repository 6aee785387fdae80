"""Marks for the numbers of a config: how each is read, between which values, and how it is written.

A mark makes validator, message and schema of its key, so that the three never differ.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Final, Literal

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from wrapit.units import UnitMissingError, shown

ROUNDING: Final = 1e-9
"""Share of a bound by which a value may miss it: `180 deg` is π only nearly."""


class Mark(ABC):
    """Metadata of an annotated type that reads and writes its values, and describes them in the schema."""

    @abstractmethod
    def check(self, value: object) -> Any:
        """The value as the program uses it; ValueError `problem; remedy` otherwise."""

    @abstractmethod
    def write(self, value: Any) -> Any:
        """The value as the config spells it."""

    @abstractmethod
    def describe(self) -> dict[str, Any]:
        """Its part of the JSON schema."""

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.check, serialization=core_schema.plain_serializer_function_ser_schema(self.write)
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return self.describe()


@dataclass(frozen=True)
class Unit:
    """A kind of quantity: `read` takes a text and an example for its hint, `write` is the way back."""

    read: Callable[[object, str], float]
    write: Callable[[float], str]
    suffixes: tuple[str, ...]
    """What to add to a bare number, as its remedy."""


class QuantityRange(Mark):
    """A quantity such as `40 mm`, kept in the unit of the program; bounds as texts, both allowed.

    ValueError where the example is out of the range.
    """

    def __init__(self, unit: Unit, at_least: str, at_most: str, example: str) -> None:
        self.unit, self.texts, self.example = unit, (at_least, at_most), example
        self.at_least, self.at_most = unit.read(at_least, example), unit.read(at_most, example)
        self.check(example)

    def check(self, value: object) -> float:
        try:
            number = self.unit.read(value, self.example)
        except UnitMissingError as error:
            fitting = [repr(text) for text in self._with_units(error.number) if self._accepts(text)]
            remedy = f"write for example {' or '.join(fitting or [repr(self.example)])}"
            raise ValueError(f"{error.given} has no unit; {remedy}") from None
        slack = ROUNDING * max(abs(self.at_least), abs(self.at_most))
        if not (self.at_least - slack <= number <= self.at_most + slack):
            raise ValueError(f"{str(value).strip()} is out of range; {self.choose}")
        return min(max(number, self.at_least), self.at_most) + 0.0  # never -0

    def write(self, value: float) -> str:
        return self.unit.write(value)

    def describe(self) -> dict[str, Any]:
        at_least, at_most = self.texts
        return {"type": "string", "examples": [self.example], "x-minimum": at_least, "x-maximum": at_most}

    @property
    def choose(self) -> str:
        """The remedy for a value outside."""
        return f"choose between {self.texts[0]} and {self.texts[1]}"

    def _with_units(self, number: str) -> list[str]:
        return [f"{number}{suffix}" for suffix in self.unit.suffixes]

    def _accepts(self, text: str) -> bool:
        try:
            self.check(text)
        except ValueError:
            return False
        return True


@dataclass(frozen=True)
class NumberRange(Mark):
    """A plain number without unit, between two values that are both allowed."""

    NAMES: ClassVar = {"integer": "whole number", "number": "number"}

    at_least: float
    at_most: float
    type: Literal["integer", "number"]

    def check(self, value: object) -> float:
        whole = self.type == "integer"
        remedy = f"choose between {shown(self.at_least)} and {shown(self.at_most)}"
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ValueError(f"{shown(value)} is not a {self.NAMES[self.type]}; {remedy}")
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError(f"{value} is not a finite number; {remedy}")
        if whole and value != int(value):
            raise ValueError(f"{value} is not a whole number; {remedy}")
        if not self.at_least <= value <= self.at_most:
            raise ValueError(f"{shown(value)} is out of range; {remedy}")
        return int(value) if whole else float(value) + 0.0  # never -0

    def write(self, value: float) -> float:
        return value

    def describe(self) -> dict[str, Any]:
        return {"type": self.type, "minimum": self.at_least, "maximum": self.at_most}
