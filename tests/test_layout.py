"""The house in order: rooms of a size to know, one name a thing, a page in each, nothing needless."""

from __future__ import annotations

import ast
import doctest
import importlib
import importlib.metadata
import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parent.parent
HOUSE = ROOT / "wrapit"
MOST_MODULES = 15
MOST_LINES = 300
# Names that mean the same in every room. Those in config/ mirror the keys of the YAML.
SHARED = {"__init__", "stage", "model", "findings", "json_file", "plan"}
# Imported by a name of its own, but a part of another: pydantic pins it to the last digit.
PART_OF = {"pydantic-core": "pydantic"}


def modules(house: Path) -> list[Path]:
    return sorted(house.rglob("*.py"))


def crowded(house: Path) -> Iterator[str]:
    """Packages with too many modules."""
    for room in sorted({path.parent for path in modules(house)}):
        count = len([path for path in room.glob("*.py") if path.stem != "__init__"])
        if count > MOST_MODULES:
            yield f"{room.relative_to(house)} has {count} modules"


def ambiguous(house: Path) -> Iterator[str]:
    """Module names that are given twice."""
    places = defaultdict(list)
    for path in modules(house):
        if path.stem not in SHARED and path.parent != house / "config":
            places[path.stem].append(str(path.relative_to(house)))
    yield from (" and ".join(paths) for paths in places.values() if len(paths) > 1)


def long(house: Path) -> Iterator[str]:
    """Modules that nobody reads in one go."""
    for path in modules(house):
        lines = len(path.read_text(encoding="utf-8").splitlines())
        if lines > MOST_LINES:
            yield f"{path.relative_to(house)} has {lines} lines"


def without_page(house: Path) -> Iterator[str]:
    """The house itself and its rooms, where no page says what they are for."""
    rooms = [house, *sorted(path.parent for path in house.glob("*/__init__.py"))]
    yield from (str(room.relative_to(house)) for room in rooms if not (room / "README.md").is_file())


def left_out(house: Path) -> Iterator[str]:
    """Modules that the page of their room doesn't name, nor a page nearer by."""
    for path in modules(house):
        rooms = [room for room in path.parents if room.is_relative_to(house)]
        pages = [room / "README.md" for room in rooms if room != house or path.parent == house]
        texts = [page.read_text(encoding="utf-8") for page in pages if page.is_file()]
        named = any(re.search(rf"(?<!\w){re.escape(path.stem)}(?!\w)", text) for text in texts)
        if texts and path.stem not in ("__init__", "__main__") and not named:
            yield str(path.relative_to(house))


# Rooms whose constants all say which question they answer, or what set them.
EXPLAINED = (
    "config", "geometry", "drawing", "decomposition", "wires", "kernel", "jig", "exports", "instructions",
    "pipeline", "batch", "studio", "cli",
)  # fmt: skip
CONSTANT = re.compile(r"_?[A-Z][A-Z0-9_]+(?:, _?[A-Z][A-Z0-9_]+)*(?:: .*?)? = ")


def unexplained(house: Path) -> Iterator[str]:
    """Constants without a comment: above them or their group, behind them, or as a text below."""
    for path in (path for room in EXPLAINED for path in modules(house / room)):
        lines = path.read_text(encoding="utf-8").splitlines()
        said = False
        for index, line in enumerate(lines):
            if not CONSTANT.match(line):
                said = line.startswith("#") or (said and line.startswith((" ", ")", "}", "]")))
                continue
            behind = "  # " in line
            group = [*lines[index + 1 :], ""]
            below = next(
                after
                for after in group
                if not CONSTANT.match(after) and not after.startswith((" ", ")", "}"))
            )
            if not (said or behind or below.startswith('"""')):
                yield f"{path.relative_to(house)}:{index + 1} {line.partition(' =')[0]}"


@pytest.mark.parametrize("disorder", [unexplained, crowded, ambiguous, long, without_page, left_out])
def test_the_house_is_in_order(disorder: Callable[[Path], Iterator[str]]) -> None:
    assert list(disorder(HOUSE)) == []


def test_disorder_is_noticed(tmp_path: Path) -> None:
    for room, count in (("", 1), ("full", MOST_MODULES + 1), ("half", MOST_MODULES), ("config", 2)):
        (tmp_path / room).mkdir(exist_ok=True)
        for name in ("__init__", *(f"{room}_{number}" for number in range(count))):
            (tmp_path / room / f"{name}.py").write_text("1\n" * MOST_LINES)
    for room in ("", "full", "half"):
        (tmp_path / room / "README.md").write_text(" ".join(f"`{room}_{n}`" for n in range(1, 20)))
    (tmp_path / "half" / "full_1.py").write_text("1\n" * (MOST_LINES + 1))
    (tmp_path / "half" / "half_1.py").unlink()
    (tmp_path / "config" / "half_2.py").touch()
    (tmp_path / "half" / "stage.py").touch()
    (tmp_path / "cli").mkdir()
    (tmp_path / "cli" / "main.py").write_text(
        "# Why.\nAA, BB = 1, 2\nCC = 3\n\nDD = 4\nEE = 5  # so\n\nFF = {\n    1: 2,\n}\n"
    )
    assert list(unexplained(tmp_path)) == ["cli/main.py:5 DD", "cli/main.py:8 FF"]
    assert list(crowded(tmp_path)) == ["full has 16 modules", "half has 16 modules"]
    assert list(ambiguous(tmp_path)) == ["full/full_1.py and half/full_1.py"]
    assert list(long(tmp_path)) == ["half/full_1.py has 301 lines"]
    assert list(without_page(tmp_path)) == ["config"]
    missing = ["_0.py", "full/full_0.py", "half/full_1.py", "half/half_0.py", "half/stage.py"]
    assert list(left_out(tmp_path)) == missing


PAGES = sorted(HOUSE.rglob("README.md"))
SHOWN = [path for path in modules(HOUSE) if ">>>" in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", SHOWN, ids=[str(path.relative_to(HOUSE)) for path in SHOWN])
def test_what_a_docstring_shows_is_what_happens(path: Path) -> None:
    name = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
    outcome = doctest.testmod(importlib.import_module(name))
    assert outcome.attempted > 0
    assert outcome.failed == 0


@pytest.mark.parametrize("page", PAGES, ids=[str(page.parent.relative_to(HOUSE)) for page in PAGES])
def test_what_a_page_shows_is_what_happens(page: Path) -> None:
    assert doctest.testfile(str(page), module_relative=False, encoding="utf-8").failed == 0


@pytest.mark.parametrize("page", PAGES, ids=[str(page.parent.relative_to(HOUSE)) for page in PAGES])
def test_the_modules_that_a_page_names_exist(page: Path) -> None:
    """Names as `bitmap/ink.py` or `ink.py`, from the page's room or from the house; `new` is to be made."""
    named = re.findall(r"`([\w./]+\.py)`", page.read_text(encoding="utf-8"))
    gone = [name for name in named if not any(found(name, room) for room in (page.parent, HOUSE, ROOT))]
    assert gone == []


def found(name: str, room: Path) -> bool:
    return (room / name).is_file() or ("/" not in name and any(room.rglob(name)))


def imported() -> dict[str, str]:
    """The distributions that wrapit imports something from, with a module that does."""
    owners = importlib.metadata.packages_distributions()
    seen = {}
    for path in modules(HOUSE):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module or ""]
            for name in {name.partition(".")[0] for name in names} - sys.stdlib_module_names - {"wrapit"}:
                # Several distributions share a namespace such as `ruamel`.
                (owner, *others) = [canonicalize_name(each) for each in dict.fromkeys(owners[name])]
                fitting = [each for each in (owner, *others) if each in required() | offered()]
                seen[PART_OF.get(owner, fitting[0] if fitting else owner)] = str(path.relative_to(HOUSE))
    return seen


def required() -> set[str]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return {canonicalize_name(Requirement(line).name) for line in project["dependencies"]}


def offered() -> set[str]:
    """What the extras for users add."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = {name: lines for name, lines in project["optional-dependencies"].items() if name != "dev"}
    return {canonicalize_name(Requirement(line).name) for lines in extras.values() for line in lines}


def test_what_is_required_is_imported_and_what_is_imported_is_required() -> None:
    seen = imported()
    assert {name: seen.get(name) for name in (required() | offered()) ^ seen.keys()} == {}


def test_each_requirement_says_why_it_is_there() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    listed = re.search(r"^dependencies = \[\n(.*?)^\]", text, re.MULTILINE | re.DOTALL)
    assert listed is not None
    entries = [line.strip() for line in listed[1].splitlines() if not line.strip().startswith("#")]
    assert len(entries) == len(required())
    assert [entry for entry in entries if not re.fullmatch(r'"[^"]+",  # \w.{8,}', entry)] == []
