"""What each step of a build depends on: other steps, and keys of the config. Here alone it is said.

A step that reads more than is said here would be answered with what was made for another config.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

from wrapit.config import Config
from wrapit.pipeline.cache.fingerprint import key_of


@dataclass(frozen=True)
class Step:
    """`upon` are steps whose values it takes; `reads` keys of the config, or blocks with all their keys."""

    upon: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()


STEPS: Final[dict[str, Step]] = {
    "trace": Step(reads=("size", "tracing")),
    "drawing": Step(("trace",), ("decomposition.bridges",)),
    "decomposition": Step(("trace",), ("decomposition",)),
    "sketch": Step(("wires",)),
    "alternatives": Step(("wires",)),
    "wires": Step(("decomposition",), ("wire", "guide.margin", "bail", "jig")),
    "jig printed": Step(("wires",), ("jig", "wire", "outputs", "name")),
    "jig sheet": Step(("wires",), ("jig", "wire", "plate", "outputs")),
    "jig pegs": Step(("wires",), ("jig", "wire", "plate", "pegs", "outputs")),
    "mirrored jig": Step(("wires",), ("jigs", "pair")),
    "wires.step": Step(("wires",), ("name",)),
    "views": Step(("wires",)),
    "guide": Step(("wires", "mirrored jig"), ("jigs", "guide", "wire", "name", "outputs", "pair")),
}
"""Steps by name. `jig sheet` and so on are those of a kind."""


class Keys:
    """Keys of the steps of one build: hashes of the drawing and of the parts of the config that it reads."""

    def __init__(self, config: Config, drawing_sha256: str, suffix: str) -> None:
        self._settings = config.model_dump(mode="json")
        self._drawing = (drawing_sha256, suffix)

    def of(self, step: str, *also: Any, upon: Iterable[str] = ()) -> str:
        """The key of a step; `also` is JSON that it depends on too, `upon` more steps that it is upon."""
        read = {path for each in (step, *upon) for path in all_reads(each)}
        settings = {path: _part(self._settings, path) for path in read}
        return key_of(step, self._drawing, settings, *also)


def all_reads(step: str) -> set[str]:
    """Keys of the config that a step depends on, itself and by way of others."""
    said = STEPS[step]
    return set(said.reads).union(*map(all_reads, said.upon))


def _part(settings: Any, path: str) -> Any:
    for name in path.split("."):
        settings = settings[name]
    return settings
