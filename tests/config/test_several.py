"""Several configs as one: what the last one says counts, and a mistake stands where it was written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel

from tests.config.keys import every_key
from wrapit.config import Config, SeatConfig, load_config, lock_text
from wrapit.config.decomposition import ConstraintConfig
from wrapit.config.loading import config_without_drawing, load
from wrapit.config.texts.presets import MARK, preset_names
from wrapit.config.texts.written import merged
from wrapit.errors import ConfigError

PRESETS = [Path(f"{MARK}{name}") for name in preset_names()]


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def refusal(*paths: Path, overrides: tuple[str, ...] = ()) -> str:
    with pytest.raises(ConfigError) as caught:
        load_config(paths, overrides)
    return str(caught.value)


def test_the_last_one_counts_key_by_key(tmp_path: Path) -> None:
    first = write(
        tmp_path, "a.yaml", "drawing: a.png\nwire: {gauge: 18ga, metal: brass}\njigs: [printed, sheet]\n"
    )
    second = write(tmp_path, "b.yaml", "size: 30 mm\nwire: {metal: steel}\njigs: [pegs]\n")
    config = load_config([first, second])
    assert (config.drawing, config.size, config.wire.metal, config.jigs) == ("a.png", 30, "steel", ("pegs",))
    assert config.wire.gauge == load_config(first).wire.gauge
    assert load_config([second, first]).wire.metal == "brass"
    assert load_config([first, second], ["wire.metal=bronze"]).wire.metal == "bronze"


@pytest.mark.parametrize("preset", PRESETS, ids=str)
def test_a_preset_stands_before_or_behind(tmp_path: Path, preset: Path) -> None:
    own = write(tmp_path, "bee.yaml", "drawing: bee.png\nsize: 60 mm\n")
    before, behind = load_config([preset, own]), load_config([own, preset])
    assert before.name == behind.name == "bee"
    assert before.size == 60
    assert behind.size is not None
    assert 15 <= behind.size <= 60
    assert before.bail == behind.bail
    assert before.bail is not None
    assert load([preset, own]).sources == (own,)
    again = write(tmp_path, "again.yaml", lock_text(before))
    assert lock_text(load_config(again)) == lock_text(before)


def test_a_preset_alone_needs_a_drawing() -> None:
    for preset in PRESETS:
        assert f"{preset}: a preset has no drawing" in refusal(preset)
        loaded = load(preset, ["drawing=some where/bee.png"])
        assert (loaded.config.name, loaded.drawing_path) == ("bee", Path("some where/bee.png"))
        assert config_without_drawing([preset]).bail is not None
    assert "did you mean ':earrings'?" in refusal(Path(":earing"))
    assert "choose one of :charm" in refusal(Path(":x"))
    assert "no config" in refusal()


def test_a_drawing_is_relative_to_the_file_that_names_it(tmp_path: Path) -> None:
    first = write(tmp_path, "art/a.yaml", "drawing: pictures/a.png\n")
    second = write(tmp_path, "b/b.yaml", "size: 30 mm\n")
    third = write(tmp_path, "c/c.yaml", "drawing: c.png\n")
    assert load([first, second]).drawing_path.resolve() == (tmp_path / "art/pictures/a.png").resolve()
    assert load([second, first]).drawing_path == tmp_path / "art/pictures/a.png"
    assert load([first, third, second]).drawing_path.resolve() == (tmp_path / "c/c.png").resolve()
    assert load([first, second], ["drawing=d.png"]).drawing_path == tmp_path / "b/d.png"
    absolute = write(tmp_path, "d/d.yaml", f"drawing: {tmp_path / 'x.png'}\n")
    assert load([absolute, second]).drawing_path == tmp_path / "x.png"


def test_the_name_is_the_last_files_unless_one_is_given(tmp_path: Path) -> None:
    first = write(tmp_path, "a.yaml", "drawing: a.png\n")
    second = write(tmp_path, "b.yaml", "size: 30 mm\n")
    named = write(tmp_path, "c.yaml", "name: my piece\n")
    assert load_config([first, second]).name == "b"
    assert load_config([second, first, PRESETS[0]]).name == "a"
    assert load_config([named, first, second]).name == "my piece"


def test_a_mistake_stands_where_it_was_written(tmp_path: Path) -> None:
    first = write(tmp_path, "a.yaml", "drawing: a.png\nwire:\n  guage: 18 AWG\n")
    second = write(tmp_path, "b.yaml", "\nwire:\n  metal: oak\njigs: [printed, laser]\n")
    good = write(tmp_path, "c.yaml", "size: 4 cm\nwire: {gauge: 1 mm}\n")
    assert f"{first}:3:3 wire.guage: unknown key" in refusal(first, good)
    plain = write(tmp_path, "d.yaml", "drawing: a.png\nwire: {metal: brass}\n")
    assert f"{second}:3:3 wire.metal: 'oak'" in refusal(plain, second, good)
    assert "--set wire.gauge=1: 1 has no unit" in refusal(plain, good, overrides=("wire.gauge=1",))
    assert f"{good}:1:1 drawing: this key is missing" in refusal(PRESETS[0], good)
    assert "drawin: unknown key; did you mean 'drawing'" in refusal(
        write(tmp_path, "e.yaml", "drawin: a.png")
    )


BLOCKS = st.recursive(
    st.integers() | st.lists(st.integers(), max_size=2),
    lambda inner: st.dictionaries(st.sampled_from("abc"), inner, max_size=3),
    max_leaves=8,
)


@given(st.lists(st.dictionaries(st.sampled_from("abc"), BLOCKS, max_size=3), min_size=3, max_size=3))
def test_merging_is_the_same_in_any_grouping(blocks: list[dict[str, Any]]) -> None:
    first, second, third = blocks
    at_once = merged(blocks)
    assert merged([merged([first, second]), third]) == at_once
    assert merged([at_once, third]) == at_once
    assert merged([first, {}]) == merged([first]) == first


def _typed(key: str) -> str:
    """A key with two letters changed places, or one doubled where it has only two."""
    return f"{key[:1]}{key[2]}{key[1]}{key[3:]}" if len(key) > 2 and key[1] != key[2] else f"{key}{key[-1]}"


NESTED = sorted(every_key(Config))


@pytest.mark.parametrize("key", NESTED)
def test_every_mistyped_key_is_recognised(tmp_path: Path, key: str) -> None:
    *blocks, last = key.split(".")
    config = write(tmp_path, "a.yaml", "drawing: a.png\n")
    if blocks and blocks[-1] in ("constraints", "seats"):
        return  # entries of lists: below
    said = refusal(config, overrides=(".".join([*blocks, _typed(last)]) + "=1",))
    assert "unknown key; did you mean" in said
    assert f"'{last}'" in said


@pytest.mark.parametrize(
    ("key", "block"), [("decomposition.constraints", ConstraintConfig), ("jig.seats", SeatConfig)]
)
def test_every_mistyped_key_in_a_list_is_recognised(tmp_path: Path, key: str, block: type[BaseModel]) -> None:
    config = write(tmp_path, "a.yaml", "drawing: a.png\n")
    for name in block.model_fields:
        said = refusal(config, overrides=(f"{key}=[{{{_typed(name)}: 1}}]",))
        assert f"unknown key; did you mean '{name}'" in said


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("gauge=18ga", "wire.gauge"),
        ("kerf=1 mm", "plate.kerf"),
        ("smoothness=1", "decomposition.weights.smoothness"),
        ("sameWire=[1, 2]", "decomposition.constraints.same_wire"),
        ("decomposition.max-wire-length=3 m", "max_wire_length"),
    ],
)
def test_a_key_in_the_wrong_block_is_told_where_it_belongs(tmp_path: Path, wrong: str, right: str) -> None:
    assert f"{right}'?" in refusal(write(tmp_path, "a.yaml", "drawing: a.png\n"), overrides=(wrong,))


def test_a_block_where_a_list_belongs_is_answered_with_an_example(tmp_path: Path) -> None:
    said = refusal(
        write(tmp_path, "a.yaml", "drawing: a.png\n"), overrides=("decomposition.constraints={cut_at: 1}",)
    )
    assert "write for example constraints: [{same_wire: [3, 7]}, {start_at: 4}]" in said
