"""What there is on this machine: versions, the kernel, other programs; and how to get what is missing."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal

from wrapit import __version__

State = Literal["ok", "missing", "broken"]

KERNEL_LIMIT_S: Final = 300
"""Loading takes 3 to 10 s; on a machine whose disk is cold and busy, minutes have been seen."""
# What a build's own process of the kernel loads.
_LOAD_KERNEL: Final = """
import importlib
from wrapit.pipeline.solids import PRELOAD
for name in PRELOAD: importlib.import_module(name)
"""
_CLIENTS: Final[tuple[tuple[str, tuple[str, ...], str, str], ...]] = (
    (
        "FreeCAD",
        ("freecadcmd", "FreeCADCmd", "freecad", "FreeCAD"),
        "opens jig.step and wires.step",
        "freecad.org",
    ),
    (
        "slicer",
        ("prusa-slicer", "PrusaSlicer", "prusa-slicer-console", "orca-slicer", "cura", "bambu-studio"),
        "prints jig.3mf and jig.stl",
        "prusa3d.com/prusaslicer",
    ),
    (
        "browser",
        ("firefox", "chromium", "chromium-browser", "google-chrome", "msedge", "safari", "brave-browser"),
        "shows guide.html and the studio",
        "mozilla.org/firefox",
    ),
    ("LibreCAD", ("librecad", "LibreCAD"), "opens the laser-cut jig's .dxf", "librecad.org"),
)
"""Programs that take what wrapit makes: their commands, what for, and where they are from."""


@dataclass(frozen=True)
class Checked:
    """One thing that was looked for. `needed` says that wrapit doesn't work without it."""

    group: Literal["version", "kernel", "program", "extra"]
    name: str
    state: State
    told: str
    needed: bool = False
    remedy: str = ""


def examined() -> Iterator[Checked]:
    """All that is looked for, the slow kernel last."""
    yield Checked("version", "wrapit", "ok", __version__)
    yield Checked("version", "Python", "ok", f"{platform.python_version()} ({platform.platform(terse=True)})")
    yield from _packages()
    yield from _programs()
    yield _kernel()


def works(found: list[Checked]) -> bool:
    """Whether wrapit itself works."""
    return all(each.state == "ok" for each in found if each.needed)


def as_document(found: list[Checked]) -> dict[str, Any]:
    """What was found, as JSON says it."""
    return {"works": works(found), "checks": [asdict(each) for each in found]}


def as_lines(found: list[Checked]) -> Iterator[str]:
    """What was found, a line each."""
    for each in found:
        remedy = f"; {each.remedy}" if each.remedy else ""
        yield f"{each.state:<8}{each.name:<18}{each.told}{remedy}"
    yield "wrapit works" if works(found) else "wrapit doesn't work: see what is missing or broken above"


def required(name: str = "wrapit") -> dict[str, str]:
    """The packages that the program needs, each with the extra that it belongs to, empty for none.

    Raises importlib.metadata.PackageNotFoundError where the program isn't installed.
    """
    packages: dict[str, str] = {}
    for text in importlib.metadata.requires(name) or ():
        requirement, _, marker = text.partition(";")
        extra = re.search(r"extra\s*==\s*['\"]([\w-]+)['\"]", marker)
        found = re.match(r"[\w.-]+", requirement)
        if found:
            packages.setdefault(found[0], extra[1] if extra else "")
    return packages


def _packages() -> Iterator[Checked]:
    try:
        packages = required()
    except importlib.metadata.PackageNotFoundError:
        remedy = "install it with: pip install ."
        yield Checked(
            "version", "installation", "broken", "wrapit isn't installed", needed=True, remedy=remedy
        )
        return
    for name, extra in sorted(packages.items(), key=lambda each: (each[1], each[0])):
        if extra == "dev":
            continue  # for those who work on the program
        purpose = f"for wrapit[{extra}]" if extra else ""
        wanted = f"wrapit[{extra}]" if extra else name
        try:
            version = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            told = f"not installed {purpose}".rstrip()
            remedy = f"get it with: {sys.executable} -m pip install '{wanted}'"
            yield Checked("extra" if extra else "version", name, "missing", told, not extra, remedy)
        else:
            told = f"{version} {purpose}".rstrip()
            yield Checked("extra" if extra else "version", name, "ok", told, not extra)


def _programs() -> Iterator[Checked]:
    for name, commands, purpose, source in _CLIENTS:
        path = next((found for command in commands if (found := shutil.which(command))), None)
        if path is None:
            yield Checked(
                "program", name, "missing", f"not on the path; it {purpose}", remedy=f"get it from {source}"
            )
        else:
            yield Checked("program", name, "ok", f"{path}: {purpose}")


def _kernel() -> Checked:
    """Loads the kernel in a process of its own, for a broken one may end its process."""
    started = time.monotonic()
    remedy = f"install it anew: {sys.executable} -m pip install --force-reinstall cadquery-ocp build123d"
    try:
        run = subprocess.run(
            # Modules are found where this process finds them, as in a build, not in the folder that somebody
            # is in.
            [sys.executable, "-P", "-c", _LOAD_KERNEL],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            capture_output=True,
            text=True,
            errors="replace",
            timeout=KERNEL_LIMIT_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        told = f"doesn't load within {KERNEL_LIMIT_S} s"
        return Checked("kernel", "solid modeller", "broken", told, needed=True, remedy=remedy)
    if run.returncode:
        said = (run.stderr.strip().splitlines() or [f"it ended with {run.returncode}"])[-1]
        return Checked(
            "kernel", "solid modeller", "broken", f"doesn't load ({said})", needed=True, remedy=remedy
        )
    return Checked(
        "kernel", "solid modeller", "ok", f"loads in {time.monotonic() - started:.1f} s", needed=True
    )
