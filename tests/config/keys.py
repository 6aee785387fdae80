"""Every number of the config, found in the models: none can be forgotten by a hand-written list."""

from __future__ import annotations

import types
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from wrapit.config import Config
from wrapit.config.quantities import PlaceRange, PointRange
from wrapit.config.ranges import Mark, NumberRange, QuantityRange

Range = QuantityRange | NumberRange


@dataclass(frozen=True)
class Key:
    """One number: its dotted key, its mark, and the place of its value in the data of a config."""

    dotted: str
    mark: Mark | None
    """None for a number that nobody gave a range."""
    wraps: tuple[str | int, ...]
    """How to reach it: names of blocks, lengths of lists (negative, −n: n of the value)."""

    def nested(self, value: object) -> dict[str, Any]:
        """A block of the config that says only this value."""
        inner: Any = value
        for step in reversed(self.wraps):
            inner = {step: inner} if isinstance(step, str) else [inner] * -step
        return inner


def ranges(mark: Mark | None) -> list[Range]:
    """The numeric ranges that a mark is made of."""
    if isinstance(mark, PointRange):
        return [mark.coordinate]
    if isinstance(mark, PlaceRange):
        return [mark.junction, mark.point.coordinate]
    assert mark is None or isinstance(mark, QuantityRange | NumberRange), mark
    return [] if mark is None else [mark]


def numeric_keys(
    model: type[BaseModel] = Config, dotted: str = "", wraps: tuple[str | int, ...] = ()
) -> Iterator[Key]:
    """All numbers of a block and of the blocks in it."""
    for name, field in model.model_fields.items():
        yield from _numbers(field.annotation, list(field.metadata), f"{dotted}{name}", (*wraps, name))


def _numbers(kind: Any, metadata: list[Any], dotted: str, wraps: tuple[str | int, ...]) -> Iterator[Key]:
    origin, inner = get_origin(kind), get_args(kind)
    mark = next((each for each in metadata if isinstance(each, Mark)), None)
    if origin is Annotated:
        yield from _numbers(inner[0], [*metadata, *inner[1:]], dotted, wraps)
    elif mark is not None or kind in (int, float, complex):
        yield Key(dotted, mark, wraps)
    elif origin in (Union, types.UnionType):
        for each in inner:
            yield from _numbers(each, [], dotted, wraps)
    elif origin in (tuple, list, set, frozenset):
        count = -len(inner) if Ellipsis not in inner else -1
        for each in {item for item in inner if item is not Ellipsis}:
            yield from _numbers(each, [], dotted, (*wraps, count))
    elif isinstance(kind, type) and issubclass(kind, BaseModel):
        yield from numeric_keys(kind, f"{dotted}.", wraps)
    else:
        assert kind in (str, bool, type(None)) or origin is Literal, f"{dotted}: what is {kind}?"


def every_key(model: type[BaseModel], blocks: str = "") -> Iterator[str]:
    """All dotted keys of a config, blocks among them."""
    for name, field in model.model_fields.items():
        yield f"{blocks}{name}"
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                yield from every_key(kind, f"{blocks}{name}.")
