"""Names of pieces: each becomes a folder, on any system, and a title in the guide."""

from __future__ import annotations

import unicodedata
from pathlib import Path
from typing import Final

from wrapit.units import shown

LONGEST_NAME: Final = 80
"""Letters: what a title in the guide and a line of a terminal hold."""
LONGEST_NAME_BYTES: Final = 200
"""In UTF-8: names of files are at most 255 bytes, and the program adds to the name."""
LONGEST_PART_BYTES: Final = 255
"""Of a path between two slashes, on all common systems."""
LONGEST_PATH: Final = 1000
"""Letters; systems take 1024 bytes (macOS) or more for a whole path."""
UNWRITABLE: Final = ("Cc", "Cs", "Zl", "Zp")
"""Control characters, halves of characters and ends of lines; odd spaces do occur, as in screenshots."""
UNNAMED: Final = "piece"
"""What is called so has a file name without any letter that a folder can have."""
DEVICES: Final = frozenset(
    {"con", "prn", "aux", "nul", *(f"{port}{digit}" for port in ("com", "lpt") for digit in "0123456789¹²³")}
)
"""Names of Windows for its devices; a file can't be called so, whatever comes after a dot."""


def named_after(path: Path) -> tuple[str, bool]:
    """The name of a piece whose config gives none, and whether it differs from the file's own.

    >>> named_after(Path("bee.yaml"))
    ('bee', False)
    >>> named_after(Path("<b>.yaml"))
    ('b-', True)
    """
    name = safe_name(path.stem)
    return name, name != path.stem


def safe_name(stem: str) -> str:
    """A name like `stem` that every system takes as a folder's and no program takes for an option.

    Letters and digits of all scripts, `_ . -` and space stay, the rest becomes `-`; no dash, dot, space or
    lone accent leads, no dot or space trails; never empty, at most 80 characters and 200 bytes of UTF-8.

    >>> safe_name("../Bee & Co."), safe_name("con"), safe_name("…")
    ('Bee - Co', 'con-piece', 'piece')
    """
    name = "".join(each if _stays(each) else "-" for each in stem)
    name = _cut(name.lstrip("".join({each for each in name if not _leads(each)})))
    base, dot, rest = name.partition(".")
    if base.rstrip().lower() in DEVICES:
        name = _cut(f"{base.rstrip()}-{UNNAMED}{dot}{rest}")
    return name or UNNAMED


def name_problem(name: str) -> str | None:
    """Why a name that was given can't be one, with a remedy after `; `; None where it can."""
    safe = safe_name(name)
    if safe == name:
        return None
    remedy = f"write for example {safe!r}"
    if len(name) > LONGEST_NAME or len(name.encode("utf-8", "replace")) > LONGEST_NAME_BYTES:
        return f"a name of {len(name)} letters is too long for a folder; {remedy}"
    return (
        f"{shown(name)} can't be the name of a folder on every system: letters, digits, '_', '.', '-' "
        "and spaces can, without '-', '.' or space in front, '.' or space behind, "
        f"but no device such as CON; {remedy}"
    )


def path_problem(path: str) -> str | None:
    """Why a path that was given can't be one, with a remedy after `; `; None where it can."""
    remedy = "write for example 'bee.png'"
    if not path.strip():
        return f"the path is empty; {remedy}"
    if any(unicodedata.category(letter) in UNWRITABLE for letter in path):
        return f"{shown(path)} holds characters that no path can have; {remedy}"
    longest = max(len(part.encode("utf-8")) for part in path.split("/"))
    if len(path) > LONGEST_PATH or longest > LONGEST_PART_BYTES:
        return f"a path of {len(path)} characters is too long; {remedy}"
    return None


def _stays(letter: str) -> bool:
    return letter in "_.- " or unicodedata.category(letter)[0] in "LMN"


def _leads(letter: str) -> bool:
    return letter == "_" or unicodedata.category(letter)[0] in "LN"


def _cut(name: str) -> str:
    short = name[:LONGEST_NAME].encode("utf-8")[:LONGEST_NAME_BYTES].decode("utf-8", "ignore")
    return short.rstrip(". ")
