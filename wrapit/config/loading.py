"""Reads a YAML config; every mistake is named with file, line, column and a remedy."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import UnionType
from typing import Any, Final, get_args

from pydantic import BaseModel, ValidationError

from wrapit.config.naming import named_after
from wrapit.config.root import Config
from wrapit.config.texts.budgets import DEEPEST
from wrapit.config.texts.reading import read_blocks, read_yaml
from wrapit.errors import ConfigError
from wrapit.units import printable, shortened, shown

LONGEST_OVERRIDE: Final = 10_000
"""Letters; the longest that makes sense is a list of some hundred constraints."""

_EXPECTED: Final = {
    "model_type": "a block of keys",
    "model_attributes_type": "a block of keys",
    "dict_type": "a block of keys",
    "list_type": "a list",
    "tuple_type": "a list",
    "string_type": "a text",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "float_parsing": "a number",
}
"""What a value should have been, by the kind of mistake: the library's own words are Python's."""


def load_config(path: Path, overrides: Sequence[str] = ()) -> Config:
    """The config in `path`, with `--set` overrides such as `wire.gauge=20 AWG` applied.

    Where it has no name it gets that of its file, made safe (`naming.named_after`).

    Raises ConfigError with `file:line:column key` for the first mistake.
    """
    written = read_blocks(path)
    data = _plain(written)
    for override in overrides:
        _apply(data, override)
    config = _validated(data, _Source(written, path, overrides))
    return config if config.name else config.model_copy(update={"name": named_after(path)[0]})


def default_config(overrides: Sequence[str] = ()) -> Config:
    """The defaults with overrides, for what needs no drawing; raises ConfigError as `load_config` does."""
    data: dict[str, Any] = {"drawing": "none"}
    for override in overrides:
        _apply(data, override)
    return _validated(data, _Source({}, Path("config"), overrides))


@dataclass(frozen=True)
class _Source:
    """Where the data is from: `written` is the file's, and knows its lines."""

    written: dict[str, Any]
    path: Path
    overrides: Sequence[str]


def _validated(data: dict[str, Any], source: _Source) -> Config:
    try:
        return Config.model_validate(data)
    except ValidationError as error:
        raise _first_mistake(error, data, source) from None


def _apply(data: dict[str, Any], override: str) -> None:
    key, equals, text = override.partition("=")
    where, blocks = _set(override), key.split(".")
    if not equals or not all(blocks) or not key.isprintable():
        raise ConfigError("not of the form key=value", where, "write for example --set wire.gauge='20 AWG'")
    if len(override) > LONGEST_OVERRIDE or len(blocks) > DEEPEST:
        raise ConfigError("this is too long or too deep", where, "see `wrapit schema` for the keys")
    inner: Any = data
    for name in blocks[:-1]:
        inner = inner.setdefault(name, {}) if isinstance(inner, dict) else inner
    if not isinstance(inner, dict):
        raise ConfigError(
            f"{'.'.join(blocks[:-1])} is no block of keys", where, "see `wrapit schema` for the keys"
        )
    try:
        inner[blocks[-1]] = _plain(read_yaml(text, where))
    except ConfigError as error:
        raise ConfigError(error.problem, where, error.remedy) from None  # one line needs no line number


def _set(override: str) -> str:
    return f"--set {shortened(printable(override), 80)}"


def _plain(value: Any) -> Any:
    """ruamel's annotated containers and scalars as plain ones, so that type errors read well."""
    from ruamel.yaml.scalarbool import ScalarBoolean

    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, ScalarBoolean):  # one with an anchor, which is a whole number for Python
        return bool(value)
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return value if value is None else str(value)


def _first_mistake(error: ValidationError, data: dict[str, Any], source: _Source) -> ConfigError:
    mistake = error.errors(include_url=False)[0]
    keys = _user_keys(mistake["loc"], data)
    dotted = ".".join(map(str, keys))
    problem, remedy = _explain(mistake, keys)
    for override in reversed(source.overrides):
        if f"{dotted}.".startswith(f"{override.partition('=')[0]}."):
            return ConfigError(problem, _set(override), remedy)
    place = f"{_position(source.written, keys, source.path)} {shortened(printable(dotted), 80)}"
    return ConfigError(problem, place.rstrip(), remedy)


def _user_keys(loc: Sequence[str | int], data: Any) -> list[str | int]:
    """The part of pydantic's location that the user wrote (it also names union members)."""
    keys: list[str | int] = []
    inner = data
    for index, key in enumerate(loc):
        indexed = isinstance(inner, list) and isinstance(key, int) and key < len(inner)
        if indexed or (isinstance(inner, dict) and key in inner):
            inner = inner[key]
        elif not (isinstance(inner, dict) and index == len(loc) - 1):
            continue
        keys.append(key)
    return keys


def _position(data: Any, keys: Sequence[str | int], path: Path) -> str:
    line, column = 0, 0
    inner = data
    for key in keys:
        marks = getattr(inner, "lc", None)
        if marks is None or not marks.data or key not in marks.data:
            break
        line, column = marks.data[key][:2]
        inner = inner[key]
    return f"{printable(str(path))}:{line + 1}:{column + 1}"


def _explain(mistake: Mapping[str, Any], keys: Sequence[str | int]) -> tuple[str, str]:
    kind, context = mistake["type"], mistake.get("ctx", {})
    if kind == "extra_forbidden":
        return "unknown key", _nearest(str(keys[-1])[:80], _known_keys(keys[:-1]))
    if kind == "missing":
        return "this key is missing", "add it; `wrapit schema` describes every key"
    if kind == "value_error":
        problem, _, remedy = str(context["error"]).partition("; ")
        return problem, remedy
    if kind in ("literal_error", "union_tag_invalid"):
        given, expected = mistake["input"], str(context.get("expected") or context.get("expected_tags"))
        names = [name.strip(" '") for name in expected.replace(" or ", ", ").split(",")]
        return f"{shown(given)} is not one of {expected}", _nearest(shown(given), names)
    if kind in ("too_long", "too_short"):
        count, bound = context["actual_length"], context.get("max_length", context.get("min_length"))
        bound_is = "most" if kind == "too_long" else "least"
        return f"a list of {count} is too {kind[4:]}", f"give at {bound_is} {bound}"
    text = f"expected {_EXPECTED[kind]}" if kind in _EXPECTED else str(mistake["msg"])
    problem = f"{text[0].lower()}{text[1:]}, but got {shown(mistake['input'])}"
    return problem, "`wrapit schema` describes every key"


def _known_keys(blocks: Sequence[str | int]) -> list[str]:
    model: type[BaseModel] = Config
    for key in blocks:
        annotation = model.model_fields[str(key)].annotation if str(key) in model.model_fields else None
        if isinstance(annotation, UnionType):  # a block that may be left out
            annotation = next((each for each in get_args(annotation) if each is not type(None)), None)
        if not (isinstance(annotation, type) and issubclass(annotation, BaseModel)):
            return []
        model = annotation
    return list(model.model_fields)


def _nearest(word: str, known: Sequence[str]) -> str:
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    if close:
        return f"did you mean {close[0]!r}?"
    return f"known here: {', '.join(known)}" if known else "`wrapit schema` describes every key"
