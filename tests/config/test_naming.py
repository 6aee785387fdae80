"""Every name of a piece is one for a folder, on any system."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.config.test_loading import GOOD, load
from wrapit.config import load_config, named_after, safe_name
from wrapit.config.naming import DEVICES, LONGEST_NAME, LONGEST_NAME_BYTES, name_problem, path_problem
from wrapit.errors import ConfigError

NAMES = {
    "bee": "bee",
    "Bee 2.1_final-b": "Bee 2.1_final-b",
    "_private": "_private",
    "Жук": "Жук",
    "हार": "हार",
    "蜂": "蜂",
    "<script>": "script-",
    "a\nb": "a-b",
    "-rf": "rf",
    "--": "piece",
    "..": "piece",
    "": "piece",
    " ": "piece",
    "🐝": "piece",
    "!?": "piece",
    "con:": "con-",
    "con": "con-piece",
    "NUL": "NUL-piece",
    "com1.v2": "com1-piece.v2",
    "Lpt¹ .x": "Lpt¹-piece.x",
    "console": "console",
    "bee. .": "bee",
    "x" * 300: "x" * 80,
    "蜂" * 80: "蜂" * 66,
    "con" + " " * 90 + "x": "con-piece",
    "../../etc/passwd": "etc-passwd",
    "a\0b\ud800c\u202ed": "a-b-c-d",
    "a/b\\c": "a-b-c",
}


@pytest.mark.parametrize(("stem", "name"), NAMES.items(), ids=[ascii(stem)[:30] for stem in NAMES])
def test_names_are_made_safe(stem: str, name: str) -> None:
    assert safe_name(stem) == name


@given(
    st.text(st.characters(exclude_categories=()), max_size=120)
    | st.sampled_from(sorted(DEVICES)).flatmap(lambda name: st.text(" .x-", max_size=90).map(name.__add__))
    | st.text("éa蜂𝔞. -", min_size=60, max_size=300)
)
@example("con" + " " * 90)
def test_a_safe_name_is_safe_and_stays(stem: str) -> None:
    name = safe_name(stem)
    assert name
    assert len(name) <= LONGEST_NAME
    assert len(name.encode("utf-8")) <= LONGEST_NAME_BYTES
    assert name[0] not in "-. "
    assert name[-1] not in ". "
    assert name.partition(".")[0].strip().lower() not in DEVICES
    assert all(each in "_.- " or unicodedata.category(each)[0] in "LMN" for each in name)
    assert safe_name(name) == name
    assert name_problem(name) is None


@given(st.text(st.characters(exclude_categories=()), max_size=120))
def test_a_name_is_refused_with_one_that_works(name: str) -> None:
    problem = name_problem(name)
    assert (problem is None) == (safe_name(name) == name)
    if problem is not None:
        assert problem.isprintable()
        assert repr(safe_name(name)) in problem.partition("; ")[2]


@pytest.mark.parametrize("stem", ["<script>", "-rf", "con", "🐝", "x" * 200, "bee ", " bee", "a\nb"])
def test_a_config_without_name_gets_a_safe_one(tmp_path: Path, stem: str) -> None:
    path = tmp_path / f"{stem}.yaml"
    path.write_text(GOOD.replace("name: bee\n", ""))
    name, changed = named_after(path)
    assert changed
    assert load_config(path).name == name == safe_name(stem)
    assert named_after(Path(f"{name}.yaml")) == (name, False)


@pytest.mark.parametrize(
    "name",
    [
        '"-rf"',
        '".."',
        '"a/b"',
        "con",
        "Com1.x",
        '"bee."',
        '"bee "',
        "x" * 81,
        "蜂" * 70,
        "🐝",
        '"<b>"',
        '"a\\nb"',
        '"."',
    ],
)
def test_a_bad_name_is_refused_with_a_good_one(tmp_path: Path, name: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, GOOD.replace("name: bee", f"name: {name}"))
    error = caught.value
    assert error.where.endswith(":1:1 name")
    assert "folder" in error.problem
    proposed = error.remedy.removeprefix("write for example ")
    assert load(tmp_path, GOOD.replace("name: bee", f"name: {proposed}")).name == proposed[1:-1]


@pytest.mark.parametrize(
    "drawing", ["x" * 300, '"a\\0b"', '"a\\nb"', '" "', '""', "蜂" * 90 + ".png", "a/" * 600]
)
def test_a_bad_drawing_is_refused_with_its_place(tmp_path: Path, drawing: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, GOOD.replace("drawing: bee.png", f"drawing: {drawing}"))
    assert ":2:1 drawing" in str(caught.value) or ":2:10" in str(caught.value)
    assert caught.value.remedy
    assert len(caught.value.problem) < 300


def test_common_drawings_are_fine() -> None:
    for path in (
        "bee.png",
        "../bee.png",
        "/a/b c/蜂.svg",
        "a" * 255,
        "C:\\x\\bee.png",
        "at 3\u202fPM.png",
        "👩\u200d🎨.png",
        "a/b/" * 100,
    ):
        assert path_problem(path) is None
