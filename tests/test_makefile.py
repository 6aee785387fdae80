"""`make build/NAME` builds a piece when, and only when, something that it is made from changed."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.conftest import CONFIGS
from tests.make_project import RING, Project

# To make it is all one whether wrapit builds or recalls.
pytestmark = pytest.mark.usefixtures("recalling")

# A bitmap and an SVG, the quickest of ours: make knows no more of a piece than its files.
PIECES = {"treble-clef": "treble-clef.png", "celtic-knot": "celtic-knot.svg"}


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path / "project")


@pytest.fixture(scope="module")
def built_ring(tmp_path_factory: pytest.TempPathFactory) -> Project:
    project = Project(tmp_path_factory.mktemp("ring") / "project")
    project.add()
    assert project.builds("build/ring") == 1
    return project


@pytest.fixture
def ring(built_ring: Project, tmp_path: Path) -> Project:
    """A project with one piece, built."""
    return built_ring.copied(tmp_path / "project")


def later(path: Path) -> None:
    """Touches a file, later than any that was written before, however coarse the clock of the disk."""
    time.sleep(0.02)
    path.touch()


@pytest.mark.parametrize("name", PIECES)
def test_each_config_is_built_when_its_drawing_is_touched_and_only_then(name: str, tmp_path: Path) -> None:
    project = Project(tmp_path / "project", "exports")
    for path in CONFIGS.glob(f"{name}.*"):
        shutil.copy2(path, project.configs / path.name)
    goal = f"build/{name}"
    assert project.builds(goal) == 1
    before = project.files(name)
    assert {"report.json", "guide.html", "wires.step"} <= before.keys()
    assert project.builds(goal) == 0
    assert project.files(name) == before
    later(project.configs / PIECES[name])
    assert project.builds(goal) == 1
    assert project.files(name) == before
    assert project.builds(goal) == 0


@pytest.mark.parametrize(
    "source",
    [
        "configs/ring.svg",
        "configs/ring.yaml",
        "wrapit/units.py",
        "wrapit/instructions/page/guide.css",
        "wrapit/instructions/page/guide.js",
        "wrapit/instructions/page/guide.html.jinja",
        "wrapit/instructions/words/de.ftl",
    ],
)
def test_a_touched_source_is_built_from_again(source: str, ring: Project) -> None:
    before = ring.files()
    assert ring.builds("build/ring") == 0
    later(ring.folder / source)
    assert ring.builds("build/ring") == 1
    assert ring.files() == before
    assert ring.builds("build/ring", "all") == 0


def test_each_file_that_is_gone_is_made_again(ring: Project) -> None:
    before = ring.files()
    (ring.build / "ring/decomposition.svg").unlink()
    assert ring.builds("build/ring") == 1
    assert ring.files() == before
    (ring.build / "ring/report.json").unlink()
    for name in before.keys() - {"report.json"}:
        (ring.build / "ring" / name).unlink()
    assert ring.builds("build/ring") == 1
    shutil.rmtree(ring.build / "ring")
    assert ring.builds("build/ring") == 1
    shutil.rmtree(ring.build / ".deps")
    assert ring.builds("build/ring") == 1
    assert ring.make("clean").returncode == 0
    assert ring.builds("build/ring") == 1
    assert ring.files() == before


def test_what_somebody_else_wrote_stays(ring: Project) -> None:
    folder = ring.build / "ring"
    (folder / "notes.txt").write_text("mine")
    assert ring.builds("build/ring") == 0
    time.sleep(0.02)
    (folder / "drawing.svg").write_text("edited")
    assert ring.builds("build/ring") == 1
    assert (folder / "drawing.svg").read_text() == "edited"
    assert (folder / "drawing.new.svg").exists()
    assert (folder / "notes.txt").read_text() == "mine"
    assert ring.builds("build/ring") == 0


def test_a_failure_leaves_what_was_built_and_is_mended_by_the_drawing(ring: Project) -> None:
    before = ring.files()
    drawing = ring.configs / "ring.svg"
    time.sleep(0.02)
    drawing.write_text("this is no drawing")
    for _ in range(2):
        run = ring.make("build/ring")
        assert run.returncode != 0
        assert [line for line in run.stderr.splitlines() if line.startswith("error: ")], run.stderr
        assert ring.files() == before
    assert ring.calls() == 2
    drawing.unlink()
    run = ring.make("build/ring")
    assert run.returncode != 0
    assert "no such drawing" in run.stderr
    assert "No rule to make target" not in run.stderr
    assert ring.files() == before
    time.sleep(0.02)
    drawing.write_text(RING)
    assert ring.builds("build/ring") == 1
    assert ring.files() == before


def test_a_renamed_drawing_is_no_obstacle(ring: Project) -> None:
    (ring.configs / "ring.svg").rename(ring.configs / "oval.svg")
    config = ring.configs / "ring.yaml"
    time.sleep(0.02)
    config.write_text(config.read_text().replace("ring.svg", "oval.svg"))
    assert ring.builds("build/ring") == 1
    assert ring.builds("build/ring") == 0
    later(ring.configs / "oval.svg")
    assert ring.builds("build/ring") == 1


def test_a_renamed_config_is_no_obstacle(ring: Project) -> None:
    (ring.configs / "ring.yaml").rename(ring.configs / "oval.yaml")
    assert ring.builds("all") == 1
    assert ring.builds("all") == 0
    assert (ring.build / "ring/report.json").exists()


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_an_interruption_leaves_what_was_built(how: signal.Signals, ring: Project) -> None:
    before = ring.files()
    later(ring.configs / "ring.svg")
    process = ring.start("build/ring")
    deadline = time.monotonic() + 60
    while not list(ring.build.glob(".ring.*.partial")):
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.005)
    os.killpg(process.pid, how)
    process.communicate(timeout=60)
    assert process.returncode != 0
    assert ring.files() == before
    assert ring.builds("build/ring") == 1
    assert ring.files() == before
    assert sorted(path.name for path in ring.build.iterdir()) == [".deps", "ring"]


@pytest.mark.parametrize(
    "drawing",
    [
        "../art/x.svg",
        "../art (old)/my drawing.svg",
        "a $HOME $(x) #1.svg",
        "a:b;c=d|e&.svg",
        "100% é\u202f~'\"`!.svg",
        "wild*card?[a].svg",
        "back\\slash\\ .svg",
    ],
)
def test_a_drawing_is_seen_whatever_its_name(drawing: str, project: Project) -> None:
    path = project.add(drawing=drawing)
    assert project.builds("build/ring") == 1
    assert project.builds("build/ring") == 0
    later(path)
    assert project.builds("build/ring") == 1
    assert project.builds("build/ring") == 0


@pytest.mark.parametrize("name", ["my ring", "ring's $1 #2", "100%; a=b|c&d"])
def test_a_config_is_built_whatever_its_name(name: str, project: Project) -> None:
    drawing = project.add(name)
    assert project.builds("all") == 1
    assert (project.build / name / "report.json").exists()
    assert project.builds("all") == 0
    later(drawing)
    assert project.builds("all") == 1
    later(project.build / name / "decomposition.svg")
    assert project.builds("all") == 1
    assert project.builds("all") == 0


def test_all_builds_each_once_side_by_side(project: Project) -> None:
    first = project.add()
    project.add("oval", "oval.svg")
    assert project.builds("-j2", "all") == 2
    assert project.builds("-j2", "all") == 0
    later(first)
    assert project.builds("-j2", "all") == 1
    assert sorted(path.name for path in project.build.iterdir()) == [".deps", "oval", "ring"]


@pytest.mark.parametrize("options", ["decomposition", "drawing", "wires", "decomposition --set size=50mm"])
def test_what_was_built_by_hand_is_built_again(options: str, project: Project) -> None:
    drawing = project.add()
    command = [sys.executable, "-m", "wrapit", "build", "configs/ring.yaml", "--until", *options.split()]
    subprocess.run(command, cwd=project.folder, check=True, capture_output=True)
    assert project.builds("build/ring") == 1
    before = project.files()
    assert "decomposition.svg" in before
    assert project.builds("build/ring") == 0
    later(drawing)
    assert project.builds("build/ring") == 1
    time.sleep(0.02)
    subprocess.run([*command, "--force"], cwd=project.folder, check=True, capture_output=True)
    assert project.builds("build/ring") == 1
    assert project.files() == before


def test_a_piece_without_a_config_is_refused(ring: Project) -> None:
    run = ring.make("build/nothing")
    assert run.returncode != 0
    assert "No rule to make target 'build/nothing'" in run.stderr
