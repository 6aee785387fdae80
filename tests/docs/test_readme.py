"""What README.md tells people to type works, and what it shows is so."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image, ImageDraw

from tests.make_project import Project
from wrapit.config import load_config

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SHELLS = ("sh", "bash", "powershell")
PROGRAM = re.compile(r"^(?:\S*[/\\])?wrapit(?= )")
TYPED = re.compile(r"(?<!`)`((?:make|wrapit|python|uvx|pipx|pip) [^`\n]+)`")
# What fetches from the network or makes an environment: that the wheel holds everything and runs by itself is
# tried in tests/every_desk/test_wheel.py, and that an environment is made in tests/test_make_venv.py.
INSTALLERS = {
    "pipx install .",
    "python3 -m venv .venv",
    ".venv/bin/pip install .",
    'pip install "wrapit[cluster]"',
    "py -m venv .venv",
    r".venv\Scripts\pip install .",
}
# Runs until it is stopped: that there is such a command with such options is all that is asked of it.
ENDLESS = {"studio"}


def typed(text: str) -> Iterator[str]:
    """Every command that a page tells people to type, without comments: in blocks, and within sentences."""
    for language, block in BLOCK.findall(text):
        if language in SHELLS:
            for line in block.splitlines():
                if command := line.partition(" #")[0].strip():
                    yield command
    yield from TYPED.findall(BLOCK.sub("", text))


def kind(command: str) -> str:
    """Who runs it: `wrapit`, `make`, `python` or an installer."""
    if command in INSTALLERS:
        return "installer"
    command = command.removeprefix("uvx --from . ")
    return "wrapit" if PROGRAM.match(command) else command.split()[0]


COMMANDS = list(dict.fromkeys(typed(README)))


def test_every_command_is_of_a_kind_that_is_tried() -> None:
    assert {kind(command) for command in COMMANDS} == {"installer", "wrapit", "make", "python"}
    assert set(COMMANDS) >= INSTALLERS


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a drawing, and a config as a catalogue has it."""
    folder = tmp_path_factory.mktemp("desk")
    page = Image.new("L", (500, 360), 255)
    pen = ImageDraw.Draw(page)
    pen.ellipse((50, 50, 450, 310), outline=0, width=8)
    pen.line((50, 180, 450, 180), fill=0, width=8)
    page.save(folder / "fern.png")
    (folder / "piece.yaml").write_text("drawing: fern.png\nsize: 40 mm\n", encoding="utf-8")
    return folder


def test_commands_of_wrapit_run_in_their_order(desk: Path) -> None:
    """A folder in which they were run before would say that a config exists already, so each runs once."""
    commands = [
        PROGRAM.sub("wrapit", each.removeprefix("uvx --from . "))
        for each in COMMANDS
        if kind(each) == "wrapit"
    ]
    assert len(set(commands)) >= 6
    for command in dict.fromkeys(commands):
        _, *arguments = shlex.split(command)
        if arguments[0] in ENDLESS:
            arguments = [arguments[0], "--help"]
        told = subprocess.run(
            [sys.executable, "-m", "wrapit", *arguments],
            cwd=desk,
            # With a cache, as people have one.
            env={**os.environ, "PYTHONPATH": str(ROOT), "WRAPIT_CACHE": str(desk.parent / "cache")},
            capture_output=True,
            encoding="utf-8",
            timeout=300,
            check=False,
        )
        assert told.returncode == 0, f"{command}: {told.stderr}"
    explained = list(named_files(README))
    files = [path.name for path in (desk / "build" / "fern").iterdir()]
    assert len(files) > 15
    assert [name for name in files if not any(each.fullmatch(name) for each in explained)] == []


def named_files(text: str) -> Iterator[re.Pattern[str]]:
    """The names in the table of files: any number may stand for another, and `…` for anything."""
    table = text[text.index("| file | what it is for |") :].partition("\n\n")[0]
    for row in table.splitlines()[2:]:
        stem = ""
        for name in re.findall(r"`([^`]+)`", row):
            whole = stem + name if name.startswith(".") else name
            stem = whole.partition(".")[0]
            yield re.compile(re.sub(r"\\?\d+", r"\\d+", re.escape(whole)).replace("…", ".*"))


@pytest.mark.parametrize("command", [each for each in COMMANDS if kind(each) == "make"])
def test_make_knows_its_goals(command: str, tmp_path: Path) -> None:
    """Said, not done: what the goals do has tests of its own, in tests/test_makefile.py and by being run."""
    project = Project(tmp_path / "project")
    project.add("leaf")
    told = project.make("-n", *shlex.split(command)[1:])
    assert told.returncode == 0, told.stderr


@pytest.mark.parametrize("command", [each for each in COMMANDS if kind(each) == "python"])
def test_scripts_exist(command: str) -> None:
    """tests/test_packaging.py runs every one of the examples."""
    script = Path(command.split()[1])
    assert script.parent == Path("examples")
    assert (ROOT / script).is_file()


def test_configs_that_are_shown_are_right(desk: Path) -> None:
    shown = [block for language, block in BLOCK.findall(README) if language == "yaml"]
    assert shown
    for index, block in enumerate(shown):
        path = desk / f"shown-{index}.yaml"
        path.write_text(block, encoding="utf-8")
        load_config(path)


def test_links_lead_to_files() -> None:
    links = [link for link in re.findall(r"\]\(([^)#]+)\)", README) if "://" not in link]
    assert len(links) > 4
    assert [link for link in links if not (ROOT / link).is_file()] == []


def test_commands_are_found_where_they_are_typed() -> None:
    page = "Type `wrapit build a.yaml -q`.\n```sh\nmake demo   # all\n\nwrapit doctor\n```\n"
    page += "```yaml\nmake: x\n```\n"
    assert list(typed(page)) == ["make demo", "wrapit doctor", "wrapit build a.yaml -q"]
    there = [".venv/bin/wrapit check a", r".venv\Scripts\wrapit check a", "rm -r x"]
    assert list(map(kind, there)) == ["wrapit", "wrapit", "rm"]


def test_the_table_of_files_is_read() -> None:
    table = "| file | what it is for |\n|---|---|\n| `plate-1-3mm.dxf`, `.svg`, `all-…` | and `a.png` |\n\n"
    patterns = list(named_files(table))
    known, unknown = ["plate-12-6mm.svg", "plate-1-3mm.dxf", "all-that.png", "a.png"], ["plate.svg", "plate"]
    assert [name for name in [*known, *unknown] if any(each.fullmatch(name) for each in patterns)] == known
