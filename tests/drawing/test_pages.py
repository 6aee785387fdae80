"""The pages in the rooms of drawing: their examples run, and what they name is there."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import wrapit.drawing

ROOM = Path(wrapit.drawing.__file__).parent
PAGES = sorted(ROOM.rglob("README.md"))


def names(page: Path) -> set[str]:
    """What a page sets in backticks, without what is in its examples."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return set(re.findall(r"`([^`\n]+)`", text))


def modules(page: Path) -> list[Path]:
    """The modules of a page's room, and of rooms in it that have no page of their own."""
    inside = [path for path in page.parent.rglob("*.py") if path.name != "__init__.py"]
    return [path for path in inside if not any(
        other != page and other.parent in path.parents and page.parent in other.parents for other in PAGES
    )]  # fmt: skip


def test_each_room_has_a_page():
    assert [page.parent.relative_to(ROOM).as_posix() for page in PAGES] == [".", "bitmap", "svg"]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.parent.name)
def test_the_examples_of_a_page_run(page):
    assert doctest.testfile(str(page), module_relative=False).failed == 0


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.parent.name)
def test_a_page_lists_all_modules_of_its_room_and_no_others(page):
    listed = {name.rpartition("/")[2] for name in names(page) if name.endswith(".py")}
    listed = {name for name in listed if not name.startswith("test_")}
    assert {path.name for path in modules(page)} <= listed
    assert listed <= {path.name for path in ROOM.rglob("*.py")}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.parent.name)
def test_constants_that_a_page_names_are_there(page):
    source = "".join(path.read_text(encoding="utf-8") for path in modules(page))
    named = {name for text in names(page) for name in re.findall(r"\b_?[A-Z][A-Z]+(?:_[A-Z]+)*\b", text)}
    constants = {name for name in named if name.startswith("_") or "_" in name}
    assert constants
    missing = {name for name in constants if not re.search(rf"^(?:\w+, )?{name}\b", source, re.MULTILINE)}
    assert not missing
