"""Splices of YAML text at the marks of its values: what lies between two marks is exchanged, nothing else.

Each function returns the new text and promises little: `editing` reads what came of it. What it can't do
raises ValueError.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any, Final

from pydantic import BaseModel

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.errors import ConfigError
from wrapit.studio.text.values import plain

_PLAIN: Final = re.compile(r"[A-Za-z0-9](?:[\w ./+-]*[\w./+-])?")
"""Texts that mean themselves wherever they stand, unless they read as a number or truth value."""
_ALONE: Final = re.compile(r" *, *(#.*)?\r?\n")
"""What may stand behind an item between brackets that has its lines for itself: they go with it."""
_INDENT: Final = 2
"""Blanks of a new block; as the shipped configs have it."""


def replaced(text: str, keys: Sequence[str], value: Any) -> str:
    """The text with a value at a path of keys, which is made where it is missing."""
    node = _root(text)
    if node is None:
        return _with_lines(text, len(text), _lines(keys, value, 0))
    for depth, key in enumerate(keys):
        if not _is_mapping(node):
            raise ValueError(f"no block at {key}")
        pair = _pair(node, key)
        if pair is None:
            return _inserted(text, node, keys[depth:], value, _order(keys[:depth]))
        inner = pair[1]
        if depth == len(keys) - 1:
            colon = _colon(text, pair[0])
            if _is_nothing(inner) and colon is not None:
                return f"{text[:colon]} {flow(value)}{text[colon:]}"
            return _exchanged(text, inner, value)
        if _is_nothing(inner):
            indent = _column(text, pair[0].start_mark.index) + _INDENT
            return _with_lines(
                text, _after_line(text, _end(pair[0])), _lines(keys[depth + 1 :], value, indent)
            )
        node = inner
    raise ValueError("no keys")


def removed(text: str, keys: Sequence[str]) -> str:
    """The text without a key and its value: its lines, or its part of a line."""
    node = _root(text)
    for key in keys[:-1]:
        node = _known(node, key)[1]
    pairs = node.value
    index = next(index for index, pair in enumerate(pairs) if pair[0].value == keys[-1])
    start, end = pairs[index][0].start_mark.index, _end(pairs[index])
    if node.flow_style:
        return _without_item(text, [(a.start_mark.index, _end((a, b))) for a, b in pairs], index)
    return text[: _line_start(text, start)] + text[_after_line(text, end) :]


def relisted(text: str, keys: Sequence[str], values: Sequence[Any]) -> str:
    """The text with other values in a list; those that stay keep their place, style and comments."""
    node = _root(text)
    for key in keys:
        node = _known(node, key)[1]
    old = [_value(text, item) for item in node.value]
    kept: list[int] = []
    for index, item in enumerate(old):
        if len(kept) < len(values) and item == values[len(kept)]:
            kept.append(index)
    if not kept and (node.flow_style or not values):
        return _exchanged(text, node, list(values))
    added = values[len(kept) :]
    if node.flow_style:
        at = _end(node.value[-1])
        text = text[:at] + "".join(f", {flow(value)}" for value in added) + text[at:]
    else:
        dash = text[_line_start(text, node.value[0].start_mark.index) : node.value[0].start_mark.index]
        if not re.fullmatch(r" *- +", dash):
            raise ValueError("no list with an item a line")
        text = _with_lines(text, _after_line(text, _end(node)), [f"{dash}{flow(value)}" for value in added])
    for index in sorted(set(range(len(old))) - set(kept), reverse=True):
        item = node.value[index]
        if node.flow_style:
            text = _without_item(text, [(a.start_mark.index, _end(a)) for a in node.value], index)
        else:
            start = _line_start(text, item.start_mark.index)
            text = text[:start] + text[_after_line(text, _end(item)) :]
    return text


def flow(value: Any) -> str:
    """A value on one line, as it can stand anywhere in YAML.

    >>> flow({"same_wire": [3, 7], "note": "a: b", "on": True, "size": "40 mm", "version": "1.0"})
    '{same_wire: [3, 7], note: "a: b", on: true, size: 40 mm, version: "1.0"}'
    """
    if isinstance(value, dict):
        return "{" + ", ".join(f"{flow(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, str) and _PLAIN.fullmatch(value) and _reads_as(value, value):
        return value
    return json.dumps(value, ensure_ascii=False)


def _reads_as(text: str, value: str) -> bool:
    try:
        read = read_yaml(text, "")
    except ConfigError:
        return False
    return isinstance(read, str) and read == value


def _root(text: str) -> Any:
    from ruamel.yaml import YAML

    return YAML(typ="rt").compose(text)


def _order(blocks: Sequence[str]) -> list[str]:
    """The keys of a block as the schema lists them; none where it isn't known."""
    model: Any = Config
    for name in blocks:
        annotation = model.model_fields[name].annotation if name in model.model_fields else None
        kinds = (annotation, *getattr(annotation, "__args__", ()))
        model = next((each for each in kinds if isinstance(each, type) and issubclass(each, BaseModel)), None)
        if model is None:
            return []
    return list(model.model_fields)


def _inserted(text: str, node: Any, keys: Sequence[str], value: Any, order: Sequence[str]) -> str:
    """A new key behind those that the schema lists before it."""
    before = order[: order.index(keys[0])] if keys[0] in order else order
    behind = [index for index, pair in enumerate(node.value) if pair[0].value in before]
    index = behind[-1] if behind else -1
    if node.flow_style:
        for key in reversed(keys[1:]):
            value = {key: value}
        entry = f"{keys[0]}: {flow(value)}"
        if not node.value:
            return f"{text[: node.start_mark.index]}{{{entry}}}{text[node.end_mark.index :]}"
        if index < 0:
            at = node.value[0][0].start_mark.index
            return f"{text[:at]}{entry}, {text[at:]}"
        at = _end(node.value[index])
        return f"{text[:at]}, {entry}{text[at:]}"
    first = node.value[0][0].start_mark.index
    at = _after_line(text, _end(node.value[index])) if index >= 0 else _line_start(text, first)
    return _with_lines(text, at, _lines(keys, value, _column(text, first)))


def _exchanged(text: str, node: Any, value: Any) -> str:
    start, end = node.start_mark.index, _end(node)
    written = flow(value)
    quote = getattr(node, "style", None)
    if isinstance(value, str) and quote == "'":
        written = "'" + value.replace("'", "''") + "'"
    elif isinstance(value, str) and quote == '"':
        written = json.dumps(value, ensure_ascii=False)
    blank = " " if start == end else ""
    return f"{text[:start]}{blank}{written}{text[end:]}"


def _lines(keys: Sequence[str], value: Any, indent: int) -> list[str]:
    *blocks, last = keys
    lines = [f"{' ' * (indent + _INDENT * depth)}{name}:" for depth, name in enumerate(blocks)]
    return [*lines, f"{' ' * (indent + _INDENT * len(blocks))}{last}: {flow(value)}"]


def _with_lines(text: str, at: int, lines: Sequence[str]) -> str:
    newline = "\r\n" if "\r\n" in text else "\n"
    head = text[:at]
    if head and not head.endswith("\n"):
        head += newline
    return head + "".join(line + newline for line in lines) + text[at:]


def _without_item(text: str, spans: Sequence[tuple[int, int]], index: int) -> str:
    """The text without one of the items between brackets, and without a comma."""
    start, end = spans[index]
    first, last = _line_start(text, start), _after_line(text, end)
    if not text[first:start].strip() and _ALONE.fullmatch(text[end:last]):
        return text[:first] + text[last:]
    if index > 0:
        start = spans[index - 1][1]
    elif len(spans) > 1:
        end = spans[1][0]
    return text[:start] + text[end:]


def _known(node: Any, key: str) -> Any:
    pair = _pair(node, key) if _is_mapping(node) else None
    if pair is None:
        raise ValueError(f"no {key}")
    return pair


def _pair(node: Any, key: str) -> Any:
    return next((pair for pair in node.value if pair[0].value == key), None)


def _colon(text: str, key: Any) -> int | None:
    """Where the colon behind a key ends; a value of nothing has its mark anywhere behind it."""
    colon = re.compile(r" *:").match(text, _end(key))
    return colon.end() if colon else None


def _is_mapping(node: Any) -> bool:
    return type(node).__name__ == "MappingNode"


def _is_nothing(node: Any) -> bool:
    return type(node).__name__ == "ScalarNode" and node.value == "" and node.style is None


def _end(node: Any) -> int:
    """Where the last letter of a value (or of a key with its value) ends; a block's own mark lies behind the
    comments that follow it."""
    if isinstance(node, tuple):
        return max(_end(each) for each in node)
    if isinstance(node.value, str) or node.flow_style or not node.value:
        return int(node.end_mark.index)
    return _end(node.value[-1])


def _value(text: str, node: Any) -> Any:
    return plain(read_yaml(_dedented(text, node), ""))


def _dedented(text: str, node: Any) -> str:
    """A value's own text, with its first line as far right as it stands, so that the others fit."""
    start = node.start_mark.index
    return " " * _column(text, start) + text[start : _end(node)]


def _line_start(text: str, index: int) -> int:
    return text.rfind("\n", 0, index) + 1


def _column(text: str, index: int) -> int:
    return index - _line_start(text, index)


def _after_line(text: str, index: int) -> int:
    """Where the line after that of an index starts."""
    end = text.find("\n", index)
    return len(text) if end < 0 else end + 1
