"""Where entries are kept, and how many bytes of them, as the user and the system want it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

from wrapit.errors import ConfigError
from wrapit.pipeline.cache.store import Store

# The environment's names for the folder (empty or `off`: none), and for how much it may hold, in MB.
FOLDER, MOST_MB = "WRAPIT_CACHE", "WRAPIT_CACHE_MB"
# A piece of ours takes 1 to 15 MB with all its stages: this is a catalogue of a hundred.
USUAL_MB: Final = 1000


def usual_store(*, reading: bool = True) -> Store:
    """The store in the user's cache folder, or where `WRAPIT_CACHE` says.

    Raises ConfigError where `WRAPIT_CACHE` is in nobody's home, or `WRAPIT_CACHE_MB` is no number.
    """
    said = os.environ.get(FOLDER)
    if said is not None and said.strip().lower() in ("", "off"):
        return Store()
    if said is None:
        from platformdirs import user_cache_path

        try:
            root = user_cache_path("wrapit", appauthor=False)
        except RuntimeError:  # a user without a home, as services and containers have them
            return Store(trouble="no home folder is known")
    else:
        try:
            root = Path(said).expanduser()
        except RuntimeError:
            raise ConfigError(
                f"{said!r} is in no home that is known", FOLDER, "write the whole path"
            ) from None
    # A folder of its own within, for its rights are changed to the user's alone.
    return Store((root / "stages").absolute(), _most_mb() * 1_000_000, reading)


def _most_mb() -> int:
    text = os.environ.get(MOST_MB, str(USUAL_MB))
    if not (text.isascii() and text.isdecimal()):
        raise ConfigError(f"{text!r} is no whole number of MB", MOST_MB, f"such as {USUAL_MB}")
    return int(text)
