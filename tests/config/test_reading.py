"""No file, however odd, takes long or ends in anything but one clear line."""

from __future__ import annotations

import os
import re
import shlex
import socket
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.config.test_loading import GOOD, load
from wrapit.config import load_config
from wrapit.config.texts.budgets import DEEPEST, MOST_NODES
from wrapit.config.texts.reading import DRAWINGS, LARGEST_FILE, read_yaml
from wrapit.drawing.stage import BITMAPS
from wrapit.errors import ConfigError

FAST_S = 5.0
"""For each refusal here, on a busy machine; measured is 1 s for the largest file, else hundredths."""


def refusal(path: Path, *overrides: str) -> ConfigError:
    start = time.perf_counter()
    with pytest.raises(ConfigError) as caught:
        load_config(path, overrides)
    assert time.perf_counter() - start < FAST_S
    error = caught.value
    assert error.problem
    assert error.remedy
    assert str(error).isprintable()
    assert len(error.problem) < 300
    assert not re.search(r"Error: ?\)|\( *\)$", error.problem)
    return error


def written(tmp_path: Path, text: str | bytes) -> Path:
    path = tmp_path / "bee.yaml"
    path.write_bytes(text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text)
    return path


def test_what_is_no_ordinary_file_is_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.yaml")
    with socket.socket(socket.AF_UNIX) as plug:
        plug.bind(str(tmp_path / "plug"))
        for path in (tmp_path / "pipe.yaml", tmp_path / "plug", Path("/dev/zero"), tmp_path):
            assert "can't be read (it is" in refusal(path).problem
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for path in (tmp_path / "loop", tmp_path / ("x" * 300), Path("nul\0.yaml"), tmp_path / "bee.yaml" / "x"):
        assert re.search(r"can't be read \(.+\)|no such config", refusal(path).problem)


def test_a_drawing_in_place_of_its_config_is_known(tmp_path: Path) -> None:
    assert set(BITMAPS) < set(DRAWINGS)
    for suffix in (*DRAWINGS, ".SVG"):
        path = tmp_path / f"my bee{suffix}"
        path.write_bytes(b'\n{ "format": "wrapit-drawing/1", "junctions": [' + b"[0, 0], " * 90_000)
        error = refusal(path)
        assert error.problem == "this is a drawing, no config"
        assert error.remedy.endswith(f"init {shlex.quote(str(path))}")
    assert refusal(tmp_path / "none.png").problem == "no such config"
    (tmp_path / "bee.json").write_text('{"drawing": "my bee.png", "size": "40 mm"}')
    assert load_config(tmp_path / "bee.json").size == 40


def test_a_large_file_is_refused_and_the_largest_is_read(tmp_path: Path) -> None:
    comment = "# bee\n" * ((LARGEST_FILE - len(GOOD)) // 6)
    start = time.perf_counter()
    assert load(tmp_path, GOOD + comment).name == "bee"
    assert time.perf_counter() - start < FAST_S
    assert "larger than 200 kB" in refusal(written(tmp_path, GOOD + comment + "# bee\n" * 200)).problem
    with (tmp_path / "hollow.yaml").open("wb") as file:
        file.truncate(10**10)
    assert "larger than 200 kB" in refusal(tmp_path / "hollow.yaml").problem


def bomb(levels: int, width: int = 9) -> str:
    lines = ["a0: &a0 [x]"]
    lines += [f"a{level}: &a{level} [{', '.join([f'*a{level - 1}'] * width)}]" for level in range(1, levels)]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("levels", [5, 9, 30])
def test_aliases_are_counted_as_what_they_stand_for(tmp_path: Path, levels: int) -> None:
    error = refusal(written(tmp_path, GOOD + bomb(levels)))
    assert "more than 10,000 values" in error.problem
    assert ":11:" in error.where, "the line where it gets too much, however many follow"


@pytest.mark.parametrize(
    "text",
    [
        "jig: &a {seats: [*a]}",
        "jig: &a [*a]",
        "jig: &a {<<: *a}",
        "jig: &a [[[*a]]]",
    ],
)
def test_what_contains_itself_is_refused(tmp_path: Path, text: str) -> None:
    assert "*a stands for something that contains it" in refusal(written(tmp_path, GOOD + text)).problem


def test_aliases_and_merges_within_reason_are_fine(tmp_path: Path) -> None:
    text = "plate: &p {min_wall_width: &w 1.5 mm}\njig: {<<: *p, margin: *w}\npair: &yes true\n"
    config = load(tmp_path, GOOD + text)
    assert config.jig.min_wall_width == config.plate.min_wall_width == config.jig.margin == 1.5
    assert config.pair is True
    changed = load(tmp_path, GOOD + "plate: &p {min_wall_width: 1 mm}\njig: *p\n", "jig.min_wall_width=2 mm")
    assert (changed.plate.min_wall_width, changed.jig.min_wall_width) == (1, 2), "an override changes one"


@pytest.mark.parametrize("opening", ["[", "{a: ", "[{a: ", "- ", "? ", "\n{a: ["])
@pytest.mark.parametrize("levels", [DEEPEST + 1, 1000, 20_000])
def test_deep_nesting_is_refused_before_it_is_followed(tmp_path: Path, opening: str, levels: int) -> None:
    error = refusal(written(tmp_path, GOOD + "jig:\n  " + opening * levels))
    assert error.where.startswith(str(tmp_path))
    assert re.search(r"levels deep|not valid YAML|is not a word", error.problem)


def test_the_deepest_nesting_is_read() -> None:
    assert read_yaml("[" * DEEPEST + "]" * DEEPEST, "x") is not None
    with pytest.raises(ConfigError, match="32 levels deep"):
        read_yaml("[" * (DEEPEST + 1) + "]" * (DEEPEST + 1), "x")


def test_the_most_values_are_read() -> None:
    assert len(read_yaml(f"[{'1,' * (MOST_NODES - 1)}]", "x")) == MOST_NODES - 1
    with pytest.raises(ConfigError, match="more than 10,000 values"):
        read_yaml(f"[{'1,' * MOST_NODES}]", "x")


@pytest.mark.parametrize(
    ("text", "place", "problem"),
    [
        ("jig: !!python/object/apply:os.system ['true']\n", ":7:6", "the tag"),
        ("jig: !!python/name:os.system\n", ":7:6", "the tag"),
        ("outputs: !!set {step, stl}\n", ":7:10", "the tag"),
        ("pair: !!binary aGVsbG8=\n", ":7:7", "the tag"),
        ("pair: !!timestamp 2001-01-01\n", ":7:7", "the tag"),
        ("pair: ! yes\n", ":7:7", "the tag"),
        ("jig: {margin: !x 3 mm}\n", ":7:15", "the tag"),
        ("jig: {margin: 3 mm, margin: 4 mm}\n", ":7:21", "duplicate key"),
        ("name: bee\n", ":7:1", "duplicate key"),
        ("3: x\n", ":7:1", "the key '3' is not a word"),
        ("null: x\n", ":7:1", "the key 'null' is not a word"),
        ("~: x\n", ":7:1", "the key '~' is not a word"),
        ("true: x\n", ":7:1", "is not a word"),
        (".nan: x\n", ":7:1", "is not a word"),
        ("2001-01-01: x\n", ":7:1", "is not a word"),
        ("[a, b]: x\n", ":7:1", "is not a word"),
        ("? {a: b}\n: x\n", ":7:3", "is not a word"),
        ("plate: &a {}\n*a : x\n", ":8:1", "is not a word"),
        ("jig: {1: 2}\n", ":7:7", "the key '1' is not a word"),
        ("pair: \0\n", ":7:7", "character"),
        ("pair: \x1b[31m\n", ":7:7", "character"),
        ('pair: "\\0"\n', ":7:7", "character"),
        ('pair: "\\ud800"\n', ":7:7", "character"),
        ("pair: *unknown\n", ":7:7", "unknown"),
        ("---\nname: bee\n", ":7:1", "second document"),
        ("...\n---\n...\n", ":8:1", "second document"),
        ("pair: 1" + "0" * 5000 + "\n", ":7:7", "5001 digits"),
        ("decomposition: {seed: 0x" + "f" * 5000 + "}\n", ":7:23", "5002 digits"),
        ("pair: 2001-13-45\n", ":7:1 pair", "true or false"),
        ("pair: 99:99:99.999\n", ":7:1 pair", "true or false"),
        ("\tpair: true\n", ":7:1", "not valid YAML"),
        ("pair: @x\n", ":7:7", "not valid YAML"),
        ("jig:\n  margin: 3 mm\n pair: true\n", ":9:2", "not valid YAML"),
        ("x" * 5000 + ": 1\n", ":7:5001", "expected ':'"),
    ],
)
def test_odd_yaml_is_refused_with_its_place(tmp_path: Path, text: str, place: str, problem: str) -> None:
    error = refusal(written(tmp_path, GOOD + text))
    assert problem in error.problem
    assert error.where.startswith(f"{tmp_path}/bee.yaml{place}")


def test_directives_are_refused(tmp_path: Path) -> None:
    for line in ("%YAML 1.1", "%TAG ! tag:x.org,2000:"):
        assert "directive" in refusal(written(tmp_path, f"{line}\n---\n{GOOD}")).problem


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-32", "cp037"])
def test_text_that_is_not_utf8_is_refused(tmp_path: Path, encoding: str) -> None:
    refusal(written(tmp_path, GOOD.encode(encoding)))


def test_bytes_that_are_no_text_are_named_with_their_line(tmp_path: Path) -> None:
    error = refusal(written(tmp_path, GOOD.encode() + b"# caf\xe9\n"))
    assert "in line 7, is not UTF-8" in error.problem
    assert "save it as UTF-8" in error.remedy
    assert "not UTF-8" in refusal(written(tmp_path, GOOD + "# \ud800\n")).problem
    assert load_config(written(tmp_path, b"\xef\xbb\xbf" + GOOD.encode())).name == "bee"


@pytest.mark.parametrize(
    "override",
    [
        "size=2001-13-45",
        "size=2001-02-30T99:99:99",
        "size=" + "9" * 5000,
        "size=" + "[" * 4000,
        "size=" + "[" * 40 + "]" * 40,
        "size=" + "x" * 100_000,
        "a" * 100_000 + "=1",
        ".".join("a" * 5000) + "=1",
        ".".join("jig" for _ in range(33)) + "=1",
        "jig..margin=3 mm",
        ".=1",
        "size=!!python/object/apply:os.system [true]",
        "size=*a",
        "size=&a [*a]",
        "size={1: 2}",
        "size=\0",
        "size=\udcff mm",
        "\udcff=1",
        "size=\x1b[31m",
        "size=a: b: c",
        "size=--- 1\n--- 2",
        "size=.nan",
        "size=[",
        "size=%",
        "decomposition.seed=1e999",
        "wire.gauge=",
        "wire=",
        "drawing=",
        "drawing={}",
        "name=\U0001f41d",
        "name=CON",
    ],
)  # fmt: skip
def test_odd_overrides_are_refused_and_named(tmp_path: Path, override: str) -> None:
    error = refusal(written(tmp_path, GOOD), override)
    assert error.where.startswith("--set ")
    assert len(error.where) < 100


def test_an_override_may_say_nothing(tmp_path: Path) -> None:
    assert load(tmp_path, GOOD, "size=").size is None


ANYTHING = st.text(st.characters(exclude_categories=()), max_size=40)
YAMLISH = st.text(alphabet="ab1.: -[]{}&*!|>%@\"'#,?\n\t\\0xeu~<=", max_size=60)


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(text=ANYTHING | YAMLISH, good=st.booleans())
def test_any_text_is_a_config_or_one_clear_line(tmp_path: Path, text: str, good: bool) -> None:
    try:
        load_config(written(tmp_path, GOOD * good + text))
    except ConfigError:
        refusal(written(tmp_path, GOOD * good + text))


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    key=st.sampled_from(["size", "wire.gauge", "jig.seats", "name", "pair", ""]) | ANYTHING,
    text=ANYTHING | YAMLISH,
)
def test_any_override_is_taken_or_refused_in_one_clear_line(tmp_path: Path, key: str, text: str) -> None:
    path = written(tmp_path, GOOD)
    try:
        load_config(path, [f"{key}={text}"])
    except ConfigError:
        refusal(path, f"{key}={text}")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.binary(max_size=60))
def test_any_bytes_are_refused_clearly(tmp_path: Path, content: bytes) -> None:
    refusal(written(tmp_path, content))
