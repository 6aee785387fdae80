"""What makes results of one program unlike those of another: its files, its libraries, its machine."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import json
import os
import platform
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import wrapit


def key_of(*parts: Any) -> str:
    """The name of what this program makes of `parts`, which are JSON."""
    text = json.dumps([fingerprint(), *parts], sort_keys=True)
    return hashlib.sha256(text.encode(errors="surrogatepass")).hexdigest()


@functools.cache
def fingerprint() -> str:
    """Of the program as this process has it; each file that a developer touches changes it."""
    package = Path(wrapit.__file__).parent
    said = [wrapit.__version__, sys.version, sys.platform, platform.machine()]
    return hashlib.sha256(json.dumps([*said, *_files(package), *_libraries()]).encode()).hexdigest()


def _files(package: Path) -> Iterator[str]:
    for folder, inner, names in os.walk(package):
        inner[:] = sorted(name for name in inner if name != "__pycache__")
        for name in sorted(names):
            try:
                about = (Path(folder) / name).lstat()  # editors mark open files with links to nowhere
            except FileNotFoundError:
                continue  # and keep files of their own for moments
            yield f"{Path(folder).relative_to(package)}/{name} {about.st_size} {about.st_mtime_ns}"


def _libraries() -> Iterator[str]:
    """Names and versions of what is installed beside numpy."""
    spec = importlib.util.find_spec("numpy")
    assert spec is not None, "numpy is required"
    assert spec.origin is not None, "numpy is a package with a file"
    yield from sorted(path.name for path in Path(spec.origin).parent.parent.glob("*.dist-info"))
