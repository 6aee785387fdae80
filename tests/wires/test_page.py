"""The room's page is true of the code."""

from __future__ import annotations

import doctest
import math
import re
from pathlib import Path

import pytest

import wrapit.wires
from wrapit.config import JigConfig
from wrapit.materials import METALS
from wrapit.wires import centreline, rounding, stacking, stage, turns

ROOM = Path(wrapit.wires.__file__).parent
PAGE = ROOM / "README.md"


def test_the_pages_examples_run() -> None:
    result = doctest.testfile(str(PAGE), module_relative=False)
    assert result.attempted >= 4
    assert result.failed == 0


def test_the_map_names_every_module() -> None:
    named = set(re.findall(r"`([a-z_]+)`", PAGE.read_text(encoding="utf-8")))
    assert {path.stem for path in ROOM.glob("*.py")} - {"__init__"} <= named


def test_the_numbers_on_the_page_are_the_codes() -> None:
    page, jig = " ".join(PAGE.read_text(encoding="utf-8").split()), JigConfig()
    assert f"a fold (over {round(math.degrees(centreline.FOLD_RAD))}°)" in page
    assert pytest.approx(1 + 1 / 5) == rounding.GROWTH
    assert f"looked at every {turns.STEP_MM:g} mm" in page
    assert (
        f"`jig.turn_curvature` ({jig.turn_curvature:g} /mm: bends under {1 / jig.turn_curvature:g} mm" in page
    )
    assert f"`jig.turn_angle` ({round(math.degrees(jig.turn_angle))}°)" in page
    assert f"`jig.long_segment` ({jig.long_segment:g} mm)" in page
    assert f"a rise takes {stacking.RAMP_DIAMETERS:g} diameters" in page
    assert f"{stage.MIN_MARGIN_SHARE:.0%}".replace("%", " %") in page


def test_the_springback_law_is_the_plastic_moment_over_the_stiffness() -> None:
    yield_mpa, young_mpa, d = 60.0, 117e3, 1.3
    moment, second = yield_mpa * d**3 / 6, math.pi * d**4 / 64
    loss = METALS["copper"].springback_per_mm(d, "dead soft")
    assert loss == pytest.approx(moment / (young_mpa * second), rel=1e-3)
