"""The pages beside the code say what the code says: every constant's value, every module on its map."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import pytest

import wrapit.jig

ROOT = Path(wrapit.jig.__file__).parent
PAGES = sorted(ROOT.rglob("README.md"))
CONSTANT = re.compile(r"`((?:\w+\.)+[A-Z][A-Z_0-9]+)` = (\d[\d.e-]*\d|\d)")


def constants() -> list[tuple[Path, str, str]]:
    return [(page, *found) for page in PAGES for found in CONSTANT.findall(page.read_text())]


def test_there_are_pages_and_they_name_constants() -> None:
    rooms = ["jig", "bench", "paired", "parting", "pegs", "printed", "sheet", "taut", "wrapping"]
    assert [page.parent.name for page in PAGES] == rooms
    assert len(constants()) >= 30
    assert {page for page, _, _ in constants()} == set(PAGES)


@pytest.mark.parametrize(
    ("page", "name", "value"), constants(), ids=lambda value: getattr(value, "parent", Path(str(value))).name
)
def test_a_constant_has_the_value_on_the_page(page: Path, name: str, value: str) -> None:
    package = ".".join(page.parent.relative_to(ROOT.parent.parent).parts)
    module, _, constant = name.rpartition(".")
    found = getattr(importlib.import_module(f"{package}.{module}"), constant)
    assert found == pytest.approx(float(value))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.parent.name)
def test_the_map_names_every_module_and_no_other(page: Path) -> None:
    named = set(re.findall(r"^\| `([\w/]+\.py)` \|", page.read_text(), re.MULTILINE))
    folders = [page.parent]
    folders += [each for each in page.parent.iterdir() if each.is_dir() and not (each / "README.md").exists()]
    there = {
        module.relative_to(page.parent).as_posix()
        for folder in folders
        for module in folder.glob("*.py")
        if module.name != "__init__.py"
    }
    assert named == there


def test_no_package_is_a_crowded_hall() -> None:
    """At most 15 modules a package, and no two of one name but those that every stage has."""
    usual = {"__init__", "stage", "model", "findings", "plan"}
    packages = [folder for folder in (ROOT, *ROOT.rglob("*")) if (folder / "__init__.py").exists()]
    names = [module.stem for folder in packages for module in folder.glob("*.py")]
    # __init__ is no module of its own.
    assert all(len(list(folder.glob("*.py"))) - 1 <= 15 for folder in packages)
    assert sorted(name for name in set(names) - usual if names.count(name) > 1) == []
