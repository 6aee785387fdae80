"""What a config's YAML may hold: checked on its stream of events, before anything is built from it.

An event is a mark of the text (a scalar, the begin or end of a list or block, an alias), so that nesting
and aliases cost nothing here, however deep they are and however much they stand for.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, Final

from wrapit.calling import pasted
from wrapit.errors import ConfigError
from wrapit.units import printable, shortened

DEEPEST: Final = 32
"""Blocks and lists within each other; a config has five."""
MOST_NODES: Final = 10_000
"""Keys and values, each counted as often as aliases repeat it; a config has some hundred."""
MOST_DIGITS: Final = 100
"""Of one number; Python refuses to convert 4301, and no quantity of a config has more than some ten."""
_NUMERIC: Final = re.compile(r"[-+]?[0-9.][-+0-9_.,:eExXoOa-fA-F]*")
"""What the YAML library would take for a number."""
_KEY: Final = re.compile(r"(?!(?:null|true|false)$)[^\W\d].*|<<", re.IGNORECASE)
"""A word, or YAML's merge key; what YAML takes for null or a truth value is none."""


def check_budgets(events: Iterable[Any], where: str) -> None:
    """Reads all `events` of a YAML text; ConfigError with `where:line:column` for the first beyond.

    Refused are more than 32 levels, more than 10,000 nodes, values that contain themselves, tags, directives,
    several documents, keys that are no text, endless numbers, and halves of characters.
    """
    stream = _Stream(where)
    for event in events:
        stream.read(event)


@dataclass
class _Open:
    """A list or block whose end is still to come."""

    anchor: str | None
    is_block: bool
    nodes_before: int
    children: int = 0

    @property
    def awaits_key(self) -> bool:
        return self.is_block and self.children % 2 == 0


@dataclass
class _Stream:
    where: str
    nodes: int = 0
    documents: int = 0
    open: list[_Open] = field(default_factory=list)
    sizes: dict[str, int] = field(default_factory=dict)
    """Nodes that each anchor stands for."""

    def read(self, event: Any) -> None:
        kind = type(event).__name__.removesuffix("Event")
        if kind == "DocumentStart":
            self._begin_document(event)
        elif kind in ("Scalar", "Alias", "MappingStart", "SequenceStart"):
            self._begin_node(event, kind)
        elif kind in ("MappingEnd", "SequenceEnd"):
            ended = self.open.pop()
            if ended.anchor is not None:
                self.sizes[ended.anchor] = self.nodes - ended.nodes_before

    def _begin_document(self, event: Any) -> None:
        self.documents += 1
        if self.documents > 1:
            raise self._refuse(event, "a second document begins here", "keep one, and take '---' away")
        if event.version or event.tags:
            raise self._refuse(event, "a YAML directive has no meaning in a config", "take the % line away")

    def _begin_node(self, event: Any, kind: str) -> None:
        if getattr(event, "tag", None):
            tag = shortened(printable(str(event.tag)), 60)
            raise self._refuse(event, f"the tag {tag} has no meaning in a config", "take it away")
        if self.open:
            if self.open[-1].awaits_key:
                self._check_key(event, kind)
            self.open[-1].children += 1
        before = self.nodes
        self.nodes += self._size_of_alias(event) if kind == "Alias" else 1
        if self.nodes > MOST_NODES:
            raise self._refuse(
                event,
                f"more than {MOST_NODES:,} values, counting each as often as aliases repeat it",
                "write less of them",
            )
        if kind == "Scalar":
            self._check_scalar(event)
            if event.anchor is not None:
                self.sizes[event.anchor] = 1
        elif kind != "Alias":
            self._open(event, kind, before)

    def _open(self, event: Any, kind: str, nodes_before: int) -> None:
        if len(self.open) == DEEPEST:
            raise self._refuse(
                event,
                f"blocks and lists lie more than {DEEPEST} levels deep",
                f"see `{pasted('schema')}` for the keys",
            )
        self.open.append(_Open(event.anchor, kind == "MappingStart", nodes_before))

    def _size_of_alias(self, event: Any) -> int:
        if any(each.anchor == event.anchor for each in self.open):
            name = shortened(printable(event.anchor), 40)
            raise self._refuse(event, f"*{name} stands for something that contains it", "write it out")
        return self.sizes.get(event.anchor, 1)  # one without an anchor is refused by whoever builds

    def _check_key(self, event: Any, kind: str) -> None:
        is_text = kind == "Scalar" and (event.style in ("'", '"') or _KEY.fullmatch(event.value))
        if not is_text:
            shown = repr(shortened(printable(event.value), 40)) if kind == "Scalar" else "here"
            raise self._refuse(
                event, f"the key {shown} is not a word", f"see `{pasted('schema')}` for the keys"
            )

    def _check_scalar(self, event: Any) -> None:
        text = event.value
        if any("\ud800" <= letter <= "\udfff" or letter == "\0" for letter in text):
            raise self._refuse(event, "this text holds a character that can't be written", "take it away")
        if event.style is None and len(text) > MOST_DIGITS and _NUMERIC.fullmatch(text):
            raise self._refuse(event, f"this number has {len(text)} digits", "choose a smaller one")

    def _refuse(self, event: Any, problem: str, remedy: str) -> ConfigError:
        mark = event.start_mark
        return ConfigError(problem, f"{self.where}:{mark.line + 1}:{mark.column + 1}", remedy)
