"""Text files, whole or not at all."""

from __future__ import annotations

import tempfile
from pathlib import Path


def write_text(path: Path, text: str) -> None:
    """UTF-8 with Unix line ends, whatever the machine."""
    path.write_text(text, encoding="utf-8", newline="\n")


def write_whole(path: Path, text: str) -> None:
    """The same, by way of a temporary file beside it that vanishes where something fails.

    Raises OSError when the place can't be written.
    """
    with tempfile.TemporaryDirectory(prefix=".wrapit-", dir=path.parent) as folder:
        partial = Path(folder) / "text"
        write_text(partial, text)
        partial.replace(path)
