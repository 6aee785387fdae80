"""The room's page and the examples in its modules are true of the code."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import wrapit.geometry

ROOM = Path(wrapit.geometry.__file__).parent
PAGE = ROOM / "README.md"
MODULES = [info.name for info in pkgutil.walk_packages([str(ROOM)], "wrapit.geometry.")]


def test_the_pages_examples_run() -> None:
    result = doctest.testfile(str(PAGE), module_relative=False)
    assert result.attempted >= 5
    assert result.failed == 0


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_modules_run(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_the_map_names_every_module() -> None:
    named = set(re.findall(r"`(?:fitting/|outlines/)?([a-z_]+)`", PAGE.read_text(encoding="utf-8")))
    there = {path.stem for path in ROOM.rglob("*.py")} - {"__init__"}
    assert there <= named


def test_the_numbers_on_the_page_are_the_codes() -> None:
    from wrapit.geometry import arclength, curveset
    from wrapit.geometry.outlines import exact, parallels, polygons

    page = " ".join(PAGE.read_text(encoding="utf-8").split())
    assert f"every {exact.STEP_MM:g} mm (`STEP_MM`)" in page
    assert f"pieces of {curveset.MAX_PIECE_MM:g} mm and {curveset.MAX_PIECE_TURNING_RAD:g} rad" in page
    assert f"within `TOLERANCE_MM` ({parallels.TOLERANCE_MM:.0e} mm)".replace("e-05", "e-5") in page
    assert f"less than {parallels._MAX_TURNING_RAD:g} rad" in page
    assert f"corners over {round(polygons.CORNER_RAD * 57.29578)}°" in page
    assert f"cubics within {exact.FREE_TOLERANCES_MM[0]:g} mm" in page
    assert f"a table of {arclength.TABLE_SIZE} steps" in page
