"""An output folder is the user's: whatever lies there, only wrapit's own unchanged files are replaced."""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.pipeline.folders import held, listed, put
from wrapit.errors import ConfigError, ExportError
from wrapit.pipeline.output.folder import followed, prepare, put_in_place, staged
from wrapit.pipeline.output.ownership import FORMAT, REPORT, is_whole, own_report

NAMES = ("a.step", "b.stl", "c.svg", "plain", "a.new.step", "b.new.stl", "b.new-2.stl", ".hidden")
DATA = st.sampled_from((b"", b"one", b"two", b"\0\xff"))
FILES = st.dictionaries(st.sampled_from(NAMES[:4]), DATA, min_size=1)
EDIT = st.tuples(
    st.sampled_from(("write", "delete", "folder", "full folder", "link", "loop", "touch")),
    st.sampled_from(NAMES),
    DATA,
)
STEPS = st.lists(st.one_of(FILES, EDIT), min_size=2, max_size=10)


def _edit(folder: Path, how: str, name: str, data: bytes) -> None:
    """Somebody does something to a file of the folder, whatever it is now."""
    folder.mkdir(exist_ok=True)
    path = folder / name
    if how == "touch":
        if not path.is_symlink():
            path.touch()
        return
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)
    match how:
        case "write":
            path.write_bytes(data)
        case "folder" | "full folder":
            path.mkdir()
            if how == "full folder":
                (path / "within").write_bytes(data)
        case "link":
            path.symlink_to(folder.parent / "outside" / "precious")
        case "loop":
            path.symlink_to(name)


def _checked_build(folder: Path, files: dict[str, bytes]) -> None:
    """One build, and that it did to each entry what it may do."""
    before, ours = held(folder), own_report(folder)
    own = {REPORT} if ours else set()
    for artifact in (ours or {}).get("artifacts", ()):
        content = before.get(artifact["path"])
        if isinstance(content, bytes) and hashlib.sha256(content).hexdigest() == artifact["sha256"]:
            own.add(artifact["path"])
    if before and not ours:
        with pytest.raises(ConfigError, match="didn't write"):
            put(folder, files)
        assert held(folder) == before
        return
    put(folder, files)
    after = held(folder)
    foreign = {name: content for name, content in before.items() if name not in own}
    assert {name: after.get(name, "gone") for name in foreign} == foreign
    artifacts = listed(folder)
    assert {artifact["path"] for artifact in artifacts} == after.keys() - foreign.keys() - {REPORT}
    made = {artifact.get("instead_of") or artifact["path"]: after[artifact["path"]] for artifact in artifacts}
    assert made == files
    for artifact in artifacts:
        content = after[artifact["path"]]
        assert isinstance(content, bytes)
        assert (artifact["bytes"], artifact["sha256"]) == (len(content), hashlib.sha256(content).hexdigest())
        if artifact.get("instead_of"):
            assert artifact["instead_of"] in foreign, "renamed without need"


@settings(max_examples=150)
@given(STEPS)
def test_builds_and_edits_in_any_order_keep_what_is_not_wrapits(
    steps: list[dict[str, bytes] | tuple[str, str, bytes]],
) -> None:
    with tempfile.TemporaryDirectory() as place:
        folder, outside = Path(place) / "out", Path(place) / "outside"
        outside.mkdir()
        (outside / "precious").write_bytes(b"one")
        for step in steps:
            if isinstance(step, dict):
                _checked_build(folder, step)
            else:
                _edit(folder, *step)
        assert held(outside) == {"precious": b"one"}
        assert {path.name for path in Path(place).iterdir()} <= {"out", "outside"}


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)
NAMES_OF_OTHERS = st.sampled_from(
    ("../outside/precious", "/etc/hostname", "..", ".", "", "sub/file", "sub\\file", "a\0b", REPORT, "sub")
) | st.sampled_from(("x" * 300, "\ud800", "é" * 200))


@settings(max_examples=100)
@given(
    st.one_of(
        JUNK.map(json.dumps),
        JUNK.map(lambda junk: json.dumps({"format": "wrapit-report/2", "artifacts": junk})),
        st.sampled_from(("", "{", "[" * 5000, "hello", "9" * 5000, "\0")),
    )
)
def test_a_report_of_somebody_elses_makes_no_folder_wrapits(text: str) -> None:
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "out"
        folder.mkdir()
        (folder / REPORT).write_text(text, encoding="utf-8")
        before = held(folder)
        with pytest.raises(ConfigError, match="didn't write"):
            put(folder, {"a.step": b"one"})
        assert held(folder) == before


@settings(max_examples=150)
@given(st.one_of(JUNK, st.lists(st.fixed_dictionaries({"path": NAMES_OF_OTHERS | JUNK, "sha256": JUNK}))))
def test_whatever_a_report_lists_nothing_else_goes(artifacts: object) -> None:
    """Also with the true hashes: a name that leads elsewhere is no file of the folder."""
    precious = hashlib.sha256(b"one").hexdigest()
    for each in artifacts if isinstance(artifacts, list) else ():
        if isinstance(each, dict) and "sha256" in each:
            each["sha256"] = precious
    with tempfile.TemporaryDirectory() as place:
        folder, outside = Path(place) / "out", Path(place) / "outside"
        for each in (folder / "sub", outside):
            each.mkdir(parents=True)
        (outside / "precious").write_bytes(b"one")
        (folder / "sub" / "file").write_bytes(b"one")
        (folder / REPORT).write_text(json.dumps({"format": FORMAT, "artifacts": artifacts}))
        is_whole(folder, own_report(folder) or {})
        put(folder, {"a.step": b"one", "sub": b"two"})
        assert held(outside) == {"precious": b"one"}
        new = {"a.step": b"one", "sub.new": b"two", "sub": None, "sub/file": b"one"}
        assert {name: content for name, content in held(folder).items() if name != REPORT} == new


@settings(max_examples=50)
@given(JUNK | st.lists(st.fixed_dictionaries({"path": NAMES_OF_OTHERS, "sha256": JUNK}), min_size=1))
def test_a_folder_is_not_whole_by_a_report_that_lists_no_file(artifacts: object) -> None:
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "sub").mkdir()
        assert not is_whole(Path(place), {"format": FORMAT, "artifacts": artifacts})


def test_a_link_to_a_folder_is_followed_and_stays(tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to("true/folder")
    put(followed(link), {"a.step": b"one"})
    put(followed(link), {"b.stl": b"two"})
    assert link.is_symlink()
    assert held(tmp_path / "true" / "folder").keys() == {"b.stl", REPORT}
    assert {path.name for path in (tmp_path / "true").iterdir()} == {"folder"}


@pytest.mark.parametrize(
    "name", ["loop", "file", "file/below", "x" * 300, "x/" * 3000 + "x", "a\0b", "loop/a"]
)
def test_where_no_folder_can_be(tmp_path: Path, name: str) -> None:
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").write_bytes(b"one")
    before = held(tmp_path)
    with pytest.raises(ConfigError, match="-o") as refusal:
        followed(tmp_path / name)
    assert len(str(refusal.value)) < 300
    assert held(tmp_path) == before


@pytest.mark.parametrize("name", ["é" * 127, "x" * 255, "\udcff\udcfe", "%$#:*?[a](b)", "a\nb", "😀" * 63])
def test_any_name_will_do(tmp_path: Path, name: str) -> None:
    for data in (b"one", b"two"):
        put(tmp_path / name, {"a.step": data})
    assert held(tmp_path / name)["a.step"] == b"two"
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_folders_whose_long_names_begin_alike_are_told_apart(tmp_path: Path) -> None:
    """A build of the one, killed as it moved its files into place, isn't finished in the other."""
    one, other = tmp_path / ("x" * 200 + "1"), tmp_path / ("x" * 200 + "2")
    put(one, {"a.step": b"one"})
    put(other, {"a.step": b"two"})
    with staged(one) as partial:
        prefix = partial.name.removesuffix("partial")
        shutil.copytree(one, tmp_path / f"{prefix}ready")
    prepare(other)
    assert held(other)["a.step"] == b"two"
    prepare(one)
    assert sorted(path.name for path in tmp_path.iterdir()) == [one.name, other.name]


def test_a_file_that_appears_during_a_build_stays(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    put(folder, {"a.step": b"one"})
    before = held(folder)
    with staged(folder) as partial:
        for name in ("b.stl", "c.svg"):
            (partial / name).write_bytes(b"two")
        (partial / REPORT).write_text(json.dumps({"format": FORMAT, "artifacts": []}))
        (folder / "c.svg").write_bytes(b"precious")
        with pytest.raises(ExportError, match="move it away"):
            put_in_place(partial, folder)
    assert held(folder) == {**before, "c.svg": b"precious"}
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_folder_that_appears_during_a_build_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another build of the piece was faster, by less than it takes to look."""
    folder, looked = tmp_path / "out", Path.exists
    with staged(folder) as partial:
        (partial / "a.step").write_bytes(b"one")
        (partial / REPORT).write_text(json.dumps({"format": FORMAT, "artifacts": []}))
        put(folder, {"a.step": b"two"})
        monkeypatch.setattr(Path, "exists", lambda path, **how: path != folder and looked(path, **how))
        put_in_place(partial, folder)
    assert held(folder)["a.step"] == b"one"
