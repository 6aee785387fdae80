"""The presets that come with the program: configs without a drawing, such as `:pendant`."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import Final

from wrapit.errors import ConfigError

FOLDER: Final = Path(__file__).parent.parent / "presets"
"""Of package data: each file here is a preset."""
MARK: Final = ":"
"""In front of a preset's name, where a config's path may be too."""


def preset_names() -> list[str]:
    """What may stand after the mark.

    >>> preset_names()
    ['charm', 'earrings', 'pendant']
    """
    return sorted(path.stem for path in FOLDER.glob("*.yaml"))


def is_preset(path: Path) -> bool:
    """Whether a path names a preset; a file that is called so is given with its folder."""
    return str(path).startswith(MARK)


def preset_file(path: Path) -> Path:
    """Where the preset's text is. Raises ConfigError where there is none of that name."""
    name = str(path).lstrip(MARK).lower()  # bash, which parts words at colons, may complete to two
    names = preset_names()
    if name in names:
        return FOLDER / f"{name}.yaml"
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    known = ", ".join(f"{MARK}{each}" for each in names)
    remedy = f"did you mean '{MARK}{close[0]}'?" if close else f"choose one of {known}"
    raise ConfigError("no such preset", str(path), remedy)
