"""Several configs as one: merged key by key, each key knowing the file that said it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wrapit.config.texts.presets import is_preset, preset_file
from wrapit.config.texts.reading import read_blocks
from wrapit.units import printable


@dataclass(frozen=True)
class Written:
    """One config: its blocks, which know their lines, and what it is called by whoever gave it."""

    path: Path
    blocks: dict[str, Any]

    @property
    def preset(self) -> bool:
        return is_preset(self.path)

    def position(self, keys: Sequence[str | int]) -> tuple[int, str]:
        """How many of the keys this file says, and `file:line:column` of the last of them."""
        line, column, depth = 0, 0, 0
        inner: Any = self.blocks
        for key in keys:
            marks = getattr(inner, "lc", None)
            if marks is None or not marks.data or key not in marks.data:
                break
            line, column = marks.data[key][:2]
            inner, depth = inner[key], depth + 1
        return depth, f"{printable(str(self.path))}:{line + 1}:{column + 1}"


def read_written(path: Path) -> Written:
    """A file or a preset. Raises ConfigError where it can't be read."""
    return Written(path, read_blocks(preset_file(path) if is_preset(path) else path))


def merged(blocks: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """One block of several: blocks in them are merged too, of anything else the last one counts.

    >>> merged([{"wire": {"gauge": 1, "temper": 5}, "jigs": [1, 2]}, {"wire": {"gauge": 2}, "jigs": [3]}])
    {'wire': {'gauge': 2, 'temper': 5}, 'jigs': [3]}
    """
    whole: dict[str, Any] = {}
    for block in blocks:
        for key, value in block.items():
            earlier = whole.get(key)
            if isinstance(earlier, dict) and isinstance(value, dict):
                whole[key] = merged([earlier, value])
            else:
                whole[key] = value
    return whole


def place_of(keys: Sequence[str | int], written: Sequence[Written]) -> str:
    """Where the keys were said: by the last of those that say most of them."""
    places = [each.position(keys) for each in written]
    deepest = max((depth for depth, _ in places), default=0)
    return next((place for depth, place in reversed(places) if depth == deepest), "config")


def seen_from(folder: Path, drawing: str, said_in: Path) -> str:
    """A drawing that a config in the folder `said_in` names, as one in `folder` has to name it.

    Links are followed first, or `..` would lead elsewhere.
    """
    here, there = os.path.realpath(folder), os.path.realpath(said_in)
    if here == there or Path(drawing).is_absolute():
        return drawing
    path = Path(there, drawing)
    try:
        return Path(os.path.relpath(path, here)).as_posix()
    except ValueError:  # another drive of Windows
        return str(path)
