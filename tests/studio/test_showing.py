"""What a page draws lies where the piece is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shapely import LineString, hausdorff_distance

from tests.studio.running import with_piece
from wrapit.config import load_config
from wrapit.geometry.arclength import ArcLength
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.work import Work
from wrapit.studio.showing import SAG_MM, place, polyline, shown_after


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Work:
    folder: Path = with_piece(tmp_path_factory.mktemp("showing"))
    work = Work(load_config(folder / "leaf.yaml"), folder / "leaf.svg", "wires", lambda stage: None, 0)
    run_stages(work, None)
    return work


def test_a_polyline_is_near_its_wire_and_short(work: Work) -> None:
    [wire] = work.wires
    points = polyline(wire)
    curve = ArcLength(wire.centreline)
    fine = wire.centreline.at(curve.parameter(np.linspace(0, curve.total_mm, 5000)))
    assert hausdorff_distance(LineString(points), LineString(fine), densify=0.01) <= SAG_MM
    assert len(points) < 200
    assert points[0] == pytest.approx(list(fine[0]), abs=1e-3)
    assert points[-1] == pytest.approx(list(fine[-1]), abs=1e-3)


def test_a_place_along_a_wire_is_on_it(work: Work) -> None:
    [wire] = work.wires
    for at_mm in (0.0, 17.0, wire.length_mm):
        point = place(f"wire-01 at {at_mm:.0f} mm", work)
        curve = ArcLength(wire.centreline)
        meant = wire.centreline.at(curve.parameter(np.array([round(at_mm)])))[0]
        assert point == pytest.approx(list(meant), abs=1e-3)
    assert place("wire-01 at 17, 30 mm", work) == place("wire-01 at 17 mm", work)
    assert place("wire-01", work) == place(f"wire-01 at {wire.length_mm / 2:.6f} mm", work)


def test_numbers_and_points_are_places_too(work: Work) -> None:
    assert work.drawing is not None
    assert place("junction 1", work) == pytest.approx(list(work.drawing.junctions[1].point), abs=1e-3)
    assert place("(12.5, -3.0) mm", work) == [12.5, -3.0]
    near = place("segment 0", work)
    assert near is not None
    curve = LineString(work.drawing.segments[0].curve.sampled(0.01))
    assert curve.distance(LineString([near, near])) < 0.01


@pytest.mark.parametrize(
    "where",
    ["", "drawing", "wire-09 at 3 mm", "junction 99", "sheet 1 at (3.0, 4.0)", "segment 99", "config"],
)
def test_what_is_no_place_of_the_piece_has_none(work: Work, where: str) -> None:
    assert place(where, work) is None


def test_each_stage_shows_its_own(work: Work) -> None:
    keys = {
        stage: shown_after(stage, work)["shown"].keys() for stage in ("drawing", "decomposition", "wires")
    }
    assert {"drawing", "fit", "stage", "timings_s"} == keys["drawing"]
    assert {"energy", "optimal"} <= keys["decomposition"]
    assert "wires" in keys["wires"]


def test_a_wire_is_drawn_as_thick_as_it_is(work: Work) -> None:
    shown = shown_after("wires", work)["shown"]["wires"]
    assert [each["diameter_mm"] for each in shown] == [
        pytest.approx(wire.diameter_mm, abs=1e-3) for wire in work.wires
    ]


def test_a_fitted_drawing_is_the_one_that_is_shown(tmp_path: Path) -> None:
    folder: Path = with_piece(tmp_path)
    seen = []
    config = load_config(folder / "leaf.yaml", ["drop=[0]"])
    work = Work(
        config, folder / "leaf.svg", "wires", lambda stage: None, 0, after=lambda *told: seen.append(told)
    )
    run_stages(work, None)
    assert work.fitted is not None
    assert work.drawing is work.fitted.drawing
    shown = shown_after("drawing", work)["shown"]["drawing"]
    assert len(shown["segments"]) == len(work.fitted.original.segments) - 1 == len(work.fitted.origins)
    assert "dropped" in {each["what"] for each in shown["removed"]}
    drawn = {
        number for wire in shown_after("wires", work)["shown"]["wires"] for number, _ in wire["segments"]
    }
    assert drawn == set(range(len(shown["segments"])))
    assert [stage for stage, _ in seen] == ["drawing", "decomposition", "wires"]
