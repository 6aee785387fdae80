"""`make` finds a Python that serves, or says in one line which to install. Stand-ins play the Pythons."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path
from subprocess import PIPE
from typing import Any, Literal

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

ROOT = Path(__file__).parent.parent
PROMISED = ("3.13", "3.12", "3.11")
NAMES = (*(f"python{version}" for version in PROMISED), "python3")
TOOLS = ("sh", "bash", "make", "awk", "cat", "cp", "find", "mkdir", "rm", "sed", "sleep", "tail", "touch")
Fault = Literal["none", "doesn't run", "no venv", "venv fails", "venv hangs", "pip fails"]

STAND_IN = """#!/bin/sh
echo "$*" >> "{log}"
[ "{fault}" != "doesn't run" ] || {{ echo "pyenv: command not found" >&2; exit 127; }}
case "$*" in
  *version_info*) echo {version} ;;
  *ensurepip*) [ "{fault}" != "no venv" ] ;;
  *base_prefix*) echo ;;
  "-m venv "*)
    mkdir -p "$3/bin"
    [ "{fault}" != "venv hangs" ] || sleep 60
    [ "{fault}" != "venv fails" ] || {{ echo "Error: no space left"; exit 1; }}
    cp "$0" "$3/bin/python" ;;
  "-m pip "*) [ "{fault}" != "pip fails" ] ;;
  *) echo "unexpected: $*" >&2; exit 3 ;;
esac
"""


class Project:
    """A folder with our Makefile, on a machine that has only the Pythons that a test puts there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.log = folder / "calls.log"
        self.venv = folder / ".venv"
        self.path = folder / "bin"
        self.path.mkdir(parents=True)
        for tool in TOOLS:
            found = shutil.which(tool)
            assert found is not None, tool
            (self.path / tool).symlink_to(found)
        (folder / ".ci").mkdir()
        for name in ("Makefile", "pyproject.toml", "requirements.lock", ".ci/make-venv"):
            shutil.copy(ROOT / name, folder / name)
        (folder / "wrapit").mkdir()

    def add(self, name: str, version: str, fault: Fault = "none") -> Path:
        """Puts a stand-in for a Python of that version on the path."""
        return self.write(self.path / name, version, fault)

    def write(self, path: Path, version: str, fault: Fault = "none") -> Path:
        path.unlink(missing_ok=True)
        path.write_text(STAND_IN.format(log=self.log, version=version, fault=fault))
        path.chmod(0o755)
        return path

    def start(self, *arguments: str) -> subprocess.Popen[str]:
        options: Any = {"cwd": self.folder, "env": {"PATH": str(self.path), "LC_ALL": "C"}, "text": True}
        return subprocess.Popen(arguments, stdout=PIPE, stderr=PIPE, start_new_session=True, **options)

    def run(self, *arguments: str) -> tuple[int, list[str]]:
        """Exit code, and the lines on standard error without make's own."""
        process = self.start(*arguments)
        _, errors = process.communicate(timeout=60)
        return process.returncode, [line for line in errors.splitlines() if not line.startswith("make: ")]

    def make(self, *arguments: str) -> tuple[int, list[str]]:
        return self.run("make", *arguments)

    def calls(self, prefix: str = "") -> list[str]:
        """What the Pythons were asked since the last look."""
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        self.log.unlink(missing_ok=True)
        return [line for line in lines if line.startswith(prefix)]

    def version(self) -> str:
        """The version of the environment's Python."""
        asked = [str(self.venv / "bin/python"), "version_info"]
        return subprocess.check_output(asked, text=True, cwd=self.folder).strip()


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path / "project")


def says_what_to_install(errors: Sequence[str]) -> bool:
    """Whether the errors are one line that names the promised versions and a remedy for each system."""
    remedies = ("uv python install 3.13", "PYTHON=$(uv python find 3.13) ", "brew install ", "apt install ")
    return (
        len(errors) == 1
        and errors[0].startswith("error: wrapit needs Python 3.13, 3.12 or 3.11")
        and all(remedy in errors[0] for remedy in remedies)
    )


def test_an_unsupported_python_alone_is_refused_in_one_line(project: Project) -> None:
    project.add("python3", "3.14")
    code, errors = project.make("demo")
    assert code != 0
    assert says_what_to_install(errors), errors
    assert "found: python3 is Python 3.14." in errors[0]
    assert "$(uv python find 3.13) demo'" in errors[0]
    assert not project.venv.exists()


def test_without_any_python_the_line_says_so(project: Project) -> None:
    code, errors = project.make("setup")
    assert code != 0
    assert says_what_to_install(errors), errors
    assert "found: none." in errors[0]


def test_a_python_without_venv_is_named_with_its_package(project: Project) -> None:
    project.add("python3", "3.12", "no venv")
    code, errors = project.make("setup")
    assert code != 0
    assert says_what_to_install(errors), errors
    assert "apt install python3.12-venv" in errors[0]
    assert not project.venv.exists()


def test_a_shim_that_fails_is_passed_over(project: Project) -> None:
    project.add("python3.13", "3.13", "doesn't run")
    project.add("python3.12", "3.12")
    assert project.make("setup") == (0, [])
    assert project.version() == "3.12"
    assert len(project.calls("-m pip install")) == 1


candidates = st.fixed_dictionaries(
    {},
    optional={
        name: st.tuples(
            st.sampled_from(["3.9", "3.10", "3.11", "3.12", "3.13", "3.14", "3.15", "3.1", "2.7"]),
            st.sampled_from(["none", "none", "doesn't run", "no venv"]),
        )
        for name in NAMES
    },
)


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(pythons=candidates)
def test_the_first_python_that_works_is_taken(
    pythons: dict[str, tuple[str, Fault]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    project = Project(tmp_path_factory.mktemp("machine") / "project")
    for name, (version, fault) in pythons.items():
        project.add(name, version, fault)
    code, errors = project.run(".ci/make-venv", ".venv", " ".join(PROMISED))
    good = [
        pythons[name][0]
        for name in NAMES
        if name in pythons and pythons[name][0] in PROMISED and pythons[name][1] == "none"
    ]
    if good:
        assert (code, errors, project.version()) == (0, [], good[0])
    else:
        assert code == 1
        assert says_what_to_install(errors), errors
        found = errors[0].partition("found: ")[2].partition(". Install")[0]
        named = [re.split(r" (?:is|doesn't|can't) ", entry)[0] for entry in found.split(", ")]
        assert named == ([name for name in NAMES if name in pythons] or ["none"])
        assert not project.venv.exists()


def test_the_users_python_wins(project: Project) -> None:
    project.add("python3.13", "3.13")
    mine = project.write(project.folder / "my python", "3.11")
    assert project.make("setup", f"PYTHON={mine}") == (0, [])
    assert project.version() == "3.11"


@pytest.mark.parametrize(("version", "fault"), [("3.14", "none"), ("3.10", "none"), ("3.12", "doesn't run")])
def test_the_users_python_is_refused_where_it_cannot_serve(
    project: Project, version: str, fault: Fault
) -> None:
    project.add("python3.13", "3.13")
    assert project.make("setup")[0] == 0
    mine = project.write(project.folder / "mine", version, fault)
    code, errors = project.make("setup", f"PYTHON={mine}")
    assert code != 0
    assert says_what_to_install(errors), errors
    assert str(mine) in errors[0]
    assert project.version() == "3.13"


def test_another_python_of_the_users_choice_makes_the_environment_anew(project: Project) -> None:
    project.add("python3.13", "3.13")
    project.add("python3.12", "3.12")
    assert project.make("setup") == (0, [])
    code, errors = project.make("setup", "PYTHON=python3.12")
    assert (code, len(errors), project.version()) == (0, 1, "3.12")
    assert project.make("setup", "PYTHON=python3.12") == (0, [])


@pytest.mark.parametrize("spoilt", ["gone", "dangling", "fails", "3.14", "3.10", "interrupted"])
def test_a_stale_environment_is_made_anew(project: Project, spoilt: str) -> None:
    project.add("python3.12", "3.12")
    assert project.make("setup") == (0, [])
    (project.venv / "left-over").touch()
    project.calls()
    python = project.venv / "bin/python"
    match spoilt:
        case "gone" | "dangling":
            python.unlink()
            if spoilt == "dangling":
                python.symlink_to(project.folder / "an-old-python")
        case "fails":
            project.write(python, "3.12", "doesn't run")
        case "interrupted":
            (project.venv / ".python").unlink()
            (project.venv / ".ready").unlink()
        case _:
            project.write(python, spoilt)
    code, errors = project.make("setup")
    assert code == 0
    assert len(errors) == 1
    assert errors[0].startswith(".venv ")
    assert "making it anew with python3.12 (Python 3.12)" in errors[0]
    assert project.version() == "3.12"
    assert not (project.venv / "left-over").exists()
    assert len(project.calls("-m pip install")) == 1


def test_a_good_environment_is_left_as_it_is(project: Project) -> None:
    project.add("python3.12", "3.12")
    assert project.make("setup") == (0, [])
    project.calls()
    assert project.make("setup") == (0, [])
    assert project.calls("-m ") == []


def test_an_environment_older_than_this_rule_is_kept(project: Project) -> None:
    project.add("python3.12", "3.12")
    assert project.make("setup") == (0, [])
    (project.venv / ".python").unlink()
    project.calls()
    assert project.make("setup") == (0, [])
    assert project.calls("-m ") == []


def test_a_failure_to_make_the_environment_leaves_none(project: Project) -> None:
    project.add("python3.12", "3.12", "venv fails")
    code, errors = project.make("setup")
    assert code != 0
    assert len(errors) == 1
    assert "Error: no space left" in errors[0]
    assert not project.venv.exists()


def test_an_interruption_leaves_no_environment(project: Project) -> None:
    project.add("python3.12", "3.12", "venv hangs")
    process = project.start("make", "setup")
    deadline = time.monotonic() + 20
    while not project.venv.exists():
        assert time.monotonic() < deadline
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGTERM)
    process.communicate(timeout=20)
    assert process.returncode != 0
    deadline = time.monotonic() + 20
    while project.venv.exists():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_failed_installation_is_done_again(project: Project) -> None:
    project.add("python3.12", "3.12", "pip fails")
    assert project.make("setup")[0] != 0
    assert not (project.venv / ".ready").exists()
    project.write(project.venv / "bin/python", "3.12")
    project.calls()
    assert project.make("setup") == (0, [])
    assert len(project.calls("-m pip install")) == 1


@pytest.mark.parametrize("target", ["help", "clean"])
def test_targets_that_need_no_python_look_for_none(project: Project, target: str) -> None:
    project.add("python3", "3.14")
    assert project.make(target) == (0, [])
    assert project.calls() == []
