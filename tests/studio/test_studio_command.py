"""The real command: a page's changes reach the file and the build, an editor's reach the page."""

from __future__ import annotations

import http.client
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from tests.studio.running import CONFIG, ROOT, Studio, running, with_piece


def children_of(pid: int) -> set[int]:
    """All processes that descend from one (Linux)."""
    parents: dict[int, int] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue
        parents[int(stat.parent.name)] = int(text.rpartition(")")[2].split()[1])
    found, before = {pid}, set[int]()
    while found != before:
        before = set(found)
        found |= {child for child, parent in parents.items() if parent in found}
    return found - {pid}


def alive(pid: int) -> bool:
    try:
        return (
            ")" in (text := Path(f"/proc/{pid}/stat").read_text())
            and text.rpartition(")")[2].split()[0] != "Z"
        )
    except OSError:
        return False


def heard(studio: Studio, revisions: list[int], count: int) -> None:
    """Listens to the events until so many came, or the server ends them."""
    connection = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=60)
    connection.request("GET", "/events", headers=studio.cookie)
    answer = connection.getresponse()
    assert answer.headers["content-type"].startswith("text/event-stream")
    while len(revisions) < count:
        line = answer.readline()
        if not line:
            break
        if line.startswith(b"data: "):
            revisions.append(json.loads(line[6:])["revision"])
    connection.close()


def test_a_change_reaches_the_file_the_build_and_every_page(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        assert studio.line.startswith("studio: http://127.0.0.1:")
        first = studio.built()
        assert first["shown"]["report"]["drawing"]["size_mm"][0] == pytest.approx(60, abs=0.01)
        assert first["shown"]["drawing"]["format"] == "wrapit-drawing/1"
        [wire] = first["shown"]["wires"]
        assert wire["name"] == "wire-01"
        assert len(wire["points"]) > 20
        assert {segment for segment, _ in wire["segments"]} == {0, 1}
        assert first["findings"] is not None
        assert all(each["at"] is not None for each in first["findings"] if " mm" in each["where"])
        pages: list[list[int]] = [[], []]
        listeners = [threading.Thread(target=heard, args=(studio, page, 4)) for page in pages]
        for each in listeners:
            each.start()
        changes = {"set": {"size": "70 mm", "wire.gauge": "20 AWG"}, "constrain": [{"cut_at": 0}]}
        status, answer = studio.post("/change", changes)
        assert (status, answer["revision"] > first["revision"]) == (200, True)
        assert studio.config.read_text() == (
            "# ours\nname: leaf\ndrawing: leaf.svg  # by hand\nsize: 70 mm\nwire:\n  gauge: 20 AWG\n"
            "decomposition:\n  constraints: [{cut_at: 0}]\njigs: [pegs]\noutputs: [html]\n"
        )
        second = studio.built()
        for each in listeners:
            each.join(60)
        assert all(page == sorted(page) and page[-1] > first["revision"] for page in pages)
        report = json.loads((tmp_path / "build" / "leaf" / "report.json").read_text())
        assert report == second["shown"]["report"]
        assert max(report["drawing"]["size_mm"]) == pytest.approx(70, abs=0.01)
        assert second["shown"]["files"].keys() == first["shown"]["files"].keys()
        assert second["shown"]["files"] != first["shown"]["files"]
        assert second["constraints"][0]["text"] == "all wires end at junction 0"
        values = {each["key"]: each["value"] for each in second["controls"]}
        assert (values["size"], values["wire.gauge"], values["jigs"]) == ("70 mm", "20 AWG", ["pegs"])
        assert studio.post("/undo", {})[0] == 200
        assert studio.config.read_text() == CONFIG
        assert studio.state()["can_redo"]
        third = studio.built()
        assert third["shown"]["files"] == first["shown"]["files"]
        assert studio.post("/redo", {})[0] == 200
        assert studio.post("/redo", {})[0] == 409
        assert "cut_at" in studio.config.read_text()


def test_an_editor_s_changes_reach_the_page(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        first = studio.built()
        studio.config.write_text(CONFIG.replace("60 mm", "50 mm"))
        studio.until(lambda state: "50 mm" in state["text"])
        second = studio.built()
        assert max(second["shown"]["report"]["drawing"]["size_mm"]) == pytest.approx(50, abs=0.01)
        studio.config.write_text(CONFIG.replace("60 mm", "60 mn"))
        broken = studio.until(lambda state: state["problem"] is not None)
        assert broken["problem"]["where"] == "leaf.yaml:4:1 size"
        assert broken["shown"] == second["shown"]
        assert (broken["fresh"], broken["building"]) == (False, None)
        status, answer = studio.post("/change", {"set": {"pair": True}})
        assert (status, answer["error"]["where"]) == (422, "leaf.yaml:4:1 size")
        studio.config.write_text("size: [\n")
        studio.until(lambda state: state["text"].startswith("size: ["))
        assert studio.post("/change", {"set": {"pair": True}})[0] == 422
        assert studio.config.read_text() == "size: [\n"
        assert studio.post("/undo", {})[0] == 200
        assert "50 mm" in studio.config.read_text()
        assert studio.post("/undo", {})[0] == 200
        assert studio.config.read_text() == CONFIG
        assert studio.built()["shown"]["files"] == first["shown"]["files"]
        picture = tmp_path / "leaf.svg"
        picture.write_text(picture.read_text().replace("45 20 L 60 20", "45 20 L 63 25"))
        changed = studio.until(lambda s: s["fresh"] and s["shown"]["files"] != first["shown"]["files"])
        assert changed["shown"]["drawing"] != first["shown"]["drawing"]
        picture.unlink()
        gone = studio.until(lambda state: state["problem"] is not None)
        assert gone["problem"]["problem"] == "no such drawing"
        assert gone["shown"]["report"] == changed["shown"]["report"]


def test_a_text_is_taken_only_from_one_who_saw_the_last(tmp_path: Path) -> None:
    folder = with_piece(tmp_path, "\ufeff" + CONFIG.replace("\n", "\r\n"))
    os.chmod(folder / "leaf.yaml", 0o640)  # noqa: PTH101
    (folder / "real.yaml").write_bytes((folder / "leaf.yaml").read_bytes())
    with running(folder, "leaf.yaml") as studio:
        state = studio.state()
        text = state["text"].replace("\r\n", "\n").replace("60 mm", "65 mm")
        assert studio.post("/text", {"text": text, "base": "0" * 64})[0] == 409
        assert studio.post("/text", {"text": text + "sise: 3\n", "base": state["text_sha256"]})[0] == 422
        assert studio.config.read_bytes().decode() == "\ufeff" + CONFIG.replace("\n", "\r\n")
        assert studio.post("/text", {"text": text, "base": state["text_sha256"]})[0] == 200
        expected = "\ufeff" + CONFIG.replace("60 mm", "65 mm").replace("\n", "\r\n")
        assert studio.config.read_bytes().decode() == expected
        assert studio.config.stat().st_mode & 0o777 == 0o640
        assert studio.post("/text", {"text": text, "base": state["text_sha256"]})[0] == 409


def test_a_linked_config_stays_a_link(tmp_path: Path) -> None:
    folder = with_piece(tmp_path)
    (folder / "real").mkdir()
    (folder / "leaf.yaml").rename(folder / "real" / "ours.yaml")
    (folder / "leaf.yaml").symlink_to(Path("real") / "ours.yaml")
    with running(folder, "leaf.yaml") as studio:
        assert studio.post("/change", {"set": {"size": "70 mm"}})[0] == 200
        assert studio.config.is_symlink()
        assert "70 mm" in (folder / "real" / "ours.yaml").read_text()


@pytest.mark.parametrize("change", [{"size": "75 mm"}, {"bail": True}, {"guide.margin": "60 mm"}])
def test_alternatives_come_and_go_with_what_they_are_of(tmp_path: Path, change: dict[str, Any]) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.built()
        status, _ = studio.post("/alternatives", {"count": 2})
        assert status == 202
        found = studio.until(lambda state: isinstance(state["alternatives"], list))["alternatives"]
        assert [each["number"] for each in found] == [1, 2]
        assert found[0]["total"] <= found[1]["total"]
        assert all(len(wire["points"]) > 1 for each in found for wire in each["drawn"])
        studio.post("/change", {"set": {"guide.units": "in"}})
        assert studio.state()["alternatives"] == found
        studio.post("/change", {"set": change})
        assert studio.state()["alternatives"] is None


@pytest.mark.parametrize("change", [{"size": "75 mm"}, {"decomposition.weights.doubling": 0.5}])
def test_what_fewer_wires_cost_stays_while_they_are_chosen(tmp_path: Path, change: dict[str, Any]) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.built()
        assert studio.state()["fewer_wires"] is None
        assert studio.post("/fewer-wires", {})[0] == 202
        found = studio.until(lambda state: isinstance(state["fewer_wires"], list))["fewer_wires"]
        assert [(each["max_wires"], each["wires"], each["doubled_mm"]) for each in found] == [(None, 1, 0)]
        chosen = {"decomposition.max_wires": 1, "decomposition.doubling": True, "decomposition.choice": 1}
        assert studio.post("/change", {"set": chosen})[0] == 200
        assert studio.state()["fewer_wires"] == found
        assert studio.post("/change", {"set": change})[0] == 200
        assert studio.state()["fewer_wires"] is None


def test_changes_amid_a_build_are_built_in_the_end(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        for size in (51, 52, 53, 54):
            assert studio.post("/change", {"set": {"size": f"{size} mm"}})[0] == 200
            time.sleep(0.4)
        state = studio.built()
        assert max(state["shown"]["report"]["drawing"]["size_mm"]) == pytest.approx(54, abs=0.01)
        assert [path.name for path in (tmp_path / "build").iterdir() if path.name != "leaf"] == []


def test_a_folder_of_somebody_else_is_left_alone(tmp_path: Path) -> None:
    folder = with_piece(tmp_path)
    (folder / "mine").mkdir()
    (folder / "mine" / "report.json").write_text("{}")
    with running(folder, "leaf.yaml", "-o", "mine") as studio:
        state = studio.until(lambda state: state["problem"] is not None)
        assert "mine" in state["problem"]["where"]
        assert studio.ask("/file/report.json")[0] == 404
    assert (folder / "mine" / "report.json").read_text() == "{}"


def test_a_drawing_gets_a_config_beside_it(tmp_path: Path) -> None:
    folder = with_piece(tmp_path)
    (folder / "leaf.yaml").unlink()
    with running(folder, "leaf.svg") as studio:
        assert "drawing: leaf.svg" in studio.state()["text"]
        assert (folder / "leaf.yaml").read_text().startswith("# ")
    (folder / "leaf.yaml").write_text(CONFIG)
    with running(folder, "leaf.svg") as studio:
        assert studio.state()["text"] == CONFIG


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize(("signum", "when"), [(signal.SIGTERM, "built"), (signal.SIGINT, "building")])
def test_a_signal_ends_it_and_all_that_it_started(tmp_path: Path, signum: int, when: str) -> None:
    folder = with_piece(tmp_path, CONFIG.replace("[html]", "[html, step]"))  # with the kernel's process
    with running(folder, "leaf.yaml") as studio:
        page = threading.Thread(target=heard, args=(studio, [], 1_000))
        page.start()
        if when == "built":
            studio.built()
        else:
            studio.until(lambda state: state["building"] and state["building"]["done"])
        started = children_of(studio.process.pid)
        assert started
        assert studio.stop(signum) == (0, "")
        end = time.monotonic() + 10
        while any(map(alive, started)) and time.monotonic() < end:
            time.sleep(0.05)
        assert not [pid for pid in started if alive(pid)]
        page.join(10)
        assert not page.is_alive()
    if when == "building":
        assert not [*(folder / "build").glob("*.partial")]


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_a_killed_server_leaves_no_process(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        studio.built()
        started = children_of(studio.process.pid)
        studio.process.kill()
        studio.process.wait()
        end = time.monotonic() + 10
        while any(map(alive, started)) and time.monotonic() < end:
            time.sleep(0.05)
        assert not [pid for pid in started if alive(pid)]


def test_a_port_that_is_taken_is_said(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        second = subprocess.run(
            [
                sys.executable,
                "-m",
                "wrapit",
                "studio",
                "leaf.yaml",
                "--port",
                str(studio.port),
                "--no-browser",
            ],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
    assert second.returncode == 2
    assert second.stderr.count("\n") == 1
    assert f"port {studio.port} can't be used" in second.stderr


def test_the_server_loads_nothing_heavy() -> None:
    heavy = "{'numpy', 'scipy', 'shapely', 'OCP', 'skimage', 'PIL'}"
    code = f"import sys, wrapit.cli.main, wrapit.studio.server; print({heavy} & set(sys.modules))"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    ran = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert ran.stdout == "set()\n"
