"""A dependency file for make, as compilers write it: what a piece was built from, and what was built."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from wrapit.errors import ExportError
from wrapit.pipeline.textfile import write_whole


def write_depfile(path: Path, target: Path, sources: Sequence[Path], products: Sequence[Path]) -> None:
    """Writes `target: sources products`, and an empty rule for each of these.

    By the empty rules, make builds the target again when one of them is gone (and says nothing against a
    source that was renamed). Raises ExportError when the file can't be written.
    """
    needed = [make_name(each) for each in (*sources, *products)]
    lines = [f"{_as_target(make_name(target))}: {' '.join(needed)}"]
    lines += [f"{_as_target(name)}:" for name in needed]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, "\n".join(lines) + "\n")
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ExportError(f"can't be written ({reason.lower()})", str(path), "choose another -MF") from None


def make_name(path: Path) -> str:
    r"""A path as make reads it.

    >>> make_name(Path("art/my $1 #2.png"))
    'art/my\\ $$1\\ \\#2.png'
    """
    text = os.path.normpath(path) if ".." not in path.parts else str(path)
    text = f"./{text}" if text.startswith("~") else text  # else somebody's home
    return re.sub(r"([\s#:*?\[\]])", r"\\\1", text.replace("$", "$$"))


def _as_target(name: str) -> str:
    """Left of the colon a percent sign would make the rule a pattern."""
    return name.replace("%", "\\%")
