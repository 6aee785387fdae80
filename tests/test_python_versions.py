"""Each Python that is promised can install what the lock names, on each system that is promised."""

from __future__ import annotations

import importlib.metadata
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name, parse_wheel_filename
from packaging.version import Version

ROOT = Path(__file__).parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
LOCK = [Requirement(line) for line in (ROOT / "requirements.lock").read_text().splitlines()]
PROMISED = re.findall(r"^PYTHONS := (.*)$", (ROOT / "Makefile").read_text(), flags=re.MULTILINE)[0].split()

# Linux with glibc 2.31 or newer (Debian 11, Ubuntu 20.04) on x86-64, macOS 14 or newer on Apple's chips. On
# others it may work, but nobody looks; Windows has no make.
LINUX = (*(f"manylinux_2_{minor}_x86_64" for minor in range(31, 4, -1)), "manylinux2014_x86_64")
SYSTEMS: dict[str, tuple[tuple[str, ...], dict[str, str]]] = {
    "linux": (LINUX, {"sys_platform": "linux", "platform_system": "Linux", "platform_machine": "x86_64"}),
    "macos": (
        ("macosx_14_0_arm64",),
        {"sys_platform": "darwin", "platform_system": "Darwin", "platform_machine": "arm64"},
    ),
}
# Published as source only; a test builds them.
SOURCE_ONLY = {"rectpack": "plain Python, last published before wheels were usual"}


@dataclass(frozen=True)
class Target:
    """One Python on one system."""

    python: str
    system: str

    @property
    def environment(self) -> dict[str, str]:
        """What markers see there."""
        seen = {
            **{key: str(value) for key, value in default_environment().items()},
            **SYSTEMS[self.system][1],
            "os_name": "posix",
            "python_version": self.python,
            "python_full_version": f"{self.python}.0",
            "implementation_version": f"{self.python}.0",
            "implementation_name": "cpython",
            "platform_python_implementation": "CPython",
        }
        return {**seen, "platform_release": "", "platform_version": ""}

    def holds(self, requirement: Requirement, extra: str = "") -> bool:
        """Whether the requirement's marker is true there."""
        return requirement.marker is None or requirement.marker.evaluate({**self.environment, "extra": extra})

    def locked(self) -> dict[str, Version]:
        """The lock's entries that count there."""
        return {canonicalize_name(entry.name): pinned(entry) for entry in LOCK if self.holds(entry)}


TARGETS = [Target(python, system) for system in SYSTEMS for python in PROMISED]


def pinned(entry: Requirement) -> Version:
    (only,) = entry.specifier
    assert only.operator == "==", entry
    return Version(only.version)


def pip(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Asks pip, without waiting long for a registry that isn't there."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--retries=2", "--timeout=20"]
    return subprocess.run([*command, *arguments], capture_output=True, text=True, timeout=300, check=False)


@dataclass(frozen=True)
class Wheel:
    """A wheel that pip has chosen, and what it says of itself."""

    url: str
    requires_python: str
    requires: tuple[str, ...]


def plan(folder: Path, entries: list[Requirement], *options: str) -> dict[str, Wheel]:
    """What pip would install for exactly these entries, from wheels only; fetches no more than metadata."""
    folder.mkdir()
    wanted, report = folder / "wanted.txt", folder / "report.json"
    wanted.write_text("".join(f"{entry.name}{entry.specifier}\n" for entry in entries))
    asked = pip(
        *("install", "--quiet", "--dry-run", "--ignore-installed", "--no-deps", "--only-binary=:all:"),
        *(*options, "--target", str(folder / "nothing"), "--report", str(report), "-r", str(wanted)),
    )
    assert asked.returncode == 0, [line for line in asked.stderr.splitlines() if line.startswith("ERROR: ")]
    return {
        canonicalize_name(found["metadata"]["name"]): Wheel(
            found["download_info"]["url"],
            found["metadata"].get("requires_python", ""),
            tuple(found["metadata"].get("requires_dist", ())),
        )
        for found in json.loads(report.read_text())["install"]
    }


@pytest.fixture(scope="module")
def registry(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Skips where the registry can't be asked (fails where the tests' programs are required)."""
    version = importlib.metadata.version("pip")
    if Version(version) < Version("23.3"):
        reason = f"pip {version} fetches whole wheels to answer; `make setup` brings a newer one"
    else:
        # Not one of the common ones, which partial mirrors hold too.
        probe = next(entry for entry in LOCK if entry.name == "Hershey-Fonts")
        try:
            plan(tmp_path_factory.mktemp("pip") / "probe", [probe])
        except AssertionError:
            reason = "pip reaches no package registry"
        else:
            return
    if os.environ.get("WRAPIT_REQUIRE_CLIENTS"):
        pytest.fail(reason)
    pytest.skip(reason)


def test_one_list_of_pythons() -> None:
    project = PYPROJECT["project"]
    allowed = SpecifierSet(project["requires-python"])
    every = [f"{major}.{minor}" for major in (2, 3, 4) for minor in range(40)]
    assert [python for python in every if f"{python}.99" in allowed] == sorted(PROMISED)
    assert [python for python in every if f"{python}.0" in allowed] == sorted(PROMISED)
    prefix = "Programming Language :: Python :: "
    named = [name.removeprefix(prefix) for name in project["classifiers"] if name.startswith(prefix)]
    assert named == sorted(PROMISED)
    *others, newest = sorted(PROMISED)
    assert f"with Python {', '.join(others)} or {newest}, " in (ROOT / "README.md").read_text()


def test_tools_check_for_the_oldest_python() -> None:
    oldest = min(PROMISED)
    assert PYPROJECT["tool"]["mypy"]["python_version"] == oldest
    assert PYPROJECT["tool"]["ruff"]["target-version"] == f"py{oldest.replace('.', '')}"


def test_an_activated_environment_can_be_made_anew(tmp_path: Path) -> None:
    """Its own Python, the only one on the path, vanishes with it: the one behind it serves."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    (tmp_path / "tools").mkdir()
    for tool in ("sh", "sed", "rm", "touch", "tail"):
        (tmp_path / "tools" / tool).symlink_to(shutil.which(tool) or tool)
    made = subprocess.run(
        [ROOT / ".ci/make-venv", "venv", version],
        cwd=tmp_path,
        env={**os.environ, "PATH": f"{tmp_path}/venv/bin:{tmp_path}/tools"},
        text=True,
        capture_output=True,
        check=False,
    )
    assert made.returncode == 0, made.stderr
    assert made.stderr == f"venv is incomplete; making it anew with python{version} (Python {version})\n"
    subprocess.run([tmp_path / "venv/bin/python", "-m", "pip", "--version"], check=True, capture_output=True)


@pytest.mark.usefixtures("registry")
def test_every_promised_python_installs_what_the_lock_says(tmp_path: Path) -> None:
    first, *others = TARGETS
    wheels = wheels_for(first, {}, tmp_path / "first")
    # Wheels of plain Python are the same everywhere: they need asking for once only.
    plain = {name: wheel for name, wheel in wheels.items() if wheel.url.endswith("-none-any.whl")}
    with ThreadPoolExecutor(3) as pool:  # most of the time goes into waiting for answers
        folders = [tmp_path / str(number) for number in range(len(others))]
        answers = [wheels, *pool.map(wheels_for, others, [plain] * len(others), folders)]
    problems = []
    for target, there in zip(TARGETS, answers, strict=True):
        assert target.locked().keys() - SOURCE_ONLY <= there.keys()
        problems += [f"{target}: {problem}" for problem in [*too_new(target, there), *unmet(target, there)]]
    assert problems == []


def wheels_for(target: Target, known: dict[str, Wheel], folder: Path) -> dict[str, Wheel]:
    """The target's wheels of all of the lock's entries; those that are known already are not asked for."""
    names = target.locked().keys() - SOURCE_ONLY - known.keys()
    entries = [entry for entry in LOCK if canonicalize_name(entry.name) in names and target.holds(entry)]
    platforms = [f"--platform={tag}" for tag in SYSTEMS[target.system][0]]
    return known | plan(folder, entries, f"--python-version={target.python}", *platforms)


def too_new(target: Target, wheels: dict[str, Wheel]) -> Iterator[str]:
    """The lock's entries that refuse the target's Python."""
    for name in sorted(target.locked().keys() - SOURCE_ONLY):
        if f"{target.python}.0" not in SpecifierSet(wheels[name].requires_python):
            yield f"{name} needs Python {wheels[name].requires_python}"


def unmet(target: Target, wheels: dict[str, Wheel]) -> Iterator[str]:
    """What wrapit, its tools and all that they need ask for there, and the lock lacks or has otherwise."""
    project, locked = PYPROJECT["project"], target.locked()
    todo = [("wrapit", Requirement(line)) for line in project["dependencies"]]
    extras = itertools.chain(*project["optional-dependencies"].values())
    todo += [("wrapit", need) for need in map(Requirement, extras) if need.name != "wrapit"]
    seen = set()
    while todo:
        asker, wanted = todo.pop()
        name = canonicalize_name(wanted.name)
        if name not in locked or locked[name] not in wanted.specifier:
            yield f"{asker} needs {wanted}, the lock has {locked.get(name, 'none')}"
            continue
        if (name, *sorted(wanted.extras)) in seen or name in SOURCE_ONLY:
            continue
        seen.add((name, *sorted(wanted.extras)))
        needs = [Requirement(line) for line in wheels[name].requires]
        todo += [(name, need) for need in needs if any(target.holds(need, e) for e in ("", *wanted.extras))]


@pytest.mark.usefixtures("registry")
@pytest.mark.parametrize("name", SOURCE_ONLY)
def test_sources_build_into_plain_python_that_needs_nothing(name: str, tmp_path: Path) -> None:
    entry = next(entry for entry in LOCK if canonicalize_name(entry.name) == name)
    wish = f"{entry.name}{entry.specifier}"
    built = pip("wheel", "--quiet", "--no-deps", f"--no-binary={name}", "--wheel-dir", str(tmp_path), wish)
    assert built.returncode == 0, built.stderr
    (wheel,) = tmp_path.iterdir()
    _, version, _, tags = parse_wheel_filename(wheel.name)
    assert version == pinned(entry)
    assert ("py3", "none", "any") in {(tag.interpreter, tag.abi, tag.platform) for tag in tags}
    with zipfile.ZipFile(wheel) as contents:
        (metadata,) = (name for name in contents.namelist() if name.endswith(".dist-info/METADATA"))
        assert b"\nRequires-Dist: " not in contents.read(metadata)
