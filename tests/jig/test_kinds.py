"""Kinds of jig side by side: each makes its own files, waits for no other, and is left out alone."""

from __future__ import annotations

import dataclasses
import json
import pickle
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from tests.jig.metal import arcs, line, wires_of
from wrapit.config import Config
from wrapit.config.loading import Loaded
from wrapit.errors import Finding, JigError, UnheldError
from wrapit.geometry import Line
from wrapit.jig.contours import Contour, FlatDrawing
from wrapit.jig.kinds import JIGS
from wrapit.jig.made import Each, GuidePage, JigMaker, Made, View, Wires, one_by_one
from wrapit.pages.model import Paragraph, text
from wrapit.pipeline import build as building
from wrapit.pipeline import stages
from wrapit.pipeline.build import Build, build
from wrapit.pipeline.worker import Worker

# Two half circles of 8 mm on straight legs, which lie 60 mm apart or 240 mm.
HOOKS = "M 5 20 H {0} A 8 8 0 0 1 {0} 36 H 20 A 8 8 0 0 0 20 52 H {0}"


def piece(folder: Path, width_mm: float, **settings: Any) -> Path:
    """The config of a drawing that is so wide."""
    path = HOOKS.format(width_mm + 5 - 8)
    (folder / "hooks.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_mm + 10}mm" height="60mm" '
        f'viewBox="0 0 {width_mm + 10} 60"><path d="{path}" fill="none" stroke="black"/></svg>'
    )
    config = folder / "hooks.yaml"
    config.write_text(json.dumps({"drawing": "hooks.svg", **settings}))
    return config


@pytest.fixture
def processes(monkeypatch: pytest.MonkeyPatch) -> list[Worker]:
    """The kernel's processes that a build starts."""
    started: list[Worker] = []

    class Counted(Worker):
        def __enter__(self) -> Counted:
            started.append(self)
            return super().__enter__()

    monkeypatch.setattr(stages, "Worker", Counted)
    return started


def codes(result: Build, level: str) -> list[str]:
    return [each["code"] for each in result.report["findings"] if each["level"] == level]


def test_a_laser_jig_waits_for_no_print_bed_and_no_kernel(tmp_path: Path, processes: list[Worker]) -> None:
    config = piece(tmp_path, 240, jigs=["sheet"], outputs=["dxf"])
    result = build(config, tmp_path / "out", ("plate.sheet_width=400 mm",))
    assert processes == []
    assert result.report["drawing"]["size_mm"][0] == pytest.approx(240, abs=1)
    assert result.report["plate"]["parts"] >= 3
    assert "jig" not in result.report
    assert not ezdxf.readfile(tmp_path / "out" / "plate-1-3mm.dxf").audit().errors
    assert codes(result, "error") == []


def test_a_printed_jig_of_that_size_is_refused_for_its_bed(tmp_path: Path, processes: list[Worker]) -> None:
    config = piece(tmp_path, 240, jigs=["printed"], outputs=["dxf"])
    with pytest.raises(JigError, match="larger than the bed of 220 x 220 mm") as refusal:
        build(config, tmp_path / "out")
    assert refusal.value.exit_code == 3
    assert "jig.bed_width" in refusal.value.remedy
    assert not (tmp_path / "out").exists()
    assert len(processes) == 1


def test_all_kinds_at_once(tmp_path: Path, processes: list[Worker]) -> None:
    config = piece(tmp_path, 60, jigs=list(JIGS), outputs=["stl", "dxf", "html"])
    report = build(config, tmp_path / "out").report
    assert {"jig", "plate", "pegs"} <= set(report)
    assert {each["path"] for each in report["artifacts"]} >= {
        "jig.stl",
        "plate-1-3mm.dxf",
        "plate-2-6mm.dxf",
        "pegs.dxf",
        "guide.html",
    }
    guide = (tmp_path / "out" / "guide.html").read_text()
    assert guide.index('id="laser"') < guide.index('id="pegs"')
    assert len(processes) == 1


def test_a_kind_that_would_hold_too_little_is_left_out_alone(tmp_path: Path) -> None:
    config = piece(
        tmp_path, 60, jigs=["sheet", "pegs"], outputs=["dxf", "html"], pegs={"diameters": ["30 mm"]}
    )
    result = build(config, tmp_path / "out")
    assert codes(result, "error") == ["jig-left-out"]
    (left,) = [each for each in result.report["findings"] if each["code"] == "jig-left-out"]
    assert left["where"] == "jig pegs"
    assert left["message"].startswith("pegs would hold 0% of the turns")
    assert "pegs" not in result.report
    assert "plate" in result.report
    assert not list((tmp_path / "out").glob("pegs.*"))
    assert 'id="pegs"' not in (tmp_path / "out" / "guide.html").read_text()


def test_when_all_kinds_would_hold_too_little_nothing_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("wrapit.pipeline.build.what_would_do", lambda config, drawing: "take another drawing")
    config = piece(
        tmp_path, 60, jigs=["pegs", "sheet"], outputs=["dxf"], jig={"least_support": 1},
        pegs={"diameters": ["30 mm"]}, plate={"min_wall_width": "40 mm"},
    )  # fmt: skip
    with pytest.raises(UnheldError, match="pegs would hold 0% of the turns"):
        build(config, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def _paper(wires: Wires, _: Config, __: Each = one_by_one) -> Made:
    """A jig of paper: a line as long as the wires, and a page of one sentence."""
    length_mm = sum(wire.length_mm for wire in wires)
    line = Contour("SCORE", (Line((0.0, 0.0), (length_mm, 0.0)),))
    page = GuidePage("paper", text("plain", value="Fold it"), (Paragraph(text("plain", value="It tears.")),))
    return Made(
        block="paper",
        numbers={"length_mm": length_mm},
        findings=(Finding("note", "paper", "paper jig", "it tears"),),
        drawings=(FlatDrawing("paper", "Paper jig", (line,), length_mm, 1.0),),
        views=(View("preview", wires),),
        page=page,
    )


def test_a_new_kind_is_one_line_in_the_dict(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files, block of the report, findings and page come from the maker; no other code knows the kind."""
    load = building.load

    def loaded(*given: Any) -> Loaded:
        real = load(*given)
        return dataclasses.replace(real, config=real.config.model_copy(update={"jigs": ("paper", "sheet")}))

    # Only the config's own list of names would refuse it.
    monkeypatch.setattr(building, "load", loaded)
    monkeypatch.setitem(JIGS, "paper", JigMaker("paper", False, _paper, lambda *given: 1.0))
    config = piece(tmp_path, 60, outputs=["dxf", "svg", "html"])
    result = build(config, tmp_path / "out")
    lengths = sum(wire["length_mm"] for wire in result.report["wires"])
    assert result.report["paper"] == {"length_mm": pytest.approx(lengths, abs=1e-3)}
    assert "plate" in result.report
    assert "paper" in codes(result, "note")
    assert {"paper.dxf", "paper.svg"} <= {each["path"] for each in result.report["artifacts"]}
    (line,) = ezdxf.readfile(tmp_path / "out" / "paper.dxf").modelspace().query("LWPOLYLINE")
    assert line.get_points("xy") == [(0, 0), (pytest.approx(lengths, abs=1e-3), 0)]
    assert "It tears." in (tmp_path / "out" / "guide.html").read_text()


def test_a_planned_jig_that_was_sent_makes_the_same() -> None:
    wires = wires_of([arcs((0, 0), 0, (15, 0), (9, 180), (1.2, -150), (15, 0)), line((-5, 9), (25, 9))])
    config = Config(drawing="x", jig={"split": "single", "numbers": True})
    planned = JIGS["printed"].plan
    assert planned is not None
    sent = pickle.dumps(planned(wires, config))
    assert len(sent) < 400_000
    made, here = pickle.loads(sent).build(), JIGS["printed"].make(wires, config)
    assert made.numbers == here.numbers
    assert made.findings == here.findings
