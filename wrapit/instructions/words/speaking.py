"""Says texts in the guide's language and units: keys and values in, sentences out (Project Fluent)."""

from __future__ import annotations

from functools import lru_cache
from importlib import resources
from typing import Any

from wrapit.config import Language, LengthUnit
from wrapit.instructions.words.quantities import (
    INCH_MM,
    OUNCE_G,
    gauge,
    half_millimetres,
    hours_and_minutes,
    inches,
    sixteenths,
)
from wrapit.pages.model import Duration, Length, Listed, Mass, Span, Text, Thickness, Value, text

# Between a number and its unit, which stay on one line.
UNIT = "\u00a0"
# Fluent refuses what is longer than 2500 letters, as the list of a large piece's ties; such words are put in
# afterwards, where a letter that no text has marks their place.
LONG, PLACE = 1000, "\ue000"


class Speaker:
    """Says texts in one language, with lengths in one unit."""

    def __init__(self, language: Language, unit: LengthUnit) -> None:
        self.language, self.unit = language, unit
        self._bundle = _bundle(language)

    @property
    def letters(self) -> str:
        """All that its sentences are made of."""
        return _source(self.language)

    def say(self, said: Text) -> str:
        """The sentence. Raises KeyError without such a key, ValueError for values that don't fit it."""
        message = self._bundle.get_message(said.key)
        if message.value is None:
            raise KeyError(said.key)
        values = {name: self._worded(value) for name, value in said.values}
        long = {
            f"{PLACE}{name}{PLACE}": value
            for name, value in values.items()
            if isinstance(value, str) and len(value) > LONG
        }
        values |= {place.strip(PLACE): place for place in long}
        sentence, errors = self._bundle.format_pattern(message.value, values)
        if errors:
            raise ValueError(f"{said.key}: {errors[0]}")
        for place, words in long.items():
            sentence = sentence.replace(place, words)
        return str(sentence)

    def of(self, key: str, **values: Value) -> str:
        """The sentence with this key."""
        return self.say(text(key, **values))

    def number(self, value: float, decimals: int) -> str:
        """A number as the language writes it, without trailing zeros."""
        from babel.numbers import format_decimal

        return str(format_decimal(round(value, decimals), locale=self.language))

    def _worded(self, value: Value) -> str | int | float:
        match value:
            case Listed():
                return self._listed([str(self._worded(item)) for item in value.items], value.word)
            case Text():
                return self.say(value)
            case str() | int() | float():
                return value
            case _:
                return self._measure(value)

    def _measure(self, value: Length | Span | Thickness | Mass | Duration) -> str:
        match value:
            case Length():
                return self._length(value.mm)
            case Span():
                return self._span(value)
            case Thickness():
                return self._thickness(value)
            case Mass():
                return self._mass(value.g)
            case Duration():
                hours, minutes = hours_and_minutes(value.minutes)
                return self.of("duration", hours=hours, minutes=minutes)

    def _length(self, mm: float) -> str:
        if self.unit == "in":
            return self._inches(sixteenths(mm))
        return f"{self.number(half_millimetres(mm), 1)}{UNIT}mm"

    def _span(self, span: Span) -> str:
        """What lies between two places as they are read: steps say lengths that add up."""
        if self.unit == "in":
            return self._inches(sixteenths(span.end_mm) - sixteenths(span.start_mm))
        return f"{self.number(half_millimetres(span.end_mm) - half_millimetres(span.start_mm), 1)}{UNIT}mm"

    def _inches(self, count: int) -> str:
        return inches(count).replace(" in", f"{UNIT}in")

    def _thickness(self, thickness: Thickness) -> str:
        name = gauge(thickness.mm) if thickness.wire else ""
        size = f"{self.number(thickness.mm, 2)}{UNIT}mm"
        if self.unit == "in":
            size = f"{self.number(thickness.mm / INCH_MM, 3)}{UNIT}in"
        return f"{name} ({size})" if name else size

    def _mass(self, g: float) -> str:
        return (
            f"{self.number(g / OUNCE_G, 2)}{UNIT}oz" if self.unit == "in" else f"{self.number(g, 1)}{UNIT}g"
        )

    def _listed(self, items: list[str], word: str) -> str:
        """`a`, `a and b`, `a, b and c`."""
        if len(items) == 1:
            return items[0]
        return f"{', '.join(items[:-1])} {self.of(word)} {items[-1]}"


@lru_cache(4)
def _bundle(language: Language) -> Any:
    from fluent.runtime import FluentBundle, FluentResource

    # Marks that isolate what is put in are for right-to-left scripts; prints would show them as boxes.
    bundle = FluentBundle([language], use_isolating=False)
    bundle.add_resource(FluentResource(_source(language)))
    return bundle


def _source(language: Language) -> str:
    return resources.files("wrapit.instructions.words").joinpath(f"{language}.ftl").read_text("utf-8")
