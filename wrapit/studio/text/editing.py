"""Changes to a config's text: the lines that a change is about differ, all else stays byte for byte.

A YAML library that reads and writes again keeps comments, but not each blank, quote and line length. So its
marks (where each value begins and ends) say where to splice the text. After each splice the new text is read,
and has to say what the old one said with the change applied; where it doesn't, as with anchors, ruamel writes
the whole text anew, and where that doesn't say it either the change is refused.
"""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, Final

from wrapit.config.texts.reading import UNREADABLE
from wrapit.errors import ConfigError
from wrapit.studio.text.splicing import relisted, removed, replaced
from wrapit.studio.text.values import BOM, plain, said, value_at, with_value, without_value
from wrapit.units import printable, shortened

# Where wishes about wires are listed.
CONSTRAINTS: Final = "decomposition.constraints"
# Words with dots between them; the config has three levels at most.
_KEY: Final = re.compile(r"[a-z_]{1,40}(\.[a-z_]{1,40}){0,4}")
# Unlike null, which a text may say.
_MISSING: Final = object()


@dataclass(frozen=True)
class Change:
    """What is to become of a config, all of it together: dotted keys to set and to take away, constraints to
    add at the end, and the numbers of those to drop; numbers that lists are to get, or to lose wherever they
    stand in them."""

    set: Mapping[str, Any] = field(default_factory=dict)
    unset: Sequence[str] = ()
    constrain: Sequence[Mapping[str, Any]] = ()
    release: Sequence[int] = ()
    add: Mapping[str, Sequence[int]] = field(default_factory=dict)
    take: Mapping[str, Sequence[int]] = field(default_factory=dict)


def change_from(document: object) -> Change:
    """A change as the page sends it. Raises ConfigError for anything else."""
    parts = {each.name for each in fields(Change)}
    if not isinstance(document, dict) or not document.keys() <= parts:
        raise _refusal(f"a change is a block of {', '.join(sorted(parts))}", "change")
    change = Change(**document)
    shapes = (
        ("set", isinstance(change.set, dict)),
        ("unset", _is_list_of(change.unset, str)),
        ("constrain", _is_list_of(change.constrain, dict)),
        ("release", _is_list_of(change.release, int)),
        ("add", _has_lists_of_numbers(change.add)),
        ("take", _has_lists_of_numbers(change.take)),
    )
    for key, right in shapes:
        if not right:
            raise _refusal(f"{key!r} is not of the right kind", "change")
    for key in (*change.set, *change.unset, *change.add, *change.take):
        if not _KEY.fullmatch(key):
            raise _refusal("this can't be a key", shortened(printable(key), 80))
    return change


def edited(text: str, change: Change) -> str:
    """The text with a change applied; values are not judged here, but it is YAML and says what is asked.

    Raises ConfigError where the text is no YAML, or the change can't be applied.

    >>> print(edited("drawing: bee.png  # ours\\nsize: 40 mm\\n", Change(set={"size": "6 cm", "pair": True})))
    drawing: bee.png  # ours
    size: 6 cm
    pair: true
    <BLANKLINE>
    """
    mark = BOM if text.startswith(BOM) else ""
    text = text.removeprefix(BOM)
    data = said(text)
    constraints = _constraints(data, change)
    for key in change.unset:
        text, data = _without(text, data, key)
    for key, value in change.set.items():
        text, data = _with(text, data, key, value)
    lists = {key: _renumbered(data, key, change) for key in dict.fromkeys((*change.take, *change.add))}
    if constraints is not None:
        lists[CONSTRAINTS] = constraints
    for key, items in lists.items():
        text, data = _with(text, data, key, items) if items else _without(text, data, key)
    return mark + text


def _renumbered(data: Mapping[str, Any], key: str, change: Change) -> list[Any]:
    """A list of numbers as it is to be; a number that it has already isn't added again."""
    old = value_at(data, key)
    old = [] if old is None else old
    if not isinstance(old, list):
        raise _refusal("this is no list of numbers", key)
    kept = [item for item in old if item not in change.take.get(key, ())]
    return kept + [item for item in dict.fromkeys(change.add.get(key, ())) if item not in kept]


def _constraints(data: Mapping[str, Any], change: Change) -> list[Any] | None:
    """The new list of constraints; None where it stays as it is."""
    if not change.constrain and not change.release:
        return None
    old = value_at(data, CONSTRAINTS) or []
    if not isinstance(old, list):
        raise _refusal("this is no list of constraints", CONSTRAINTS)
    gone = [index for index in change.release if not 0 <= index < len(old)]
    if gone:
        raise _refusal(f"there is no constraint {gone[0]}", CONSTRAINTS)
    kept = [item for index, item in enumerate(old) if index not in change.release]
    return kept + [item for item in map(plain, change.constrain) if item not in kept]


def _with(text: str, data: dict[str, Any], key: str, value: Any) -> tuple[str, dict[str, Any]]:
    value = plain(value)
    old = value_at(data, key, _MISSING)
    if old is not _MISSING and old == value and type(old) is type(value):
        return text, data
    asked = with_value(data, key, value)
    splice = relisted if isinstance(value, list) and isinstance(old, list) else replaced
    return _checked(text, key, asked, lambda: splice(text, key.split("."), value)), asked


def _without(text: str, data: dict[str, Any], key: str) -> tuple[str, dict[str, Any]]:
    if value_at(data, key, _MISSING) is _MISSING:
        return text, data
    asked = without_value(data, key)
    gone, parent = key, key.rpartition(".")[0]
    while parent and value_at(asked, parent, _MISSING) is _MISSING:
        gone, parent = parent, parent.rpartition(".")[0]
    if parent and not value_at(asked, parent):
        return _checked(text, key, asked, lambda: replaced(text, parent.split("."), {})), asked
    return _checked(text, key, asked, lambda: removed(text, gone.split("."))), asked


def _checked(text: str, key: str, asked: dict[str, Any], splice: Any) -> str:
    """The first of the spliced text and of the one written anew that says what is asked."""
    for way in (splice, lambda: _written_anew(text, asked)):
        try:
            result = way()
            if said(result) == asked:
                return result
        except (ConfigError, ValueError, *UNREADABLE):
            continue  # the other way, or the refusal below
    raise _refusal("the text is written in a way that this can't be changed from here", key)


def _written_anew(text: str, asked: dict[str, Any]) -> str:
    from ruamel.yaml import YAML

    yaml = YAML(typ="rt")
    yaml.preserve_quotes = True
    yaml.width = 1_000_000  # no line is broken
    data = yaml.load(text)
    _become(data, asked)
    stream = io.StringIO()
    yaml.dump(data, stream)
    result = stream.getvalue()
    return result.replace("\n", "\r\n") if "\r\n" in text else result


def _become(data: Any, asked: Mapping[str, Any]) -> None:
    """Changes as few of the library's own values as possible, for these know their comments."""
    for key in [key for key in data if key not in asked]:
        del data[key]
    for key, value in asked.items():
        if key in data and isinstance(data[key], dict) and isinstance(value, dict):
            _become(data[key], value)
        elif key not in data or plain(data[key]) != value:
            data[key] = value


def _is_list_of(value: object, kind: type) -> bool:
    return isinstance(value, list | tuple) and all(
        isinstance(item, kind) and not (kind is int and isinstance(item, bool)) for item in value
    )


def _has_lists_of_numbers(value: object) -> bool:
    return isinstance(value, dict) and all(_is_list_of(items, int) for items in value.values())


def _refusal(problem: str, where: str) -> ConfigError:
    return ConfigError(problem, where, "change the text by hand")
