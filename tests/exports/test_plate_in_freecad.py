"""FreeCAD imports the plate: as many closed loops, of the same lengths and areas."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from shapely import Polygon

from tests.exports.pieces_for_tests import eye
from tests.jig.sheet.laser import laser_of
from wrapit.config import PlateConfig
from wrapit.config.plate import CurveStyle, ProfileName
from wrapit.exports.contour_edges import as_chain
from wrapit.exports.plate_dxf import write_dxf
from wrapit.exports.short_spans import without_short_spans
from wrapit.geometry import Loop
from wrapit.jig.sheet.checks import length_mm

pytestmark = pytest.mark.client
SCRIPT = Path(__file__).with_name("freecad_dxf.py")


@pytest.mark.parametrize(("profile", "curves"), [("lightburn", "spline"), ("plain", "arc")])
def test_freecad_finds_the_same_loops(
    program: Callable[[str], str], tmp_path: Path, profile: ProfileName, curves: CurveStyle
) -> None:
    freecad = program("freecadcmd")
    laser, _ = laser_of(eye()[1], PlateConfig())
    cuts = [contour for contour in laser.sheets[-1].contours if contour.is_cut]
    write_dxf(tmp_path / "cuts.dxf", cuts, profile, curves, 0.002)
    environment = {
        **os.environ,
        "DXF_FILE": str(tmp_path / "cuts.dxf"),
        "SEEN_JSON": str(tmp_path / "seen.json"),
        "HOME": str(tmp_path),
    }
    run = subprocess.run(
        [freecad, str(SCRIPT)], env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    assert (tmp_path / "seen.json").is_file(), run.stdout + run.stderr
    seen = json.loads((tmp_path / "seen.json").read_text())
    assert seen["closed"] == [True] * len(cuts)
    # Spans too short for a laser are joined to their neighbours, within a thousandth of a mm.
    assert seen["lengths"] == pytest.approx(
        sorted(map(length_mm, cuts)), rel=1e-3 if curves == "arc" else 1e-4
    )
    if curves == "spline":
        written = [without_short_spans(as_chain(cut.edges, closed=True), closed=True) for cut in cuts]
        assert seen["lengths"] == pytest.approx(sorted(chain.length for chain in written), rel=1e-5)
    areas = sorted(Polygon(Loop(cut.edges).sampled(1e-4)).area for cut in cuts)
    assert seen["areas"] == pytest.approx(areas, rel=1e-3)
