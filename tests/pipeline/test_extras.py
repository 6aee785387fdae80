"""Bail, seats and springback from config to files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from wrapit.errors import JigError
from wrapit.pipeline.build import build

pytestmark = pytest.mark.usefixtures("kernel_here")

RING = '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">{}</svg>'
STROKE = '<path d="{}" fill="none" stroke="black" stroke-width="1"/>'
CIRCLE = "M 35 20 A 15 15 0 0 1 5 20 A 15 15 0 0 1 35 20"


def built(folder: Path, *paths: str, **settings: Any) -> tuple[dict[str, Any], Path]:
    (folder / "piece.svg").write_text(RING.format("".join(STROKE.format(path) for path in paths)))
    config = folder / "piece.yaml"
    config.write_text(json.dumps({"drawing": "piece.svg", "outputs": ["step", "html"], **settings}))
    return build(config, folder / "out").report, folder / "out"


def codes(report: dict[str, Any]) -> set[str]:
    return {finding["code"] for finding in report["findings"]}


def test_a_ring_hangs_from_a_jump_ring_and_holds_a_bead(tmp_path: Path) -> None:
    seat = {"at": ["18 mm", "15 mm"], "diameter": "8 mm", "post": "1 mm"}
    report, out = built(tmp_path, CIRCLE, pair=True, bail={}, jig={"seats": [seat]})
    assert report["bail"]["kind"] == "ring"
    assert report["bail"]["at"] == pytest.approx([15, 30], abs=0.1)
    assert report["jig"]["seats"] == report["jig"]["mirrored"]["seats"] == 1
    assert report["jig"]["valid"]
    assert report["jig"]["mirrored"]["volume_mm3"] == pytest.approx(report["jig"]["volume_mm3"], rel=1e-3)
    for name in ("wires.step", "wires-mirrored.step"):
        assert "jump-ring" in (out / name).read_text()
    page = (out / "guide.html").read_text().replace("\u00a0", " ")
    assert "Set the bead or stone (8 mm thick) into its seat." in page
    assert "Open the jump ring" in page


def test_the_laser_cut_jig_says_that_it_has_no_seats(tmp_path: Path) -> None:
    seat = {"at": ["15 mm", "15 mm"], "diameter": "8 mm"}
    report, _ = built(tmp_path, CIRCLE, jigs=["printed", "sheet"], outputs=["dxf"], jig={"seats": [seat]})
    assert "seats-in-print-only" in codes(report)


def test_an_end_at_the_top_becomes_the_bail(tmp_path: Path) -> None:
    report, out = built(tmp_path, "M 20 10 L 20 40", bail={"diameter": "4 mm"})
    assert report["bail"]["kind"] == "loop"
    assert report["wires"][0]["length_mm"] == pytest.approx(30 + report["bail"]["wire_mm"], abs=0.01)
    assert "to hang the piece from" in (out / "guide.html").read_text()
    assert "jump-ring" not in (out / "wires.step").read_text()


def test_overbent_wires_are_in_the_jig_and_drawn_ones_in_the_files(tmp_path: Path) -> None:
    paths = (CIRCLE, "M 20 5 Q 40 20 20 35", "M 5 20 Q 20 40 35 20")
    wire = {"temper": "hard", "gauge": "1 mm"}
    report, out = built(tmp_path, *paths, wire=wire, jig={"springback": "compensate"})
    assert [each["name"] for each in report["springback"]] == [each["name"] for each in report["wires"]]
    assert all(each["residual_mm"] < 0.65 for each in report["springback"]), "as near as taut wires come"
    assert report["jig"]["jigs"] == len(report["wires"]) > 1
    assert "springback" in codes(report)
    assert "lift it out and let it go" in (out / "guide.html").read_text()
    with pytest.raises(JigError, match="can't share a jig"):
        built(tmp_path, *paths, wire=wire, jig={"springback": "compensate", "split": "single"})
    assert (out / "report.json").is_file(), "a build that fails leaves the earlier one"
