"""The wheel holds everything, and is all that a desk without the checkout needs."""

from __future__ import annotations

import importlib.metadata
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest
from packaging.version import Version

from wrapit import __version__

ROOT = Path(__file__).parents[2]
NAME = "Grüne Öse 1"
LINES = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30">'
    '<path d="M 28 15 A 13 13 0 0 1 2 15 A 13 13 0 0 1 28 15" fill="none" stroke="black"/></svg>'
)


def run(*command: object, cwd: Path, **environment: str) -> str:
    told = subprocess.run(
        [str(each) for each in command],
        cwd=cwd,
        env={**os.environ, **environment},
        capture_output=True,
        encoding="utf-8",
        timeout=300,
        check=False,
    )
    assert told.returncode == 0, told.stdout + told.stderr
    return told.stdout


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what is built from, for building leaves files there."""
    if Version(importlib.metadata.version("setuptools")) < Version("77"):
        reason = "setuptools 77 or newer isn't installed"
        if os.environ.get("WRAPIT_REQUIRE_CLIENTS"):
            pytest.fail(reason)
        pytest.skip(reason)
    folder = tmp_path_factory.mktemp("source") / "wrapit"
    folder.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy2(ROOT / name, folder / name)
    left_out = shutil.ignore_patterns("__pycache__")
    for name in ("wrapit", "tests/every_desk"):
        shutil.copytree(ROOT / name, folder / name, ignore=left_out)
    return folder


@pytest.fixture(scope="module")
def wheel(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built(source, tmp_path_factory.mktemp("wheel"))


def built(source: Path, folder: Path) -> Path:
    pip = [sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "--no-build-isolation"]
    run(*pip, source, "-w", folder, cwd=folder)
    (wheel,) = folder.glob("*.whl")
    return wheel


def contents(wheel: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_the_wheel_holds_the_package_and_nothing_else(wheel: Path) -> None:
    """The rooms' pages are for those who read the source; the rest is needed where the program runs."""
    package = [path for path in (ROOT / "wrapit").rglob("*") if path.is_file()]
    wanted = {
        path.relative_to(ROOT).as_posix(): path.read_bytes()
        for path in package
        if path.suffix != ".md" and "__pycache__" not in path.parts
    }
    assert {".py", ".typed", ".jinja", ".css", ".js", ".ftl"} <= {
        Path(name).suffix or name for name in wanted
    }
    held = contents(wheel)
    about = f"wrapit-{__version__}.dist-info/"
    found = {name: data for name, data in held.items() if not name.startswith(about)}
    assert sorted(found) == sorted(wanted)
    assert [name for name in wanted if found[name] != wanted[name]] == []
    assert f"{about}licenses/LICENSE" in held


def test_the_metadata_says_where_it_runs(wheel: Path) -> None:
    held = contents(wheel)[f"wrapit-{__version__}.dist-info/METADATA"].decode()
    for system in ("MacOS", "Microsoft :: Windows", "POSIX :: Linux"):
        assert f"Classifier: Operating System :: {system}" in held.splitlines()


def test_the_source_archive_makes_the_same_wheel(source: Path, wheel: Path, tmp_path: Path) -> None:
    build = f"from setuptools.build_meta import build_sdist; build_sdist({str(tmp_path)!r})"
    run(sys.executable, "-c", build, cwd=source)
    (archive,) = tmp_path.glob("*.tar.gz")
    shutil.unpack_archive(archive, tmp_path / "unpacked", filter="data")
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    (tmp_path / "again").mkdir()
    again, first = contents(built(unpacked, tmp_path / "again")), contents(wheel)
    assert {name: data for name, data in again.items() if ".dist-info/" not in name} == {
        name: data for name, data in first.items() if ".dist-info/" not in name
    }


@pytest.fixture(scope="module")
def program(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The command in an environment with the wheel, and with this one's libraries but not its wrapit."""
    base = tmp_path_factory.mktemp("clean") / "environment"
    run(sys.executable, "-m", "venv", "--without-pip", base, cwd=base.parent)
    paths = {
        name: Path(sysconfig.get_path(name, "venv", {"base": str(base), "platbase": str(base)}))
        for name in ("purelib", "scripts")
    }
    # Of a folder that a .pth names, Python reads no .pth files: the checkout isn't on the path.
    libraries = Path(sysconfig.get_path("purelib"))
    (paths["purelib"] / "libraries.pth").write_text(f"{libraries}\n", encoding="utf-8")
    python = paths["scripts"] / Path(sys.executable).name
    run(
        sys.executable,
        "-m",
        "pip",
        "--python",
        python,
        "install",
        "--no-index",
        "--no-deps",
        "--force-reinstall",
        wheel,
        cwd=base,
        PYTHONPATH="",
    )
    found = run(
        python,
        "-c",
        "import sys, wrapit; print(wrapit.__file__, *sys.path, sep='\\n')",
        cwd=base,
        PYTHONPATH="",
    )
    assert found.startswith(str(paths["purelib"]))
    assert str(ROOT) not in found.splitlines()
    return paths["scripts"] / "wrapit"


def test_the_command_alone_makes_a_piece(program: Path, tmp_path: Path) -> None:
    """From a folder elsewhere, of a drawing whose name has spaces and umlauts."""
    folder = tmp_path / "Mein Schmuck"
    folder.mkdir()
    (folder / f"{NAME}.svg").write_text(LINES, encoding="utf-8", newline="\n")
    assert run(program, "--version", cwd=folder, PYTHONPATH="") == f"wrapit {__version__}\n"
    assert '"$schema"' in run(program, "schema", cwd=folder, PYTHONPATH="")
    run(program, "init", f"{NAME}.svg", cwd=folder, PYTHONPATH="")
    run(program, "build", f"{NAME}.yaml", cwd=folder, PYTHONPATH="")
    made = {path.name for path in (folder / "build" / NAME).iterdir()}
    assert made >= {"report.json", "guide.html", "guide.pdf", "jig.3mf", "jig.step", "wires.step", "view.png"}
