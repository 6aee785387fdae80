"""Entries are whole or missing, few enough, and nobody else's."""

from __future__ import annotations

import os
import time
from collections import namedtuple
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.errors import ConfigError
from wrapit.pipeline.cache import store as stores
from wrapit.pipeline.cache.fingerprint import fingerprint
from wrapit.pipeline.cache.place import usual_store
from wrapit.pipeline.cache.sealed import Entry, opened, sealed
from wrapit.pipeline.cache.store import Store

ENTRY = Entry({"blocks": {"ä": [1, 0.1, None]}}, {"jig.stl": b"\0solid", "empty": b""}, b"value")
MB = 1_000_000
Usage = namedtuple("Usage", "total used free")


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "cache", 100 * MB)


def place(store: Store, key: str) -> Path:
    assert store.folder is not None
    return store.folder / f"{key}.entry"


@given(files=st.dictionaries(st.text(), st.binary()), value=st.binary(), number=st.floats(allow_nan=False))
def test_what_is_opened_is_what_was_sealed(files: dict[str, bytes], value: bytes, number: float) -> None:
    entry = Entry({"number": number}, files, value)
    assert opened("key", sealed("key", entry)) == entry


@given(st.data())
def test_no_other_bytes_are_taken_for_an_entry(data: st.DataObject) -> None:
    whole = sealed("key", ENTRY)
    at = data.draw(st.integers(0, len(whole) - 1))
    flipped = bytes([whole[at] ^ data.draw(st.integers(1, 255))])
    changed = [whole[:at], whole[:at] + flipped + whole[at + 1 :], whole + b"\0", whole[:at] + whole]
    for spoilt in changed[:3] if at == 0 else changed:
        with pytest.raises(ValueError, match="not an entry"):
            opened("key", spoilt)


def test_what_is_put_is_there_until_it_is_spoilt(store: Store) -> None:
    assert not store.has("a")
    assert store.get("a") is None
    store.put("a", ENTRY)
    assert store.has("a")
    assert store.get("a") == ENTRY
    assert store.unread().get("a") is None
    for spoilt in (b"", b"foreign", place(store, "a").read_bytes()[:-1], sealed("b", ENTRY)):
        place(store, "a").write_bytes(spoilt)
        assert store.get("a") is None
        assert not place(store, "a").exists()
    assert store.trouble == ""


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="rights of other users are those of this system")
def test_the_folder_is_the_users_alone(store: Store) -> None:
    store.put("a", ENTRY)
    assert store.folder is not None
    assert store.folder.stat().st_mode & 0o777 == 0o700
    assert place(store, "a").stat().st_mode & 0o077 == 0
    store.folder.chmod(0o777)
    assert store.get("a") is None, "anybody may have written it"
    assert store.trouble == "others may write there"
    store.put("b", ENTRY)
    assert not place(store, "b").exists()


def test_without_room_nothing_is_kept(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stores.shutil, "disk_usage", lambda path: Usage(9, 9, stores.LEAST_FREE_BYTES))
    store.put("a", ENTRY)
    assert "no space left" in store.trouble
    assert store.folder is not None
    assert list(store.folder.iterdir()) == []


@pytest.mark.parametrize("blocked", ["a file", "under a file"])
def test_where_no_folder_can_be_nothing_is_kept(tmp_path: Path, blocked: str) -> None:
    (tmp_path / "file").touch()
    store = Store(tmp_path / "file" if blocked == "a file" else tmp_path / "file" / "cache", MB)
    assert store.get("a") is None
    store.put("a", ENTRY)
    assert store.trouble != ""
    store.trim()


def test_what_another_build_trims_meanwhile_is_missing(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    store.put("a", ENTRY)
    usual = Store.has

    def trimmed_behind(self: Store, key: str) -> bool:
        found = usual(self, key)
        place(self, key).unlink(missing_ok=True)
        return found

    monkeypatch.setattr(Store, "has", trimmed_behind)
    assert (store.get("a"), store.trouble) == (None, "")


def test_where_nobody_may_look_nothing_is_found(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(path: Path) -> bool:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "is_file", refused)
    assert (store.has("a"), store.get("a")) == (False, None)
    assert store.trouble == "permission denied"


def test_where_the_name_is_too_long_nothing_is_kept(tmp_path: Path) -> None:
    store = Store(tmp_path / ("a" * 300), MB)
    assert not store.has("a")
    store.put("a", ENTRY)
    assert store.get("a") is None
    assert store.trouble != ""


def test_an_entry_that_is_open_elsewhere_stays(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    store.put("a", ENTRY)

    def refused(*_: Path) -> Path:
        raise PermissionError(13, "is open")

    monkeypatch.setattr(Path, "replace", refused)
    store.put("a", Entry({}))
    assert (store.get("a"), store.trouble) == (ENTRY, "")
    store.put("b", ENTRY)
    assert store.trouble == "is open"
    assert store.folder is not None
    assert [path.name for path in store.folder.iterdir()] == ["a.entry"]


def test_what_was_used_longest_ago_goes_first(store: Store) -> None:
    store.most_bytes = 3 * MB
    for age, key in enumerate("dcba"):
        store.put(key, Entry({}, value=bytes(MB // 2)))
        os.utime(place(store, key), (1000 - age, 1000 - age))
    store.get("a")  # the oldest, but used now
    store.put("new", Entry({}, value=bytes(MB + MB // 4)))
    store.trim()
    assert [key for key in "abcd" if store.has(key)] == ["a", "c", "d"]
    assert sum(path.stat().st_size for path in place(store, "a").parent.iterdir()) <= store.most_bytes
    store.put("huge", Entry({}, value=bytes(4 * MB)))
    assert not store.has("huge")


def test_a_bound_that_was_lowered_is_kept_to(store: Store) -> None:
    store.put("a", ENTRY)
    none_more = Store(store.folder, 0)
    none_more.put("b", ENTRY)
    none_more.trim()
    assert not store.has("a")


def test_what_a_killed_process_left_goes_when_it_is_old(store: Store) -> None:
    store.put("a", ENTRY)
    old, young = (place(store, "a").with_name(f".{name}.partial") for name in ("old", "young"))
    for path in (old, young):
        path.write_bytes(b"half")
    os.utime(old, (time.time() - 7200, time.time() - 7200))
    store.trim()
    assert (old.exists(), young.exists(), store.has("a")) == (False, True, True)


def test_the_environment_says_where_and_how_much(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for off in ("", "off", " OFF "):
        monkeypatch.setenv("WRAPIT_CACHE", off)
        assert usual_store().folder is None
    monkeypatch.setenv("WRAPIT_CACHE", str(tmp_path))
    monkeypatch.setenv("WRAPIT_CACHE_MB", "5")
    assert (usual_store().folder, usual_store().most_bytes) == (tmp_path / "stages", 5 * MB)
    for wrong in ("much", "-1", "1.5", "²"):
        monkeypatch.setenv("WRAPIT_CACHE_MB", wrong)
        with pytest.raises(ConfigError, match="no whole number of MB"):
            usual_store()
    monkeypatch.delenv("WRAPIT_CACHE")
    monkeypatch.delenv("WRAPIT_CACHE_MB")
    usual = usual_store().folder
    assert usual is not None
    assert usual.is_absolute()
    assert "wrapit" in usual.parts


def test_a_user_without_a_home_keeps_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless(*_: object, **__: object) -> Path:
        raise RuntimeError("could not determine the home directory")

    monkeypatch.delenv("WRAPIT_CACHE", raising=False)
    monkeypatch.setattr("platformdirs.user_cache_path", homeless)
    assert (usual_store().folder, usual_store().trouble) == (None, "no home folder is known")
    monkeypatch.setenv("WRAPIT_CACHE", "~nobody-of-this-name/cache")
    with pytest.raises(
        ConfigError, match=r"WRAPIT_CACHE: .* is in no home that is known; write the whole path"
    ):
        usual_store()


def test_files_that_come_and_go_are_no_part_of_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "wrapit"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / ".#build.py").symlink_to("somebody@here.1234")  # as Emacs marks a file that it has open
    monkeypatch.setattr("wrapit.__file__", str(package / "__init__.py"))
    said = fingerprint.__wrapped__()
    assert said == fingerprint.__wrapped__()
    (package / "build.py").write_text("x = 1")
    assert said != fingerprint.__wrapped__()
