"""The pages in the rooms: examples run, maps name each module, constants have reasons."""

from __future__ import annotations

import doctest
import importlib
import re
from pathlib import Path

import pytest

import wrapit.decomposition

ROOM = Path(wrapit.decomposition.__file__).parent
PAGES = sorted(ROOM.rglob("README.md"))
MODULES = sorted(path for path in ROOM.rglob("*.py") if path.name != "__init__.py")
CONSTANT = re.compile(r"_?[A-Z][A-Z0-9_]+(: [^=]+)? = ")


def named(path: Path) -> str:
    return str(path.relative_to(ROOM))


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_the_examples_of_a_page_run(page: Path) -> None:
    outcome = doctest.testfile(str(page), module_relative=False)
    assert outcome.attempted >= 1
    assert outcome.failed == 0


@pytest.mark.parametrize("module", MODULES, ids=named)
def test_the_examples_of_a_module_run(module: Path) -> None:
    name = "wrapit.decomposition." + named(module).removesuffix(".py").replace("/", ".")
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_the_map_names_the_modules_that_there_are(page: Path) -> None:
    listed = set(re.findall(r"^\| `(\w+)\.py` \|", page.read_text(), re.MULTILINE))
    assert listed == {path.stem for path in page.parent.glob("*.py")} - {"__init__"}


@pytest.mark.parametrize("module", MODULES, ids=named)
def test_constants_carry_their_reason(module: Path) -> None:
    """A comment before it or on its line, or a text below; a group that no empty line parts may share one."""
    lines = ["", *module.read_text().splitlines()]
    for number, line in enumerate(lines):
        if CONSTANT.match(line):
            first = number
            while CONSTANT.match(lines[first - 1]):
                first -= 1
            after = [other for other in lines[number + 1 :] if not other.startswith((" ", ")", "}"))]
            assert "  # " in line or lines[first - 1].startswith("#") or after[0].startswith('"""'), line
