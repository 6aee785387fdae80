"""A config's text as plain values, and values at dotted keys."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping
from typing import Any, Final

from wrapit.config.texts.reading import read_yaml
from wrapit.errors import ConfigError

BOM: Final = "\ufeff"
"""What some editors on Windows put before a text; it stays where it is."""


def said(text: str) -> dict[str, Any]:
    """What a config's text says. Raises ConfigError where it is no block of YAML."""
    data = plain(read_yaml(text.removeprefix(BOM), "config"))
    if data is None:
        return {}
    if not isinstance(data, dict):
        raise ConfigError(
            "the config is not a block of keys", "config", "start with 'drawing: my-drawing.png'"
        )
    return data


def plain(value: Any) -> Any:
    """A value of the YAML library as plain dicts, lists and scalars."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if type(value).__name__ == "ScalarBoolean":  # one with an anchor, which is a whole number for Python
        return bool(value)
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return None if value is None else str(value)


def finite(value: Any) -> Any:
    """Plain values as JSON can say them: what is no finite number becomes its word.

    >>> finite({"size": float("nan"), "jigs": [1.5, float("-inf")]})
    {'size': 'nan', 'jigs': [1.5, '-inf']}
    """
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [finite(item) for item in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def value_at(data: Mapping[str, Any], key: str, missing: Any = None) -> Any:
    """The value at a dotted key.

    >>> value_at({"wire": {"metal": "brass"}}, "wire.metal")
    'brass'
    """
    inner: Any = data
    for name in key.split("."):
        if not isinstance(inner, dict) or name not in inner:
            return missing
        inner = inner[name]
    return inner


def with_value(data: Mapping[str, Any], key: str, value: Any) -> dict[str, Any]:
    """The data with a value at a dotted key. Raises ConfigError where a block on the way is none."""
    result = copy.deepcopy(dict(data))
    inner = result
    *blocks, last = key.split(".")
    for name in blocks:
        if inner.get(name) is None:
            inner[name] = {}
        inner = inner[name]
        if not isinstance(inner, dict):
            raise ConfigError(f"{name} is no block of keys", key, f"write {name} as a block in the text")
    inner[last] = value
    return result


def without_value(data: Mapping[str, Any], key: str) -> dict[str, Any]:
    """The data without a dotted key; a block with nothing left in it goes too, unless that says something."""
    parent, _, last = key.rpartition(".")
    inner = value_at(data, parent) if parent else data
    rest = {name: item for name, item in inner.items() if name != last}
    if not parent:
        return rest
    return with_value(data, parent, rest) if rest or _means_something(parent) else without_value(data, parent)


def _means_something(block: str) -> bool:
    """Whether `block: {}` says more than nothing: a bail with all its defaults is a bail."""
    return block == "bail"
