"""`--alternatives` also says what fewer wires cost, and `max_wires` gives what was said."""

from __future__ import annotations

import itertools
import json
import re
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import CONFIGS
from tests.pipeline.folders import written_piece
from wrapit.pipeline.build import build
from wrapit.pipeline.exporting import FEWER_WIRES

NAMES = ("leaf", "initials")
# A cross in a ring: four junctions of three lines each around one of four.
CROSS = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"><g fill="none"'
    ' stroke="black"><path d="M 35 20 A 15 15 0 0 1 5 20 A 15 15 0 0 1 35 20"/>'
    '<path d="M 5 20 L 35 20 M 20 5 L 20 35"/></g></svg>'
)


def front_of(config: Path, folder: Path, *settings: str) -> list[dict[str, Any]]:
    report = build(config, folder, settings, until="decomposition", alternatives=1).report
    assert json.loads((folder / "report.json").read_text())["fewer_wires"] == report["fewer_wires"]
    assert FEWER_WIRES in {each["path"] for each in report["artifacts"]}
    front: list[dict[str, Any]] = report["fewer_wires"]
    return front


def crossed(folder: Path, **settings: Any) -> Path:
    config = written_piece(folder, **settings)
    (folder / "piece.svg").write_text(CROSS)
    return config


@pytest.mark.parametrize("name", NAMES)
def test_each_of_them_is_what_max_wires_gives(tmp_path: Path, name: str) -> None:
    config = CONFIGS / f"{name}.yaml"
    front = front_of(config, tmp_path / "all")
    assert [each["max_wires"] for each in front][:: len(front) - 1] == [None, 1]
    for number, each in enumerate(front):
        asked = f"decomposition.max_wires={each['max_wires'] or 'null'}"
        report = build(config, tmp_path / str(number), (asked,), until="wires").report
        energy = report["decomposition"]["energy"]
        assert energy["complexity"] == each["wires"] == len(each["lengths_mm"])
        assert energy["smoothness_rad"] * 57.29578 == pytest.approx(each["bends_deg"], abs=0.01)
        assert report["decomposition"]["optimal"] == each["optimal"]
        assert [wire["length_mm"] for wire in report["wires"]] == pytest.approx(each["lengths_mm"], abs=1e-3)
        assert (each["doubled_mm"] > 0) == bool(report["decomposition"]["doubled"])


@pytest.mark.parametrize("name", NAMES)
def test_fewer_wires_cost_more(tmp_path: Path, name: str) -> None:
    front = front_of(CONFIGS / f"{name}.yaml", tmp_path / "out")
    assert front[0]["doubled_mm"] == 0
    for more, fewer in itertools.pairwise(front):
        assert fewer["wires"] < more["wires"]
        assert fewer["doubled_mm"] > more["doubled_mm"]
    picture = (tmp_path / "out" / FEWER_WIRES).read_text()
    assert picture.count("<svg ") == 1 + len(front)
    assert re.findall(r">(\d+) wires?, (\d+) mm run twice<", picture) == [
        (str(each["wires"]), f"{each['doubled_mm']:.0f}") for each in front
    ]


@pytest.mark.parametrize("settings", [("choice=2",), ("max_wires=1",), ("doubling=true",)])
def test_what_the_config_takes_of_them_changes_none(tmp_path: Path, settings: tuple[str, ...]) -> None:
    config = crossed(tmp_path)
    front = front_of(config, tmp_path / "out")
    asked = [f"decomposition.{each}" for each in settings]
    assert front_of(config, tmp_path / "other", *asked) == front
    assert [each["wires"] for each in front] == [2, 1]


def test_the_other_solver_has_its_own(tmp_path: Path) -> None:
    front = front_of(crossed(tmp_path), tmp_path / "out", "decomposition.solver=annealing")
    assert [(each["wires"], each["optimal"]) for each in front][-1] == (1, False)


def test_where_one_wire_does_there_is_one_picture(tmp_path: Path) -> None:
    front = front_of(written_piece(tmp_path), tmp_path / "out")
    [only] = front
    assert (only["max_wires"], only["wires"], only["doubled_mm"]) == (None, 1, 0)
    assert (tmp_path / "out" / FEWER_WIRES).read_text().count("<svg ") == 2


def test_wishes_end_it_before_one_wire(tmp_path: Path) -> None:
    config = crossed(tmp_path, decomposition={"constraints": [{"different_wire": [0, 1]}]})
    assert [each["wires"] for each in front_of(config, tmp_path / "out")][-1] == 2


def test_it_comes_and_goes_as_it_is_asked_for(tmp_path: Path) -> None:
    config = crossed(tmp_path)
    front_of(config, tmp_path / "out")
    assert build(config, tmp_path / "out", until="decomposition", alternatives=1).up_to_date
    again = build(config, tmp_path / "out", ("size=50 mm",), until="decomposition")
    assert "fewer_wires" not in again.report
    assert not (tmp_path / "out" / FEWER_WIRES).exists()
