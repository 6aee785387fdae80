"""Reads a YAML config; every mistake is named with file, line, column and a remedy."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import UnionType
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from wrapit.config.root import Config
from wrapit.errors import ConfigError


def load_config(path: Path, overrides: Sequence[str] = ()) -> Config:
    """The config in `path`, with `--set` overrides such as `wire.gauge=20 AWG` applied.

    Raises ConfigError with `file:line:column key` for the first mistake.
    """
    data = _read_yaml(path)
    for override in overrides:
        _apply(data, override)
    try:
        config = Config.model_validate(_plain(data))
    except ValidationError as error:
        raise _first_mistake(error, data, path, overrides) from None
    return config if config.name else config.model_copy(update={"name": path.stem})


def _read_yaml(path: Path) -> dict[str, Any]:
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise ConfigError("no such config", str(path), "give the path of a .yaml file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigError(
            f"the config can't be read ({_reason(error)})", str(path), "give a YAML text file"
        ) from None
    try:
        data = YAML(typ="rt").load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{path}:{mark.line + 1}:{mark.column + 1}" if mark else str(path)
        problem = error.problem or error.context or "not valid YAML"
        raise ConfigError(
            f"not valid YAML: {problem}", place, "check indentation, colons and quotes"
        ) from None
    except (YAMLError, ValueError) as error:
        raise ConfigError(f"not valid YAML: {error}", str(path), "check indentation and quotes") from None
    if not isinstance(data, dict):
        raise ConfigError(
            "the config is not a block of keys", str(path), "start with 'drawing: my-drawing.png'"
        )
    return data


def _reason(error: Exception) -> str:
    return (getattr(error, "strerror", None) or str(error)).lower()


def _apply(data: dict[str, Any], override: str) -> None:
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    key, equals, text = override.partition("=")
    where = f"--set {override}"
    if not equals or not key:
        raise ConfigError("not of the form key=value", where, "write for example --set wire.gauge='20 AWG'")
    try:
        value = YAML(typ="safe").load(text)
    except YAMLError:
        raise ConfigError(f"the value {text!r} is not valid YAML", where, "put quotes around it") from None
    *blocks, last = key.split(".")
    inner: Any = data
    for name in blocks:
        inner = inner.setdefault(name, {}) if isinstance(inner, dict) else inner
    if not isinstance(inner, dict):
        raise ConfigError(
            f"{'.'.join(blocks)} is no block of keys", where, "see `wrapit schema` for the keys"
        )
    inner[last] = value


def _plain(value: Any) -> Any:
    """ruamel's annotated containers and scalars as plain ones, so that type errors read well."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return value if value is None else str(value)


def _first_mistake(
    error: ValidationError, data: dict[str, Any], path: Path, overrides: Sequence[str]
) -> ConfigError:
    mistake = error.errors(include_url=False)[0]
    keys = _user_keys(mistake["loc"], data)
    dotted = ".".join(map(str, keys))
    problem, remedy = _explain(mistake, keys)
    for override in overrides:
        if f"{dotted}.".startswith(f"{override.partition('=')[0]}."):
            return ConfigError(problem, f"--set {override}", remedy)
    return ConfigError(problem, f"{_position(data, keys, path)} {dotted}".rstrip(), remedy)


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
    return f"{path}:{line + 1}:{column + 1}"


def _explain(mistake: Mapping[str, Any], keys: Sequence[str | int]) -> tuple[str, str]:
    kind, context = mistake["type"], mistake.get("ctx", {})
    if kind == "extra_forbidden":
        return "unknown key", _nearest(str(keys[-1]), _known_keys(keys[:-1]))
    if kind == "missing":
        return "this key is missing", "add it; `wrapit schema` describes every key"
    if kind == "value_error":
        problem, _, remedy = str(context["error"]).partition("; ")
        return problem, remedy
    if kind in ("literal_error", "union_tag_invalid"):
        expected = str(context.get("expected") or context.get("expected_tags"))
        names = [name.strip(" '") for name in expected.replace(" or ", ", ").split(",")]
        return f"{mistake['input']!r} is not one of {expected}", _nearest(str(mistake["input"]), names)
    text = str(mistake["msg"])
    return f"{text[0].lower()}{text[1:]}, but got {mistake['input']!r}", "`wrapit schema` describes every key"


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
