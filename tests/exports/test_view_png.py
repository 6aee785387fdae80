"""The picture at an angle: what is higher hides what is lower, and the bytes repeat."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.jig.metal import arcs, only, wires_of
from wrapit.errors import ExportError
from wrapit.exports.view_png import PAPER, PLATE, WALL, write_view
from wrapit.jig.made import View

CHAINS = [arcs((0, 0), 0, (9, 180), (12, 0))]


@pytest.fixture(scope="module")
def bare() -> View:
    jig = only(CHAINS)
    heights = tuple(wall.height_mm for wall in jig.plan.walls)
    return View("preview", (), jig.walls, jig.plate, heights_mm=heights, plate_mm=jig.plan.plate.thickness_mm)


@pytest.fixture(scope="module")
def laid(bare: View) -> View:
    return dataclasses.replace(bare, wires=wires_of(CHAINS))


def colours(path: Path) -> dict[tuple[int, ...], int]:
    pixels = np.asarray(Image.open(path)).reshape(-1, 3)
    seen, counts = np.unique(pixels, axis=0, return_counts=True)
    return {tuple(int(v) for v in colour): int(n) for colour, n in zip(seen, counts, strict=True)}


def test_paper_plate_and_walls_are_seen_and_the_wire_hides_some(
    tmp_path: Path, bare: View, laid: View
) -> None:
    write_view(tmp_path / "bare.png", bare)
    write_view(tmp_path / "laid.png", laid)
    without, with_wire = colours(tmp_path / "bare.png"), colours(tmp_path / "laid.png")
    for tone in (PAPER, PLATE, WALL):
        assert without[tuple(int(v) for v in tone)] > 1000
    assert with_wire[tuple(int(v) for v in PLATE)] < without[tuple(int(v) for v in PLATE)]


def test_bytes_repeat(tmp_path: Path, laid: View) -> None:
    for name in ("a.png", "b.png"):
        write_view(tmp_path / name, laid)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_missing_folder_is_named(tmp_path: Path, bare: View) -> None:
    with pytest.raises(ExportError, match="none"):
        write_view(tmp_path / "none" / "view.png", bare)
