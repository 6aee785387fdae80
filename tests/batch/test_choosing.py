"""Which pieces are made: folders and patterns stand for their files, and no two share a folder."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.batch.catalogues import ring
from wrapit.batch.choosing import choose
from wrapit.batch.model import Piece
from wrapit.config import safe_name
from wrapit.errors import ConfigError


def names(*arguments: Path) -> list[str]:
    return [piece.name for piece in choose(arguments)]


def test_pieces_come_in_the_order_of_the_arguments(tmp_path: Path) -> None:
    assert names(*(ring(tmp_path, name) for name in ("b", "c", "a"))) == ["b", "c", "a"]


def test_a_folder_stands_for_its_configs(tmp_path: Path) -> None:
    for name in ("b", "a", ".hidden"):
        ring(tmp_path / "many", name)
    ring(tmp_path / "many", "c").rename(tmp_path / "many" / "c.YML")
    assert names(ring(tmp_path, "first"), tmp_path / "many") == ["first", "a", "b", "c"]


@pytest.mark.parametrize("pattern", ["*.yaml", "?.yaml", "[ab].yaml", "**/*.yaml", "./*.yaml"])
def test_patterns_are_expanded_where_no_shell_did(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pattern: str
) -> None:
    for name in ("b", "a"):
        ring(tmp_path, name)
    monkeypatch.chdir(tmp_path)
    assert names(Path(pattern)) == names(tmp_path / pattern) == ["a", "b"]


def test_a_file_whose_name_looks_like_a_pattern_is_that_file(tmp_path: Path) -> None:
    ring(tmp_path, "a")
    assert names(ring(tmp_path, "[a]", name="one")) == ["one"]


@pytest.mark.parametrize("what", ["*.yaml", "."])
def test_what_stands_for_no_config_is_refused(tmp_path: Path, what: str) -> None:
    with pytest.raises(ConfigError) as refused:
        choose([tmp_path / what])
    assert refused.value.where == str(tmp_path / what)
    assert refused.value.remedy


def test_a_preset_is_no_piece(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"a preset is no piece of its own; merge it: .* build :pendant "):
        choose([Path(":pendant"), ring(tmp_path, "a")])


def test_a_config_named_twice_is_made_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    config = ring(tmp_path, "a")
    (tmp_path / "link.yaml").symlink_to(config)
    monkeypatch.chdir(tmp_path)
    assert names(config, Path("a.yaml"), tmp_path, tmp_path / "link.yaml") == ["a"]


def test_a_config_that_cannot_be_loaded_is_a_piece_with_its_trouble(tmp_path: Path) -> None:
    bad = tmp_path / "bad.yaml"
    bad.write_text("drawing: a.svg\nsiez: 3\n")
    good, broken, missing = choose([ring(tmp_path, "a"), bad, tmp_path / "missing.yaml"])
    assert good.trouble is None
    assert "siez" in str(broken.trouble)
    assert "missing.yaml" in str(missing.trouble)


@pytest.mark.parametrize(
    ("one", "other"), [("bee", "bee"), ("bee", "BEE"), ("straße", "STRASSE"), ("caf\u00e9", "cafe\u0301")]
)
def test_two_of_one_name_are_refused_and_both_are_named(tmp_path: Path, one: str, other: str) -> None:
    first, second = ring(tmp_path / "1", "x", name=one), ring(tmp_path / "2", "y", name=other)
    with pytest.raises(ConfigError) as refused:
        choose([first, second])
    assert str(first) in str(refused.value)
    assert str(second) in str(refused.value)


@pytest.mark.parametrize("name", ["index.html", "batch.json", "Index.HTML"])
def test_a_piece_is_not_called_like_a_file_of_the_batch(tmp_path: Path, name: str) -> None:
    with pytest.raises(ConfigError, match="another `name:`"):
        choose([ring(tmp_path, "x", name=name)])


@given(st.lists(st.text(min_size=1, max_size=6).map(safe_name), min_size=2, max_size=4))
def test_names_that_differ_on_every_system_are_taken(given_names: list[str]) -> None:
    from wrapit.batch import choosing

    pieces = [Piece(name, Path(f"{at}.yaml")) for at, name in enumerate(given_names)]
    folders = {unicodedata.normalize("NFC", name.casefold()).casefold() for name in given_names}
    own = folders & {"batch.json", "index.html"}
    loaded = [Piece(piece.name, piece.config_path, config=object()) for piece in pieces]  # type: ignore[arg-type]
    choosing._refuse_shared_folders(pieces)  # those that couldn't be loaded have no folder
    if len({unicodedata.normalize("NFD", each) for each in folders}) == len(given_names) and not own:
        choosing._refuse_shared_folders(loaded)
    elif len(set(given_names)) < len(given_names):
        with pytest.raises(ConfigError):
            choosing._refuse_shared_folders(loaded)
