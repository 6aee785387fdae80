"""What the page offers to change, a control for each key; all it says comes from the config's models."""

from __future__ import annotations

import types
from collections.abc import Mapping
from typing import Any, Final, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from wrapit.config import Config
from wrapit.config.choices import meant
from wrapit.config.quantities import PlaceRange
from wrapit.config.ranges import Mark, NumberRange, QuantityRange
from wrapit.studio.text.values import value_at

CONTROLS: Final = (
    ("piece", "", "size", "Size"),
    ("piece", "", "fit", "Fit for wire"),
    ("piece", "", "beads", "Beads"),
    ("piece", "", "pair", "Pair"),
    ("piece", "", "bail", "Bail"),
    ("piece", "bail", "at", "Place of the bail"),
    ("piece", "bail", "diameter", "Inside of the bail"),
    ("wire", "wire", "gauge", "Gauge"),
    ("wire", "wire", "metal", "Metal"),
    ("wire", "wire", "temper", "Temper"),
    ("wires", "decomposition", "max_wires", "Fewest wires"),
    ("wires", "decomposition", "doubling", "Run along lines twice"),
    ("wires", "decomposition", "choice", "Alternative"),
    ("wires", "decomposition.weights", "smoothness", "Smoothness"),
    ("wires", "decomposition.weights", "robustness", "Robustness"),
    ("wires", "decomposition.weights", "symmetry", "Symmetry"),
    ("wires", "decomposition.weights", "bridges", "Cost of a bridge"),
    ("wires", "decomposition.weights", "doubling", "Cost of a second run"),
    ("wires", "decomposition", "bridges", "Bridges"),
    ("wires", "decomposition", "refine_dangling", "Double hanging wires"),
    ("wires", "decomposition", "solver", "Solver"),
    ("jig", "", "jigs", "Jigs"),
    ("jig", "jig", "split", "One jig or several"),
    ("jig", "jig", "support", "Walls"),
    ("jig", "jig", "wall_thickness", "Thickness of walls"),
    ("jig", "jig", "min_wall_height", "Height of walls"),
    ("jig", "jig", "clearance", "Clearance"),
    ("jig", "jig", "springback", "Springback"),
    ("laser", "plate", "kerf", "Kerf"),
    ("laser", "plate", "sheet", "Sheet"),
    ("laser", "plate", "profile", "Profile"),
    ("guide", "guide", "language", "Language"),
    ("guide", "guide", "units", "Units"),
    ("guide", "guide", "paper", "Paper"),
    ("guide", "guide", "binding_gauge", "Binding wire"),
    ("files", "", "outputs", "Formats"),
)
"""Group, block, key and label, in the order of the page: what a crafter decides for a piece. The rest of the
schema is for the text. A key that the models don't have is left out."""


def controls(data: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The page's controls, with the values that a config's data gives.

    >>> size = controls({"drawing": "bee.png", "size": "4 cm"})[0]
    >>> size["key"], size["kind"], size["value"], size["given"], size["min"]
    ('size', 'optional-text', '4 cm', True, '3 mm')
    """
    missing = object()
    result = []
    for group, block, name, label in CONTROLS:
        key = f"{block}.{name}" if block else name
        field = field_at(key)
        if field is None:
            continue
        given = value_at(data, key, missing)
        about = _about(field)
        value = about["default"] if given is missing else given
        if _is_block(field):
            value = given is not missing and given is not None
        elif key.startswith("bail.") and value is not None:
            value = value if isinstance(value, str) else str(value).replace("'", "")
        value = _shown(about, value)
        head = {"key": key, "group": group, "label": label, "help": field.description or _of_block(field)}
        result.append({**head, **about, "value": value, "given": given is not missing})
    return result


def constraint_entries(data: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The config's constraints, each with a sentence.

    >>> constraint_entries({"decomposition": {"constraints": [{"same_wire": [3, 7]}]}})[0]["text"]
    'segments 3 and 7 on one wire'
    """
    listed = value_at(data, "decomposition.constraints")
    items = listed if isinstance(listed, list) else []
    return [
        {"index": index, "text": _sentence(item), "constraint": item if isinstance(item, dict) else {}}
        for index, item in enumerate(items)
    ]


def numbers_at(data: Mapping[str, Any], key: str) -> list[int]:
    """The numbers of a list such as `drop`, each once; what is none is left to the text.

    >>> numbers_at({"drop": [5, "oak", 5, 2]}, "drop")
    [5, 2]
    """
    listed = value_at(data, key)
    items = listed if isinstance(listed, list) else []
    return [*dict.fromkeys(item for item in items if isinstance(item, int) and not isinstance(item, bool))]


def field_at(key: str) -> FieldInfo | None:
    """The model's field of a dotted key; None where there is none."""
    model: type[BaseModel] = Config
    *blocks, last = key.split(".")
    for name in blocks:
        block = _block(model.model_fields[name]) if name in model.model_fields else None
        if block is None:
            return None
        model = block
    return model.model_fields.get(last)


def from_page(key: str, value: Any) -> Any:
    """A control's value as the config writes it: a switch of a block is a block, and a place may be a point.

    None means that the key is to go.
    """
    field = field_at(key)
    if field is None or value is None:
        return value
    if _block(field) is not None and isinstance(value, bool):
        return {} if value else None
    if isinstance(_mark(field), PlaceRange) and isinstance(value, str) and value.strip() != "top":
        return _place(value.strip())
    return None if value == "" else value


def _shown(about: Mapping[str, Any], value: Any) -> Any:
    """A value as its control can show it: a choice as the list spells it, and whatever a text that doesn't
    hold says there."""
    words = about.get("choices", [])
    if about["kind"] == "choices":
        listed = value if isinstance(value, list) else [value] if value else []
        return [str(meant(each, words)) for each in listed]
    if about["kind"] == "switch":
        return value is True
    value = meant(value, words) if words else value
    return str(value) if isinstance(value, dict | list) else value


def _place(text: str) -> Any:
    if text.isdecimal() and len(text) < 10:
        return int(text)
    return [part.strip() for part in text[1:-1].split(",")] if text[:1] + text[-1:] == "[]" else text


def _about(field: FieldInfo) -> dict[str, Any]:
    """Kind, default and range of a field."""
    mark, annotation = _mark(field), field.annotation
    if _block(field) is not None:
        return {"kind": "switch", "default": False}
    if mark is not None:
        return _about_mark(mark, field.default, optional=type(None) in get_args(annotation))
    if annotation is bool:
        return {"kind": "switch", "default": field.default}
    if get_origin(annotation) is tuple:
        choices = _choices(get_args(annotation)[0])
        return {"kind": "choices", "default": list(field.default), "choices": choices}
    choices = _choices(annotation)
    return {"kind": "choice" if choices else "text", "default": field.default, "choices": choices}


def _about_mark(mark: Mark, default: Any, *, optional: bool) -> dict[str, Any]:
    if isinstance(mark, NumberRange):
        step = {"step": 1} if mark.type == "integer" else {}
        return {"kind": "number", "default": default, "min": mark.at_least, "max": mark.at_most, **step}
    if isinstance(mark, QuantityRange):
        is_example = default is None or mark.check(mark.example) == default
        written = mark.example if is_example else mark.write(default)
        low, high = mark.texts
        kind = "optional-text" if optional else "text"
        shown = None if default is None else written
        return {"kind": kind, "default": shown, "min": low, "max": high, "example": mark.example}
    return {"kind": "text", "default": mark.write(default)}


def _choices(annotation: Any) -> list[str]:
    return list(get_args(annotation)) if get_origin(annotation) is Literal else []


def _mark(field: FieldInfo) -> Mark | None:
    """The mark that reads a field's values; optional fields have it inside."""
    inner = [each for part in get_args(field.annotation) for each in getattr(part, "__metadata__", ())]
    return next((each for each in (*field.metadata, *inner) if isinstance(each, Mark)), None)


def _block(field: FieldInfo) -> type[BaseModel] | None:
    annotation = field.annotation
    parts = get_args(annotation) if get_origin(annotation) in (Union, types.UnionType) else (annotation,)
    return next((part for part in parts if isinstance(part, type) and issubclass(part, BaseModel)), None)


def _is_block(field: FieldInfo) -> bool:
    return _block(field) is not None


def _of_block(field: FieldInfo) -> str:
    block = _block(field)
    return (block.__doc__ or "").strip() if block is not None else ""


def _sentence(item: Any) -> str:
    if not isinstance(item, dict):
        return str(item)
    said = {key: value for key, value in item.items() if key != "at"}
    key, value = next(iter(said.items()), ("", ""))
    numbers = " and ".join(map(str, value)) if isinstance(value, list) else str(value)
    at = f" at junction {item['at']}" if "at" in item else ""
    sentences = {
        "same_wire": f"segments {numbers} on one wire",
        "different_wire": f"segments {numbers} on different wires",
        "through": f"a wire passes straight between segments {numbers}{at}",
        "not_through": f"no wire passes between segments {numbers}{at}",
        "start_at": f"a wire starts or ends at junction {numbers}",
        "cut_at": f"all wires end at junction {numbers}",
        "max_wire_length": f"no wire longer than {numbers}",
    }
    return sentences.get(key, f"{key}: {numbers}")
