"""Words to choose from: which there are, and the ways in which people spell them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any, Final, Literal, get_args, get_origin

# Between the words of a choice: `dead soft`, `dead-soft`, `dead_soft` and `deadsoft` are the same.
_BETWEEN: Final = r"[ _-]*"


def choices(annotation: object) -> Iterator[str]:
    """The words of the `Literal`s in an annotation.

    >>> list(choices(tuple[Literal["stl", "3mf"], ...] | None))
    ['stl', '3mf']
    """
    for inner in get_args(annotation):
        if get_origin(annotation) is not Literal:
            yield from choices(inner)
        elif isinstance(inner, str):
            yield inner


def folded(word: str) -> str:
    """What the spellings of one word have in common.

    >>> folded("Dead_Soft") == folded("dead soft") == folded("dead-soft")
    True
    """
    return re.sub(_BETWEEN, "", word).lower()


def meant(value: object, words: Sequence[str]) -> object:
    """The choice that a value means, or a list of them, as `words` spell it; anything else as it is.

    >>> meant(["STL", "3 MF", "oak", 4], ["stl", "3mf"])
    ['stl', '3mf', 'oak', 4]
    """
    if words and isinstance(value, list | tuple):
        return type(value)(meant(each, words) for each in value)
    if not isinstance(value, str):
        return value
    return next((word for word in words if folded(word) == folded(value)), value)


def spelled(words: Sequence[str]) -> dict[str, Any]:
    """A JSON schema of all spellings of some words; JavaScript has its pattern too.

    >>> bool(re.fullmatch(spelled(["half hard"])["pattern"], "Half-Hard"))
    True
    """
    patterns = [_BETWEEN.join(map(_either_case, folded(word))) for word in words]
    return {"type": "string", "pattern": f"^{_BETWEEN}({'|'.join(patterns)}){_BETWEEN}$"}


def _either_case(letter: str) -> str:
    return f"[{letter.upper()}{letter}]" if letter.isalpha() else re.escape(letter)
