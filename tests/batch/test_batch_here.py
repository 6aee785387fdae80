"""`wrapit batch` on this machine: a bad piece fails alone, kills lose nothing, it goes on where it was."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path
from typing import Any

import pytest

from tests.batch.catalogues import PATIENCE_S, awaited, builds, ledger, ring, run, started, statuses
from tests.pipeline.folders import held
from wrapit.pipeline.output.ownership import is_whole, own_report

needs_proc = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc to see processes")


def is_built(folder: Path) -> bool:
    report = own_report(folder)
    return report is not None and is_whole(folder, report)


def test_bad_ones_among_good_ones_fail_alone(tmp_path: Path) -> None:
    good = [ring(tmp_path, "one"), ring(tmp_path, "zwei ü")]
    blank, typo = ring(tmp_path, "blank", drawing="blank.svg"), ring(tmp_path, "typo", siez="3 mm")
    (tmp_path / "blank.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"/>')
    arguments = [good[0], blank, typo, good[1], "--price", "copper=10 EUR"]
    code, said, complaint = run(tmp_path, *arguments)
    assert code == 1
    assert statuses(tmp_path) == {"one": "ok", "blank": "failed", "typo": "failed", "zwei ü": "ok"}
    one, blank_entry, typo_entry, _ = ledger(tmp_path)["pieces"]
    assert blank_entry["exit_code"] == 3
    assert typo_entry["exit_code"] == 2
    assert "siez" in typo_entry["error"]["where"]
    report = json.loads((tmp_path / "out" / one["report"]).read_text())
    assert one["wires"] == len(report["wires"])
    assert one["mass_g"] == pytest.approx(sum(row["mass_g"] for row in report["guide"]["materials"]))
    assert one["cost"] == pytest.approx(one["mass_g"] / 100, abs=0.011)
    assert one["difficulty"] == report["guide"]["difficulty"]
    assert ledger(tmp_path)["totals"]["ok"] == 2
    assert not (tmp_path / "out" / "typo").exists()
    for entry in (blank_entry, typo_entry):
        assert entry["error"]["problem"] in said
        assert entry["error"]["problem"] in complaint
    assert "out/index.html" in said
    assert len(complaint.splitlines()) == 4

    before = held(tmp_path / "out")
    code, said, _ = run(tmp_path, *arguments, "--resume", "--json", "--jobs", "1")
    document: dict[str, Any] = json.loads(said)
    assert code == 1
    assert held(tmp_path / "out") == before
    assert {"artifacts", *document} - {"timings_s"} == ledger(tmp_path).keys()
    assert document["timings_s"].keys() == {"blank"}  # the good ones weren't even started


def test_a_pair_counts_twice_and_without_a_guide_the_wires_count(tmp_path: Path) -> None:
    pair, plain = ring(tmp_path, "pair", pair=True), ring(tmp_path, "plain", outputs=["svg"])
    code, _, _ = run(tmp_path, pair, plain)
    assert code == 0
    two, one = ledger(tmp_path)["pieces"]
    assert two["wires"] == 2 * one["wires"]
    assert two["cut_length_mm"] == pytest.approx(2 * one["cut_length_mm"])
    frame = [row for row in two["metal"] if row["use"] == "frame"]
    assert [row["length_mm"] for row in frame] == pytest.approx(
        [2 * row["length_mm"] for row in one["metal"]]
    )
    assert [row["mass_g"] for row in frame] == pytest.approx(
        [2 * row["mass_g"] for row in one["metal"]], abs=1e-3
    )
    assert one["difficulty"] is None
    assert "guide" not in one["files"]


def test_usage_is_refused_before_anything_starts(tmp_path: Path) -> None:
    one = ring(tmp_path, "one")
    other = ring(tmp_path / "b", "one")
    for arguments, words in (
        ([one, other], "both called 'one'"),
        (["none*.yaml"], "no config is called so"),
        ([one, "--jobs", "0"], "--jobs"),
        ([one, "--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"], "--jobs"),
        ([one, "--price", "unobtainium=3"], "no such metal"),
        ([], "config"),
    ):
        code, said, complaint = run(tmp_path, *arguments, "--json")
        assert code == 2, arguments
        assert words in complaint.lower()
        assert json.loads(said)["error"]["exit_code"] == 2
        assert len(complaint.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_a_foreign_folder_of_a_piece_fails_that_piece_alone(tmp_path: Path) -> None:
    (tmp_path / "out" / "mine").mkdir(parents=True)
    (tmp_path / "out" / "mine" / "notes.txt").write_text("mine")
    code, _, complaint = run(tmp_path, ring(tmp_path, "mine"), ring(tmp_path, "other"))
    assert code == 1
    assert statuses(tmp_path) == {"mine": "failed", "other": "ok"}
    assert "wrapit didn't write" in complaint
    assert held(tmp_path / "out" / "mine") == {"notes.txt": b"mine"}


@needs_proc
def test_a_build_that_is_killed_is_tried_again(tmp_path: Path) -> None:
    """With the kernel, so that there is a middle to kill it in."""
    long = ring(tmp_path, "long", jigs=["printed"], outputs=["stl", "html"])
    batch = started(tmp_path, long, ring(tmp_path, "short"), "--jobs", "2")
    awaited(lambda: list((tmp_path / "out").glob(".long.*.partial")), "the build under way")
    (victim,) = builds(batch.pid, "long")
    os.kill(victim, signal.SIGKILL)
    awaited(lambda: [pid for pid in builds(batch.pid, "long") if pid != victim], "the second try")
    said, complaint = batch.communicate(timeout=PATIENCE_S)
    assert batch.returncode == 0, complaint
    assert statuses(tmp_path) == {"long": "ok", "short": "ok"}
    assert is_built(tmp_path / "out" / "long")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "batch.json",
        "index.html",
        "long",
        "short",
    ]
    assert "2 pieces, 2 ok" in said


@needs_proc
@pytest.mark.parametrize(("signum", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_asked_to_end_it_stops_all_builds(tmp_path: Path, signum: int, code: int) -> None:
    configs = [ring(tmp_path, f"piece{number}") for number in range(4)]
    batch = started(tmp_path, *configs, "--jobs", "2")
    awaited(lambda: len(builds(batch.pid, "piece0") + builds(batch.pid, "piece1")) == 2, "two builds")
    running = [*builds(batch.pid, "piece0"), *builds(batch.pid, "piece1")]
    batch.send_signal(signum)
    _, complaint = batch.communicate(timeout=30)
    assert batch.returncode == code
    assert "interrupted" in complaint
    assert not any(Path(f"/proc/{pid}").exists() for pid in running)
    assert set(statuses(tmp_path).values()) <= {"pending", "ok"}


@needs_proc
def test_killed_it_goes_on_where_it_was(tmp_path: Path) -> None:
    configs = [ring(tmp_path, f"piece{number}") for number in range(3)]
    batch = started(tmp_path, *configs, "--jobs", "1")
    awaited((tmp_path / "out" / "piece1" / "report.json").exists, "the second piece")
    batch.kill()
    batch.communicate(timeout=30)
    awaited(lambda: not [pid for n in range(3) for pid in builds(None, f"piece{n}")], "the last build's end")
    done = {config.stem for config in configs if is_built(tmp_path / "out" / config.stem)}
    assert {"piece0", "piece1"} <= done
    code, said, complaint = run(tmp_path, *configs, "--resume", "--json")
    assert code == 0
    assert set(statuses(tmp_path).values()) == {"ok"}
    assert json.loads(said)["timings_s"].keys() == {config.stem for config in configs} - done
    assert complaint.count("up to date") == len(done)
    assert [path.name for path in (tmp_path / "out").iterdir() if path.name.startswith(".")] == []
