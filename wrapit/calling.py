"""How this program was called, so that the commands it prints can be pasted."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Final

PROGRAM: Final = "wrapit"
"""What the program is called where nothing else is known, as when another one imports it."""


def pasted(*arguments: str | os.PathLike[str]) -> str:
    """A command of this program that a shell takes as it stands: `.venv/bin/wrapit build 'my bee.yaml'`."""
    words = [*called_as(sys.argv, sys.orig_argv), *(os.fspath(each) for each in arguments)]
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)


def called_as(argv: list[str], orig_argv: list[str]) -> list[str]:
    """The words in front of a command: the program's path, its name where a shell finds it, or `python -m`.

    >>> called_as(["/opt/bee/wrapit/__main__.py", "init"], ["python3", "-m", "wrapit", "init"])
    ['python3', '-m', 'wrapit']
    >>> called_as(["/nowhere/.venv/bin/wrapit", "init"], ["/nowhere/.venv/bin/python3", "…"])
    ['/nowhere/.venv/bin/wrapit']
    >>> called_as(["my-script.py"], ["python3", "my-script.py"])
    ['wrapit']
    """
    path = Path(argv[0]) if argv else Path()
    if path.name == "__main__.py" and path.parent.name == PROGRAM:
        return [orig_argv[0], "-m", PROGRAM]
    if path.stem.lower() != PROGRAM or path.suffix.lower() not in ("", ".exe"):
        return [PROGRAM]
    found = shutil.which(PROGRAM)
    known = found is not None and Path(found).with_suffix("") == path.with_suffix("")
    return [PROGRAM] if known else [argv[0]]


def argument(path: str | os.PathLike[str]) -> str:
    """A path as an argument that no option is taken for.

    >>> argument("-bee.yaml")
    './-bee.yaml'
    """
    text = os.fspath(path)
    return f"./{text}" if text.startswith("-") else text
