"""What goes wrong around the studio: clients that leave, processes that die, files that can't be written."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time
import webbrowser
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.studio.running import CONFIG, PICTURE, ROOT, Studio, running, with_piece
from tests.studio.test_studio_command import children_of
from wrapit.studio import server
from wrapit.studio.session import Session

SIZE = {"set": {"size": "70 mm"}}


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    folder = tmp_path / "ä 'b' \"c\" %41"
    folder.mkdir()
    with running(with_piece(folder), "leaf.yaml") as studio:
        yield studio


def begun(studio: Studio, head: str, more: str = "") -> socket.socket:
    """A request that is sent as far as it is given."""
    client = socket.create_connection(("127.0.0.1", studio.port))
    [(cookie, token)] = studio.cookie.items()
    known = f"Host: 127.0.0.1:{studio.port}\r\nOrigin: {studio.origin}\r\n{cookie}: {token}\r\n"
    client.sendall(f"{head} HTTP/1.1\r\n{known}Content-Type: application/json\r\n{more}".encode())
    return client


def half(studio: Studio) -> socket.socket:
    return begun(studio, "POST /change", 'Content-Length: 100\r\n\r\n{"set"')


def test_clients_that_leave_or_dawdle_are_no_word_worth(studio: Studio) -> None:
    studio.built()
    for _ in range(3):
        half(studio).close()
    for _ in range(30):
        begun(studio, "GET /events", "\r\n").close()
    tabs = [begun(studio, "GET /events", "\r\n") for _ in range(30)]
    assert studio.post("/change", SIZE)[0] == 200
    for tab in tabs:
        tab.settimeout(30)
        while b'{"revision"' not in tab.recv(1000):
            pass
    dawdling = half(studio)
    assert studio.stop() == (0, "")
    for each in (*tabs, dawdling):
        each.close()


@pytest.mark.parametrize(
    "text",
    [
        "decomposition: {weights: {smoothness: .nan}}\n",
        "jigs:\noutputs:\n",
        "jigs: 3\nwire: [1]\n",
        "decomposition: {constraints: [null, .inf]}\n",
        "bail: {at: [[.inf]]}\n",
    ],
)
def test_a_text_that_says_nonsense_is_shown_as_it_is(studio: Studio, text: str) -> None:
    before = studio.built()
    studio.config.write_text(f"drawing: leaf.svg\n{text}", encoding="utf-8")
    state = studio.until(lambda state: text in state["text"])
    assert state["problem"]["where"].startswith("leaf.yaml:")
    assert (state["again"], state["shown"]) == (False, before["shown"])
    assert studio.post("/change", SIZE)[0] == 422
    assert studio.post("/change", {"release": [0]})[0] == 422


def test_a_config_that_nobody_may_write_stays_as_it_is(studio: Studio) -> None:
    studio.config.chmod(0o444)
    status, answer = studio.post("/change", SIZE)
    assert (status, answer["error"]["problem"]) == (422, "can't be written (it is read-only)")
    assert studio.config.read_text("utf-8") == CONFIG
    studio.config.chmod(0o644)
    assert studio.post("/change", SIZE)[0] == 200


def test_a_config_that_is_gone_comes_back(studio: Studio) -> None:
    assert studio.post("/change", SIZE)[0] == 200
    studio.config.unlink()
    state = studio.until(lambda state: state["problem"] is not None)
    assert (state["problem"]["problem"], state["can_undo"]) == ("the config is gone or empty", True)
    assert studio.post("/change", SIZE)[0] == 422
    assert studio.post("/undo", {})[0] == 200
    assert studio.config.read_text("utf-8") == CONFIG.replace("60 mm", "70 mm")
    assert studio.post("/undo", {})[0] == 200
    assert studio.config.read_text("utf-8") == CONFIG


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize("asked", ["a button", "an editor", "a change"])
def test_a_build_that_was_killed_is_said_and_begun_again(tmp_path: Path, asked: str) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.until(lambda state: state["building"] and state["building"]["done"])
        for pid in children_of(studio.process.pid):
            if "multiprocessing.spawn" in Path(f"/proc/{pid}/cmdline").read_text():
                os.kill(pid, signal.SIGKILL)
        state = studio.until(lambda state: state["problem"] is not None)
        assert (state["problem"]["code"], state["again"]) == ("stopped", True)
        if asked == "a button":
            assert studio.post("/again", {})[0] == 200
        elif asked == "an editor":
            studio.config.write_text(CONFIG, encoding="utf-8")
        else:
            assert studio.post("/change", SIZE)[0] == 200
        assert studio.built()["problem"] is None
        assert studio.stop() == (0, "")


def test_a_folder_that_was_cleared_is_built_into_when_asked(tmp_path: Path) -> None:
    folder = with_piece(tmp_path)
    (folder / "mine").mkdir()
    (folder / "mine" / "notes.txt").write_text("mine")
    with running(folder, "leaf.yaml", "-o", "mine") as studio:
        assert studio.until(lambda state: state["problem"] is not None)["again"]
        (folder / "mine" / "notes.txt").unlink()
        assert studio.post("/again", {})[0] == 200
        assert "report.json" in studio.built()["shown"]["files"]


def test_an_alternative_that_there_isn_t_is_told_with_a_button(tmp_path: Path) -> None:
    with running(with_piece(tmp_path, f"{CONFIG}decomposition: {{choice: 9}}\n"), "leaf.yaml") as studio:
        problem = studio.until(lambda state: state["problem"] is not None)["problem"]
        assert problem["where"] == "decomposition.choice"
        assert problem["fixes"]
        for fix in problem["fixes"]:
            assert studio.post("/change", fix["change"])[0] == 200
            assert studio.built()["problem"] is None
            assert studio.post("/undo", {})[0] == 200


def test_two_studios_of_one_config_agree(tmp_path: Path) -> None:
    folder = with_piece(tmp_path)
    with running(folder, "leaf.yaml") as one, running(folder, "leaf.yaml") as other:
        assert one.post("/change", SIZE)[0] == 200
        other.until(lambda state: "70 mm" in state["text"])
        assert other.post("/change", {"set": {"pair": True}})[0] == 200
        states = [each.until(lambda s: s["fresh"] and "pair" in s["text"]) for each in (one, other)]
        assert states[0]["shown"]["files"] == states[1]["shown"]["files"]


def test_a_name_that_changes_takes_the_build_along(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.built()
        studio.config.write_text(CONFIG.replace("name: leaf", "name: frond"), encoding="utf-8")
        studio.until(lambda state: state["fresh"] and state["name"] == "frond")
        report = json.loads((tmp_path / "build" / "frond" / "report.json").read_text())
        assert json.loads(studio.ask("/file/report.json")[2]) == report
        assert (tmp_path / "build" / "leaf" / "report.json").is_file()


def fails_in_its_own_words(_: object) -> None:
    """An order amid which a signal comes while a library runs that makes another error of all errors."""
    try:
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(60)
    except SystemExit:
        raise ValueError("a library's own words") from None


@pytest.mark.skipif(sys.platform == "win32", reason="there a process is ended without a word")
def test_a_process_that_is_to_leave_says_nothing_of_it() -> None:
    code = (
        "import signal, types; from wrapit.studio import bench; from tests.studio import test_mishaps as t;"
        "signal.signal(signal.SIGTERM, bench._leave);"
        "bench._outcome(t.fails_in_its_own_words, types.SimpleNamespace(send=None), ())"
    )
    ran = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (128 + signal.SIGTERM, "")


@pytest.mark.parametrize(
    ("first", "chosen", "opened"),
    [
        (webbrowser.BackgroundBrowser("firefox"), "", True),
        (webbrowser.GenericBrowser("lynx"), "", False),
        (webbrowser.GenericBrowser("lynx"), "lynx", True),
        (None, "", False),
    ],
)
def test_a_browser_is_opened_that_leaves_the_terminal_alone(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    first: webbrowser.BaseBrowser | None,
    chosen: str,
    opened: bool,
) -> None:
    def get() -> webbrowser.BaseBrowser:
        if first is None:
            raise webbrowser.Error("could not locate runnable browser")
        return first

    links: list[str] = []
    monkeypatch.setenv("BROWSER", chosen)
    monkeypatch.setattr(webbrowser, "get", get)
    monkeypatch.setattr(webbrowser, "open", lambda link: links.append(link) is None)
    server._open("http://127.0.0.1:1/")
    assert bool(links) == opened
    assert ("open the link yourself" in capsys.readouterr().err) == (not opened)


def said(folder: Path, *arguments: str) -> tuple[int, str]:
    """Exit code and stderr of a studio that doesn't begin."""
    ran = subprocess.run(
        [sys.executable, "-m", "wrapit", "studio", *arguments, "--no-browser"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ran.stdout == ""
    return ran.returncode, ran.stderr


@pytest.mark.parametrize(
    ("piece", "words"),
    [
        (":pendant", ("preset", "init DRAWING --preset pendant")),
        (":pendent", ("no such preset", ":pendant")),
        ("nothing.yaml", ("no such config",)),
        ("nothing.png", ("no such",)),
        ("leaf.svg", ("another", "other.svg", "init leaf.svg -o leaf-2.yaml")),
        (".", ("no such config",)),
    ],
)
def test_what_is_no_piece_is_told_in_a_line(tmp_path: Path, piece: str, words: tuple[str, ...]) -> None:
    (with_piece(tmp_path) / "other.svg").write_text(PICTURE)
    (tmp_path / "leaf.yaml").write_text(CONFIG.replace("leaf.svg", "other.svg"))
    code, told = said(tmp_path, piece)
    assert (code, told.count("\n")) == (3 if "no such drawing" in told else 2, 1), told
    assert all(word in told for word in words), told


def test_many_changes_end_with_the_last(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.built()
        for size in range(50, 70):
            assert studio.post("/change", {"set": {"size": f"{size} mm"}})[0] == 200
            time.sleep(0.05)
        report = studio.built()["shown"]["report"]
        assert max(report["drawing"]["size_mm"]) == pytest.approx(69, abs=0.01)
        assert [path.name for path in (tmp_path / "build").iterdir()] == ["leaf"]


def test_a_text_that_is_written_while_another_is_judged_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The watch compares signatures: that of a text nobody has read yet mustn't pass for the known one."""
    session = Session(with_piece(tmp_path) / "leaf.yaml", None)
    monkeypatch.setattr(session, "_rebuild", lambda: None)
    first, second = (CONFIG.replace("60 mm", size).encode() for size in ("61 mm", "62 mm"))
    session.path.write_bytes(second)
    session._notice(first)
    assert session._signatures() != session._files
    session._notice(second)
    assert session._signatures() == session._files
