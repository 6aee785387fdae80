"""What a shell offers behind Tab: configs and presets, drawings, stages, keys of the config."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import typer

_CONFIGS: Final = (".yaml", ".yml")
_DRAWINGS: Final = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp", ".svg", ".json")
"""Ends of the files that are offered; others may be typed."""


def configs(ctx: typer.Context, incomplete: str) -> list[str]:
    """Files of YAML, folders, and presets."""
    from wrapit.config.texts.presets import MARK, preset_names

    before = [str(path) for path in ctx.params.get("configs") or ()]
    if before and before[-1] == MARK:  # bash parts words at colons: the mark is a word of its own
        return [name for name in preset_names() if name.startswith(incomplete)]
    presets = [f"{MARK}{name}" for name in preset_names()]
    return [*(each for each in presets if each.startswith(incomplete)), *_files(incomplete, _CONFIGS)]


def config_files(incomplete: str) -> list[str]:
    """Files of YAML, and folders."""
    return list(_files(incomplete, _CONFIGS))


def drawings(incomplete: str) -> list[str]:
    """Files that may be drawings, and folders."""
    return list(_files(incomplete, _DRAWINGS))


def pieces(incomplete: str) -> list[str]:
    """Files of YAML or what may be drawings, and folders."""
    return list(_files(incomplete, (*_CONFIGS, *_DRAWINGS)))


def stages(incomplete: str) -> list[str]:
    """The stages of a build.

    >>> stages("d")
    ['drawing', 'decomposition']
    """
    from wrapit.pipeline.work import STAGES

    return [stage for stage in STAGES if stage.startswith(incomplete)]


def presets(incomplete: str) -> list[str]:
    """The presets by their names alone."""
    from wrapit.config.texts.presets import preset_names

    return [name for name in preset_names() if name.startswith(incomplete)]


def overrides(incomplete: str) -> list[str]:
    """The keys of the config that have a value.

    >>> overrides("wire.t")
    ['wire.temper=']
    """
    from wrapit.config.texts.mistakes import all_keys

    keys = list(all_keys())
    single = (key for key in keys if not any(other.startswith(f"{key}.") for other in keys))
    return [f"{key}=" for key in single if key.startswith(incomplete)]


def _files(incomplete: str, ends: tuple[str, ...]) -> Iterator[str]:
    folder, slash, start = incomplete.rpartition("/")
    try:
        entries = sorted(Path(f"{folder}{slash}" or ".").iterdir())
    except OSError:
        return  # no such folder: nothing to offer
    for entry in entries:
        hidden = entry.name.startswith(".") and not start.startswith(".")
        if entry.name.startswith(start) and not hidden:
            if entry.is_dir():
                yield f"{folder}{slash}{entry.name}/"
            elif entry.suffix.lower() in ends:
                yield f"{folder}{slash}{entry.name}"
