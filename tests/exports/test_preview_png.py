"""The picture shows plate, walls and wires where they are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.exports.pieces_for_tests import eye
from wrapit.errors import ExportError
from wrapit.exports.preview_png import write_preview
from wrapit.geometry import Arc, Line, Loop, Region


def rectangle(left: float, bottom: float, right: float, top: float, *holes: Loop) -> Region:
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    edges = tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    return Region(Loop(edges), holes)


PLATE = rectangle(-26, -18, 38, 18, Loop((Arc((-23, -15), 1.0, 0.0, 2 * np.pi),)))
WALL = rectangle(-5, -3, 1, 3)


def test_colours_stand_where_things_are(tmp_path: Path) -> None:
    _, wires = eye()
    path = tmp_path / "preview.png"
    write_preview(path, wires, [WALL], PLATE)
    image = np.asarray(Image.open(path)).astype(int)
    scale = image.shape[1] / (64 + 6)

    def at(x: float, y: float) -> np.ndarray:
        return image[round((18 + 3 - y) * scale), round((x + 26 + 3) * scale)]

    assert image.shape[1] == 1200
    assert at(-23, -15).tolist() == [120, 120, 118]  # the start hole
    assert at(20, -14).tolist() == [224, 224, 222]  # bare plate
    assert at(-4, -2).tolist() == [190, 193, 198]  # the wall
    red, _, blue = at(28, 0)  # the copper stem
    assert red > blue + 60
    assert at(-28, 0).tolist() == [250, 249, 246]  # beside the plate


def test_bytes_repeat(tmp_path: Path) -> None:
    _, wires = eye()
    for name in ("a.png", "b.png"):
        write_preview(tmp_path / name, wires, [WALL], PLATE)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    write_preview(tmp_path / "c.png", wires[:1], [WALL], PLATE)
    assert (tmp_path / "c.png").read_bytes() != (tmp_path / "a.png").read_bytes()


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    _, wires = eye()
    with pytest.raises(ExportError, match="preview"):
        write_preview(tmp_path / "none" / "preview.png", wires)
