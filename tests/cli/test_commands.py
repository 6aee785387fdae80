"""What the commands share: help everywhere, several configs, commands that can be pasted."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from tests.conftest import CONFIGS
from wrapit.calling import called_as
from wrapit.cli.app import app

ROOT = CONFIGS.parent
WRAPIT = [sys.executable, "-m", "wrapit"]
COMMANDS = sorted(
    str(each.name or each.callback.__name__) for each in app.registered_commands if each.callback
)


def run(command: list[str], cwd: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        command, capture_output=True, text=True, timeout=300, check=False, cwd=cwd, env=environment
    )


def wrapit(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return run([*WRAPIT, *arguments], cwd)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a space in its name that holds a leaf and its config."""
    folder = tmp_path / "my pieces"
    folder.mkdir()
    shutil.copy(CONFIGS / "leaf.svg", folder)
    (folder / "my leaf.yaml").write_text("drawing: leaf.svg\nsize: 50 mm\nwire: {gauge: 20ga}\n")
    return folder


def test_help_of_each_command(tmp_path: Path) -> None:
    assert {"build", "check", "coupon", "doctor", "init", "materials", "schema"} <= set(COMMANDS)
    for command in COMMANDS:
        short, long = wrapit(command, "-h", cwd=tmp_path), wrapit(command, "--help", cwd=tmp_path)
        assert short.returncode == long.returncode == 0, command
        assert f"wrapit {command}" in short.stdout
        assert short.stdout == long.stdout
        assert not re.search(r"\.\.\.[\]}]+\.\.\.", short.stdout), "said twice that there may be several"


def test_the_effective_config_of_several(folder: Path) -> None:
    for command in ("build", "check"):
        arguments = (command, ":charm", "my leaf.yaml", "--dump-config", "--set", "wire.metal=Brass")
        dumped = wrapit(*arguments, cwd=folder)
        assert dumped.returncode == 0, dumped.stderr
        (folder / "again.yaml").write_text(dumped.stdout)
        data = YAML(typ="safe").load(dumped.stdout)
        assert (data["size"], data["wire"]["metal"], data["bail"]["diameter"]) == ("50 mm", "brass", "3 mm")
        assert wrapit(command, "again.yaml", "--dump-config", cwd=folder).stdout == dumped.stdout
        assert json.loads(wrapit(*arguments, "--json", cwd=folder).stdout) == data
    assert not (folder / "build").exists()


def test_the_command_that_takes_an_alternative_can_be_pasted(folder: Path) -> None:
    first = wrapit(
        "build", ":charm", "my leaf.yaml", "-o", "out put", "--set", "size=40 mm", "--alternatives", "4",
        "--until", "decomposition", cwd=folder,
    )  # fmt: skip
    assert first.returncode == 0, first.stderr
    line = next(line for line in first.stdout.splitlines() if line.startswith("alternatives: "))
    picture, _, command = line.removeprefix("alternatives: ").partition("; take one with: ")
    assert (folder / picture).is_file()
    words = shlex.split(command)
    assert words[: len(WRAPIT)] == WRAPIT
    again = run([*words, "--until", "decomposition", "--json"], folder)
    assert again.returncode == 0, again.stderr
    lock = YAML(typ="safe").load((folder / "out put" / "config.lock.yaml").read_text())
    assert (lock["decomposition"]["choice"], lock["size"]) == (2, "40 mm")
    assert "alternatives:" not in wrapit("build", "my leaf.yaml", "--until", "drawing", cwd=folder).stdout
    early = wrapit("build", "my leaf.yaml", "--until", "drawing", "--alternatives", "2", cwd=folder)
    assert (early.returncode, "fewer wires" in early.stdout) == (0, False), early.stderr
    line = next(line for line in first.stdout.splitlines() if line.startswith("fewer wires: "))
    picture, _, command = line.removeprefix("fewer wires: ").partition("; take the fewest with: ")
    assert (folder / picture).name == "fewer-wires.svg"
    fewest = run([*shlex.split(command), "--until", "decomposition", "--json"], folder)
    assert fewest.returncode == 0, fewest.stderr
    assert json.loads(fewest.stdout)["decomposition"]["energy"]["complexity"] == 1


def test_a_choice_that_there_is_not(folder: Path) -> None:
    refused = wrapit("build", "my leaf.yaml", "--choose", "500", "--until", "decomposition", cwd=folder)
    assert refused.returncode == 2
    assert "choose between 1 and " in refused.stderr
    for never in ("0", "-1", "1001"):
        refused = wrapit("build", "my leaf.yaml", "--choose", never, cwd=folder)
        assert refused.returncode == 2
        assert "--choose" in refused.stderr
        assert "--set" not in refused.stderr


def test_the_program_is_named_as_it_was_called(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / ".venv" / "bin" / "wrapit"
    program.parent.mkdir(parents=True)
    program.touch()
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert called_as([str(program), "build"], []) == [str(program)]
    monkeypatch.setenv("PATH", str(program.parent))
    assert called_as([str(program), "build"], []) == ["wrapit"]
    assert called_as([".venv/bin/wrapit"], []) == [".venv/bin/wrapit"]
    assert called_as([r"C:\x\Scripts\other.exe"], []) == ["wrapit"]
