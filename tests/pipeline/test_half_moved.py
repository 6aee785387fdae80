"""A build that is killed as it moves its files into place is finished by the next one."""

from __future__ import annotations

import itertools
import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.pipeline.folders import held, listed, put
from wrapit.errors import ConfigError
from wrapit.pipeline.output.folder import prepare

OLD = {"a.step": b"one", "b.stl": b"one", "gone.svg": b"one"}
NEW = {"a.step": b"two", "b.stl": b"one", "c.svg": b"two"}
SWALLOWED = 99


def _killed_at_move(move: int, folder: Path, files: dict[str, bytes]) -> bool:
    """Puts files, in a process that is killed at its `move`-th change of the disk; False if there is none."""
    child = os.fork()
    if child == 0:
        left = itertools.count(move, -1)

        def deadly(change: Callable[..., Any]) -> Callable[..., Any]:
            def changed(*arguments: Any, **options: Any) -> Any:
                if next(left) <= 0:
                    os.kill(os.getpid(), signal.SIGKILL)
                return change(*arguments, **options)

            return changed

        for name in ("rename", "replace", "unlink", "rmdir", "mkdir"):
            setattr(os, name, deadly(getattr(os, name)))
            setattr(Path, name, deadly(getattr(Path, name)))
        try:
            put(folder, files)
        except BaseException:  # noqa: BLE001  the test must not go on in this process
            os._exit(SWALLOWED)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status) or os.WEXITSTATUS(status) == 0
    return os.WIFSIGNALED(status)


def _files(folder: Path) -> dict[str, bytes | str | None]:
    return {name: content for name, content in held(folder).items() if name != "report.json"}


def _moments(tmp_path: Path, arrange: Callable[[Path], None]) -> list[tuple[Path, dict[str, Any]]]:
    """One folder for each moment at which the build can be killed, and what it held then."""
    folders = []
    for move in itertools.count():
        folder = tmp_path / str(move) / "out"
        folder.parent.mkdir()
        arrange(folder)
        if not _killed_at_move(move, folder, NEW):
            assert _files(folder).items() >= NEW.items()
            break
        folders.append((folder, _files(folder)))
    assert len(folders) > 4
    return folders


def _no_trace(folder: Path) -> None:
    assert [path.name for path in folder.parent.iterdir()] in (["out"], [])
    assert not list(folder.glob(".out.*"))


def test_over_an_earlier_build(tmp_path: Path) -> None:
    for folder, then in _moments(tmp_path, lambda folder: put(folder, OLD)):
        assert all(content in (OLD.get(name), NEW.get(name)) for name, content in then.items())
        prepare(folder)
        assert _files(folder) in (OLD, NEW)
        assert then == OLD or _files(folder) == NEW
        assert {each["path"] for each in listed(folder)} == _files(folder).keys()
        _no_trace(folder)


def test_into_an_empty_folder(tmp_path: Path) -> None:
    for folder, then in _moments(tmp_path, lambda folder: folder.mkdir()):
        assert then.items() <= NEW.items()
        prepare(folder)
        assert _files(folder) in ({}, NEW)
        assert not then or _files(folder) == NEW
        put(folder, OLD)
        assert _files(folder) == OLD
        _no_trace(folder)


def test_where_there_was_no_folder(tmp_path: Path) -> None:
    for folder, _ in _moments(tmp_path, lambda folder: None):
        put(folder, OLD)
        assert _files(folder) == OLD
        _no_trace(folder)


@pytest.mark.parametrize("name", [*(OLD | NEW), "notes.txt", "report.json"])
def test_what_somebody_wrote_in_between_stays(tmp_path: Path, name: str) -> None:
    """Between the kill and the next build: it isn't overwritten, and the next build does or refuses."""
    for folder, _ in _moments(tmp_path, lambda folder: put(folder, OLD)):
        (folder / name).write_bytes(b"precious")
        if name == "report.json":
            with pytest.raises(ConfigError, match="didn't write"):
                put(folder, NEW)
        else:
            put(folder, NEW)
            assert {each.get("instead_of") or each["path"] for each in listed(folder)} == NEW.keys()
        assert (folder / name).read_bytes() == b"precious"
        _no_trace(folder)


def test_a_folder_that_became_somebody_elses_gets_nothing(tmp_path: Path) -> None:
    for folder, then in _moments(tmp_path, lambda folder: put(folder, OLD)):
        for name in (*then, "report.json"):
            (folder / name).unlink(missing_ok=True)
        (folder / "holiday.jpg").write_bytes(b"precious")
        with pytest.raises(ConfigError, match="didn't write"):
            put(folder, NEW)
        assert held(folder) == {"holiday.jpg": b"precious"}
        _no_trace(folder)


def test_a_killed_finish_is_finished(tmp_path: Path) -> None:
    """The build that finishes another one's work may be killed amid it too."""
    for folder, then in _moments(tmp_path, lambda folder: put(folder, OLD)):
        for move in range(12):
            _killed_at_move(move, folder, OLD)
        prepare(folder)
        assert _files(folder) in (OLD, NEW), then
        _no_trace(folder)
