"""By a dependency file, make builds again when, and only when, a file that it names changed or is gone."""

from __future__ import annotations

import doctest
import os
import re
import subprocess
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from wrapit.errors import ExportError
from wrapit.pipeline import depfile
from wrapit.pipeline.depfile import write_depfile

MAKEFILE = "all: $(GOALS)\n-include *.d\n$(GOALS):\n\t@echo built=$@; touch $@\n"
# Whatever means something to make or its shell, twice as often as the letters of the world.
HOSTILE = " $#:%*?[]~\\'\";|&=(){}!,@+-.<>^`\t\n\r\v\f\xa0\u202fé"
# These tests may have been started by make.
OUTSIDE = {name: text for name, text in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
WORDS = ("define", "export", "include", "endif", "override", ".PHONY", "$(shell touch x)", "%.o", "a.c")

letters = st.sampled_from(HOSTILE) | st.sampled_from(HOSTILE) | st.characters(exclude_categories=["Cs"])
names = (
    st.text(letters.filter(lambda each: each not in "/\0"), min_size=1, max_size=12)
    | st.sampled_from(WORDS)
    | st.tuples(st.text(st.sampled_from(HOSTILE), max_size=3), st.sampled_from(HOSTILE)).map("".join)
).filter(lambda name: name not in (".", "..") and len(name.encode()) < 200)
FOLDERS = ("in", "~", "a b#")
places = st.sampled_from(["", "in/../in/", *(f"{folder}/" for folder in FOLDERS)])


def is_member(name: str) -> bool:
    """To make, the one of an archive."""
    return name.endswith(")") and "(" in name


def distinct(files: Iterable[str]) -> list[Path]:
    """The files without second names of one, and without those that make takes for another that is gone.

    In the place of `a*` that is gone, it looks for a file that is really called `a\\*`.
    """
    found = {os.path.normpath(file): Path(file) for file in sorted(files)}
    taken = {re.sub(r"[*?\[\\]", r"\\\g<0>", file) for file in found if re.search(r"[*?\[]", file)}
    return [path for file, path in found.items() if file not in taken and file not in (".", *FOLDERS)]


class Bench:
    """A folder with one target for each file, and a Makefile that includes a dependency file for each."""

    def __init__(self, folder: Path, files: Sequence[Path]) -> None:
        self.folder, self.files = folder, files
        self.clock = 1000
        (folder / "Makefile").write_text(MAKEFILE)
        for number, file in enumerate(files):
            Path(os.path.normpath(folder / file)).parent.mkdir(exist_ok=True)
            (folder / file).write_text("")
            # Now the source, now the product.
            lists = ([file], []) if number % 2 else ([], [file])
            write_depfile(folder / f"{number}.d", Path(f"goal{number}"), *lists)
        self.touch(files)
        assert set(self.make()) == set(files)

    def make(self) -> list[Path]:
        """Makes all, and gives the files whose targets were built."""
        goals = [f"goal{number}" for number in range(len(self.files))]
        command = ["make", "-r", "all", f"GOALS={' '.join(goals)}"]
        run = subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=False, env=OUTSIDE
        )
        assert run.returncode == 0, run.stderr
        for goal in goals:
            self._touch(self.folder / goal)
        return [self.files[int(number)] for number in re.findall(r"built=goal(\d+)", run.stdout)]

    def touch(self, files: Iterable[Path]) -> None:
        for file in files:
            self._touch(self.folder / file)

    def _touch(self, path: Path) -> None:
        """Each time is later than the one before, however coarse the clock of the disk."""
        self.clock += 10
        os.utime(path, (self.clock, self.clock))


@pytest.fixture
def bench(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> Callable[[Sequence[Path]], Bench]:
    def made(files: Sequence[Path]) -> Bench:
        folder = tmp_path_factory.mktemp("bench")
        monkeypatch.chdir(folder)
        return Bench(folder, files)

    return made


def proved(bench: Bench) -> None:
    """Touches every second file and takes away the others: each time the same are built, and no others."""
    always = {file for file in bench.files if is_member(file.name)}
    assert set(bench.make()) == always
    touched, gone = bench.files[::2], bench.files[1::2]
    bench.touch(touched)
    assert set(bench.make()) == always | set(touched)
    assert set(bench.make()) == always
    for file in gone:
        (bench.folder / file).unlink()
    assert set(bench.make()) == always | set(gone)


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(files=st.lists(st.builds("{}{}".format, places, names), min_size=2, max_size=30, unique=True))
def test_make_sees_each_file_whatever_its_name(
    files: list[str], bench: Callable[[Sequence[Path]], Bench]
) -> None:
    proved(bench(distinct(files)))


def test_each_hostile_character_in_each_place(bench: Callable[[Sequence[Path]], Bench]) -> None:
    patterns = (
        "{}",
        "{}a",
        "a{}",
        "a{}b",
        "{0}{0}",
        "a\\{}",
        "a\\\\{}b",
        "a {}b",
        "*{}",
        "\\{}*",
        "%{}",
        "{}%%",
    )
    found = {pattern.format(each) for each in HOSTILE for pattern in patterns} | set(WORDS)
    files = distinct(place + name for place in ("", "in/") for name in found - {"..", ".", "/"})
    assert len(files) > 700
    proved(bench(files))


def test_the_examples_hold() -> None:
    results = doctest.testmod(depfile)
    assert results.attempted >= 3
    assert results.failed == 0


def test_a_home_of_somebodys_is_not_looked_into(bench: Callable[[Sequence[Path]], Bench]) -> None:
    proved(bench([Path("~"), Path("~root"), Path("~+"), Path("~root*")]))


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(name=names.filter(lambda name: "=" not in name))  # to make, an argument with one sets a variable
def test_the_target_is_found_whatever_its_name(
    name: str, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path_factory.mktemp("bench")
    monkeypatch.chdir(folder)
    target = Path("build") / name / "report.json"
    target.parent.mkdir(parents=True)
    for number, file in enumerate((Path("source"), target)):
        file.touch()
        os.utime(file, (1000 + number, 1000 + number))
    write_depfile(Path("x.d"), target, [Path("source")], [])
    Path("Makefile").write_text("-include x.d\nbuild/%/report.json: ; @echo built\n")

    def built() -> bool:
        run = subprocess.run(
            ["make", "-r", str(target)], capture_output=True, text=True, check=True, env=OUTSIDE
        )
        return run.stdout == "built\n"

    assert not built()
    os.utime("source", (2000, 2000))
    assert built()


def test_a_target_that_make_cannot_name_is_refused_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(ExportError, match=r"make can't handle .*choose another -o"):
        write_depfile(tmp_path / "x.d", Path("report(1)"), [], [])
    assert not (tmp_path / "x.d").exists()


def test_a_source_whose_name_is_no_text_is_built_from_each_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "goal").touch()
    write_depfile(Path("x.d"), Path("goal"), [Path(os.fsdecode(b"caf\xe9.png"))], [])
    Path("Makefile").write_text("-include x.d\ngoal: ; @echo built\n")
    for _ in range(2):
        run = subprocess.run(["make", "goal"], capture_output=True, text=True, check=True, env=OUTSIDE)
        assert run.stdout == "built\n"


def test_a_place_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(ExportError, match="choose another -MF"):
        write_depfile(tmp_path / "file/x.d", Path("goal"), [], [])
