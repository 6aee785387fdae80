"""The command line as a shell sees it: exit codes, one line per error, earlier output untouched."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.conftest import CONFIGS

WRAPIT = [sys.executable, "-m", "wrapit"]


def wrapit(*arguments: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [*WRAPIT, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False, cwd=cwd)


@pytest.fixture
def bee(tmp_path: Path) -> Path:
    """A config of a piece whose drawing is a copy of the treble clef, the quickest of our bitmaps."""
    shutil.copy(CONFIGS / "treble-clef.png", tmp_path / "bee.png")
    config = tmp_path / "bee.yaml"
    config.write_text("drawing: bee.png\nsize: 40 mm\n")
    return config


def refused(run: subprocess.CompletedProcess[str], code: int, *words: str) -> None:
    assert run.returncode == code, run.stderr
    assert run.stdout == ""
    lines = run.stderr.strip().splitlines()
    assert len(lines) == 1, run.stderr
    assert lines[0].startswith("error: ")
    for word in words:
        assert word in lines[0]


def test_version_and_help() -> None:
    from wrapit import __version__

    assert wrapit("--version").stdout.strip() == f"wrapit {__version__}"
    text = wrapit("--help").stdout
    for command in ("build", "init", "check", "coupon", "schema", "materials"):
        assert command in text
    assert "Exit codes" in text
    assert wrapit("-h").stdout == text
    assert wrapit("build", "-h").stdout == wrapit("build", "--help").stdout


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    ("arguments", "code"), [("build bee.yaml --until drawing", 0), ("build none.yaml", 2)]
)
def test_closed_streams_change_nothing(bee: Path, arguments: str, code: int, closed: str) -> None:
    command = f"{shlex.join(WRAPIT)} {arguments} {closed}"
    environment = {**os.environ, "PYTHONPATH": str(CONFIGS.parent)}
    run = subprocess.run(
        ["sh", "-c", command], capture_output=True, text=True, cwd=bee.parent, env=environment, check=False
    )
    assert run.returncode == code, run.stderr
    assert "2>" in closed or len(run.stderr.splitlines()) == (code != 0)
    assert (bee.parent / "build" / "bee" / "report.json").exists() == (code == 0)


def test_the_narrowest_margin_makes_sound_jigs(bee: Path) -> None:
    least = ("--until", "jig", "--set", "jig.margin=0.1 mm", "--set", "outputs=[stl]")
    run = wrapit("build", bee, "-o", bee.parent / "out", *least)
    assert run.returncode == 0, run.stderr
    refused(wrapit("build", bee, "--set", "jig.margin=0 mm"), 2, "0.1 mm")


def test_coupons_without_a_config_heed_set(tmp_path: Path) -> None:
    refused(wrapit("coupon", "-o", tmp_path / "made", "--set", "wire.gage=1 mm"), 2, "unknown key", "'gauge'")
    for gauge in ("0.5 mm", "2 mm"):
        assert wrapit("coupon", "-o", tmp_path / gauge, "--set", f"wire.gauge={gauge}").returncode == 0
    thin, thick = ((tmp_path / gauge / "coupon-kerf.dxf").read_bytes() for gauge in ("0.5 mm", "2 mm"))
    assert thin != thick


def test_version_loads_nothing_heavy() -> None:
    code = "import sys, wrapit.cli; print(*sorted(m for m in sys.modules if '.' not in m))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {"numpy", "scipy", "pydantic", "OCP", "build123d", "cadquery", "skimage", "PIL"}
    assert not heavy & set(run.stdout.split())


def test_schema_is_json() -> None:
    assert "drawing" in json.loads(wrapit("schema").stdout)["properties"]


def test_materials_names_gauges_and_metals() -> None:
    text = wrapit("materials").stdout
    assert "copper" in text
    assert "18 AWG" in text


def test_unknown_command_and_option() -> None:
    assert wrapit("bild").returncode == 2
    assert wrapit("build", "--frobnicate").returncode == 2
    assert wrapit("build", CONFIGS / "butterfly.yaml", "--until", "lunch").returncode == 2


def test_bad_config_is_exit_2(bee: Path) -> None:
    refused(wrapit("build", bee.with_name("none.yaml")), 2, "none.yaml", "no such config")
    refused(wrapit("build", bee, "--set", "size=40"), 2, "--set size=40", "no unit", "'40 mm'")
    bee.write_text("drawing: bee.png\nsise: 40 mm\n")
    refused(wrapit("build", bee), 2, "bee.yaml:2:1 sise", "unknown key", "'size'")


def test_a_bitmap_needs_a_size(bee: Path) -> None:
    bee.write_text("drawing: bee.png\n")
    refused(wrapit("build", bee), 2, "size", "40 mm")


def _blank(path: Path) -> None:
    Image.new("L", (300, 200), 255).save(path)


def _broken(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:2000])


def _text(path: Path) -> None:
    path.write_text("this is no picture")


def _noise(path: Path) -> None:
    Image.fromarray(np.random.default_rng(1).integers(0, 255, (200, 300), dtype=np.uint8)).save(path)


def _gone(path: Path) -> None:
    path.unlink()


@pytest.mark.parametrize("spoil", [_blank, _broken, _text, _noise, _gone])
def test_bad_drawing_is_exit_3_and_leaves_nothing(bee: Path, spoil) -> None:  # type: ignore[no-untyped-def]
    spoil(bee.with_name("bee.png"))
    out = bee.parent / "out"
    refused(wrapit("build", bee, "-o", out), 3, "bee.png")
    assert sorted(path.name for path in bee.parent.iterdir()) in (["bee.png", "bee.yaml"], ["bee.yaml"])


def test_failed_build_keeps_the_earlier_one(bee: Path) -> None:
    out = bee.parent / "out"
    assert wrapit("build", bee, "-o", out, "--until", "wires").returncode == 0
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    assert {"report.json", "drawing.json", "decomposition.json", "config.lock.yaml"} <= set(before)
    _blank(bee.with_name("bee.png"))
    refused(wrapit("build", bee, "-o", out, "--until", "wires"), 3)
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert sorted(path.name for path in bee.parent.iterdir()) == ["bee.png", "bee.yaml", "out"]


def test_json_is_one_document_with_timings(bee: Path) -> None:
    run = wrapit("build", bee, "-o", bee.parent / "out", "--until", "wires", "--json")
    report = json.loads(run.stdout)
    assert report["format"] == "wrapit-report/1"
    assert set(report["timings_s"]) == {"drawing", "decomposition", "wires", "cached"}
    assert "timings_s" not in json.loads((bee.parent / "out" / "report.json").read_text())


def test_unchanged_input_is_not_built_again(bee: Path) -> None:
    out = bee.parent / "out"
    arguments = ("build", bee, "-o", out, "--until", "wires")
    assert "written" in wrapit(*arguments).stdout
    assert "up to date" in wrapit(*arguments).stdout
    assert "written" in wrapit(*arguments, "--force").stdout
    (out / "drawing.json").write_text("{}")
    assert "written" in wrapit(*arguments).stdout
    assert "written" in wrapit(*arguments, "--set", "size=41 mm").stdout


def test_a_foreign_folder_is_never_replaced(bee: Path) -> None:
    precious = bee.parent / "photos"
    precious.mkdir()
    (precious / "holiday.jpg").write_text("irreplaceable")
    refused(wrapit("build", bee, "-o", precious, "--until", "drawing", "--force"), 2, "didn't write")
    assert (precious / "holiday.jpg").read_text() == "irreplaceable"


def test_interrupted_build_leaves_nothing(bee: Path) -> None:
    out = bee.parent / "out"
    process = subprocess.Popen(
        [*WRAPIT, "build", str(bee), "-o", str(out)], stderr=subprocess.PIPE, start_new_session=True
    )
    deadline = time.monotonic() + 60
    while not list(bee.parent.glob(".out.*")) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert list(bee.parent.glob(".out.*")), "the build never started"
    os.kill(process.pid, signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode != 0
    assert sorted(path.name for path in bee.parent.iterdir()) == ["bee.png", "bee.yaml"]


def test_init_writes_a_config_that_builds(bee: Path) -> None:
    config = bee.parent / "pieces" / "proposed.yaml"
    config.parent.mkdir()
    assert wrapit("init", bee.with_name("bee.png"), "-o", config).returncode == 0
    assert "drawing: ../bee.png" in config.read_text()
    refused(wrapit("init", bee.with_name("bee.png"), "-o", config), 2, "exists already")
    assert wrapit("build", config, "-o", bee.parent / "out", "--until", "wires").returncode == 0
    refused(wrapit("init", bee.with_name("none.png")), 3, "none.png", "check its path")
    for folder in ("", ".", "/"):
        refused(wrapit("init", folder), 3, "no file but a folder")


def test_the_command_that_init_proposes_works(bee: Path) -> None:
    drawing = bee.with_name("bee.png").rename(bee.with_name("-a bee's.png"))
    told = wrapit("init", f"./{drawing.name}", cwd=bee.parent).stdout
    command = shlex.split(told.partition("build it with: ")[2])
    assert command[: len(WRAPIT)] == WRAPIT  # as it was called
    assert wrapit(*command[len(WRAPIT) :], "--until", "drawing", cwd=bee.parent).returncode == 0


def test_alternatives_are_drawn_best_first(bee: Path) -> None:
    out = bee.parent / "out"
    run = wrapit("build", bee, "-o", out, "--until", "wires", "--alternatives", "3", "--json")
    text = (out / "alternatives.svg").read_text()
    energies = [float(words.split()[1]) for words in re.findall(r">(energy [\d.]+)<", text)]
    assert len(energies) == 3
    assert energies == sorted(energies)
    assert energies[0] == pytest.approx(json.loads(run.stdout)["decomposition"]["energy"]["total"], abs=1e-3)


def test_coupons_are_written_whole(tmp_path: Path) -> None:
    assert wrapit("coupon", "-o", tmp_path / "test pieces").returncode == 0
    written = sorted(path.name for path in (tmp_path / "test pieces").iterdir())
    assert written == ["coupon-clearance.stl", "coupon-kerf.dxf"]


def test_check_writes_nothing(bee: Path) -> None:
    run = wrapit("check", bee, "--json", cwd=bee.parent)
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["jig"]["valid"] is True
    assert sorted(path.name for path in bee.parent.iterdir()) == ["bee.png", "bee.yaml"]


def test_same_input_gives_the_same_bytes(bee: Path) -> None:
    first, second = bee.parent / "first", bee.parent / "second"
    for out in (first, second):
        assert wrapit("build", bee, "-o", out).returncode == 0
    names = sorted(path.name for path in first.iterdir())
    assert names == sorted(path.name for path in second.iterdir())
    assert len(names) > 12
    assert [name for name in names if (first / name).read_bytes() != (second / name).read_bytes()] == []


def test_a_pair_gets_a_mirrored_jig(bee: Path) -> None:
    out = bee.parent / "out"
    run = wrapit("build", bee, "-o", out, "--set", "pair=true", "--set", "outputs=[step, stl]", "--json")
    jig = json.loads(run.stdout)["jig"]
    names = {path.name for path in out.iterdir()}
    assert {"jig-mirrored.step", "jig-mirrored.stl", "wires-mirrored.step", "preview-mirrored.png"} <= names
    assert jig["mirrored"]["valid"] is True
    assert jig["mirrored"]["turn_support"] == pytest.approx(jig["turn_support"], abs=0.03)
    # A neck just as wide as the narrowest wall is cut on one side only, with 4 mm² behind it.
    assert jig["mirrored"]["volume_mm3"] == pytest.approx(jig["volume_mm3"], rel=0.02)
