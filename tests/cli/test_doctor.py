"""The doctor says what there is, and how to get what isn't."""

from __future__ import annotations

import importlib.metadata
import json
import subprocess
import sys
from pathlib import Path

import pytest

from wrapit import __version__
from wrapit.cli import health
from wrapit.cli.health import Checked, as_document, as_lines, examined, works

ROOT = Path(__file__).parent.parent.parent


def doctor(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "wrapit", "doctor", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False, cwd=ROOT)


def test_a_sound_machine() -> None:
    run = doctor("--json")
    assert run.returncode == 0, run.stderr
    document = json.loads(run.stdout)
    assert document["works"]
    told = {each["name"]: each for each in document["checks"]}
    assert told["wrapit"]["told"] == __version__
    assert told["solid modeller"]["state"] == "ok"
    assert "loads in" in told["solid modeller"]["told"]
    for package in ("build123d", "numpy", "scipy", "shapely", "cadquery"):
        assert told[package]["told"] == importlib.metadata.version(package)
    assert {"FreeCAD", "slicer", "browser", "LibreCAD"} <= told.keys()
    assert {name for name, extra in health.required().items() if extra != "dev"} <= told.keys()
    for each in document["checks"]:
        assert (each["state"] == "ok") != bool(each["remedy"]), each


def test_a_missing_package_and_a_broken_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        health, "required", lambda: {"numpy": "", "no-such-package": "", "no-cluster": "cluster"}
    )
    monkeypatch.setattr(
        health, "_LOAD_KERNEL", "raise ImportError('libGL.so.1: cannot open shared object file')"
    )
    monkeypatch.setattr(health.shutil, "which", lambda command: None)
    found = list(examined())
    state = {each.name: each for each in found}
    assert not works(found)
    assert not as_document(found)["works"]
    assert state["no-such-package"].state == "missing"
    assert "pip install" in state["no-such-package"].remedy
    assert "wrapit[cluster]" in state["no-cluster"].remedy
    assert not state["no-cluster"].needed
    assert "libGL.so.1" in state["solid modeller"].told
    assert all(each.state == "missing" and each.remedy for each in found if each.group == "program")
    assert next(reversed(list(as_lines(found)))).startswith("wrapit doesn't work")


def test_the_kernel_is_loaded_as_a_build_loads_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("random", "importlib", "wrapit"):  # whatever lies where somebody works
        (tmp_path / f"{name}.py").write_text("raise SystemExit('not the real one')")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(health, "_LOAD_KERNEL", "import importlib, random, wrapit.pipeline.solids")
    assert health._kernel().state == "ok"


def test_what_is_only_an_extra_keeps_nobody_from_working() -> None:
    found = [
        Checked("version", "a", "ok", "1", needed=True),
        Checked("program", "b", "missing", "", remedy="get it"),
    ]
    assert works(found)
    assert not works([*found, Checked("kernel", "c", "broken", "", needed=True)])
