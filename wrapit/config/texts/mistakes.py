"""What is said of a mistake: what is wrong, the place that the user wrote, and a remedy."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from wrapit.calling import pasted
from wrapit.config.choices import folded
from wrapit.config.root import Config
from wrapit.units import shown

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
_NEAR: Final = 0.5
"""How alike two words are at least for one to be meant by the other (difflib's ratio)."""
_VERY_NEAR: Final = 0.75
"""A key as alike as this is meant whatever stands elsewhere: one wrong letter of four, two of nine."""


def user_keys(loc: Sequence[str | int], data: Any) -> list[str | int]:
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


def explain(mistake: Mapping[str, Any], keys: Sequence[str | int]) -> tuple[str, str]:
    """Problem and remedy of one of pydantic's mistakes at some keys."""
    kind, context = mistake["type"], mistake.get("ctx", {})
    if kind == "extra_forbidden":
        return "unknown key", _right_key(str(keys[-1])[:80], keys[:-1])
    if kind == "missing":
        return "this key is missing", f"add it; {_all_are_described()}"
    if kind == "value_error":
        problem, _, remedy = str(context["error"]).partition("; ")
        return problem, remedy
    if kind in ("literal_error", "union_tag_invalid"):
        given, expected = mistake["input"], str(context.get("expected") or context.get("expected_tags"))
        names = [name.strip(" '") for name in expected.replace(" or ", ", ").split(",")]
        return f"{shown(given)} is not one of {expected}", nearest(str(given)[:80], names)
    if kind in ("too_long", "too_short"):
        count, bound = context["actual_length"], context.get("max_length", context.get("min_length"))
        bound_is = "most" if kind == "too_long" else "least"
        return f"a list of {count} is too {kind[4:]}", f"give at {bound_is} {bound}"
    text = f"expected {_EXPECTED[kind]}" if kind in _EXPECTED else str(mistake["msg"])
    problem = f"{text[0].lower()}{text[1:]}, but got {shown(mistake['input'])}"
    return problem, _example(keys) or _all_are_described()


def nearest(word: str, known: Sequence[str]) -> str:
    """The remedy for a word that is not known: the nearest one, or all of them."""
    close = _close(word, known, _NEAR)
    if close:
        return f"did you mean {close!r}?"
    return f"known here: {', '.join(known)}" if known else _all_are_described()


def all_keys() -> Iterator[str]:
    """Every key of the config, dotted; blocks among them."""
    yield from _all_keys(Config)


def _right_key(word: str, blocks: Sequence[str | int]) -> str:
    """The remedy for an unknown key: one nearly like it, or the block where one of this name belongs."""
    block = _block_at(blocks)
    known = list(block.model_fields) if block is not None else []
    if not _close(word, known, _VERY_NEAR):
        same = folded(word)
        elsewhere = [each for each in all_keys() if folded(each.rpartition(".")[2]) == same]
        if len(elsewhere) == 1:
            return f"did you mean {elsewhere[0]!r}?"
    return nearest(word, known)


def _close(word: str, known: Sequence[str], cutoff: float) -> str | None:
    spelled = {folded(each): each for each in known}
    close = difflib.get_close_matches(folded(word), list(spelled), n=1, cutoff=cutoff)
    return spelled[close[0]] if close else None


def _example(keys: Sequence[str | int]) -> str | None:
    """How the list of blocks is written that the keys lead into, where it has an example."""
    for count in range(len(keys), 0, -1):
        field = _field_at(keys[:count])
        if field is not None and field.examples and isinstance(field.examples[0], list):
            entries = json.dumps(field.examples[0]).replace('"', "")
            return f"write for example {keys[count - 1]}: {entries}"
    return None


def _field_at(keys: Sequence[str | int]) -> FieldInfo | None:
    block = _block_at(keys[:-1])
    return block.model_fields.get(str(keys[-1])) if block is not None else None


def _block_at(keys: Sequence[str | int]) -> type[BaseModel] | None:
    """The block that the keys lead to, through lists of blocks too."""
    model: type[BaseModel] | None = Config
    for key in keys:
        if isinstance(key, int):
            continue  # an entry of the list whose block is known already
        field = model.model_fields.get(key) if model is not None else None
        model = _block_in(field.annotation) if field is not None else None
    return model


def _block_in(annotation: object) -> type[BaseModel] | None:
    """The block that an annotation speaks of: itself, one that may be left out, or a list of them."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for each in get_args(annotation) if (found := _block_in(each))), None)


def _all_keys(block: type[BaseModel], before: str = "") -> Iterator[str]:
    for name, field in block.model_fields.items():
        yield f"{before}{name}"
        inner = _block_in(field.annotation)
        if inner is not None:
            yield from _all_keys(inner, f"{before}{name}.")


def _all_are_described() -> str:
    return f"`{pasted('schema')}` describes every key"
