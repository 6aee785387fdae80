"""`wrapit init`: the proposed config loads, and its numbers follow the drawing."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.conftest import CONFIGS
from tests.drawing.generated import Points, render
from wrapit.config import load_config
from wrapit.drawing.proposal import propose
from wrapit.errors import DrawingError
from wrapit.units import awg_diameter_mm


def grid(lines: int) -> list[Points]:
    at = np.linspace(60, 440, lines)
    across = [np.array([(60.0, y), (440.0, y)]) for y in at]
    return across + [line[:, ::-1] for line in across]


def proposed(folder: Path, curves: list[Points], width_px: float, name: str = "my drawing.png"):
    Image.fromarray(render(curves, width_px, (500, 500))).save(folder / name)
    (folder / "piece.yaml").write_text(propose(folder / name).text(), encoding="utf-8")
    return load_config(folder / "piece.yaml")


def test_the_config_loads_and_names_the_drawing(tmp_path):
    config = proposed(tmp_path, grid(3), 8.0)
    assert config.drawing == "my drawing.png"
    assert config.size is not None
    assert 40 <= config.size <= 120


@pytest.mark.parametrize(
    "name", ["bee.png", "my bee.png", "a: b #c.png", "*a.png", "{x}.png", 'it\'s "x".png', "-d.png"]
)
@pytest.mark.parametrize("place", [".", "beside", "pic: tures #1/a b", "linked"])
def test_the_config_names_the_drawing_from_any_folder(tmp_path, place, name):
    pictures, configs = tmp_path / place, tmp_path / "configs"
    configs.mkdir()
    if place == "linked":
        (tmp_path / "far" / "away").mkdir(parents=True)
        pictures.symlink_to(tmp_path / "far" / "away")
    pictures.mkdir(parents=True, exist_ok=True)
    Image.fromarray(render(grid(2), 8.0, (500, 500))).save(pictures / name)
    for folder in (configs, pictures):
        config = folder / "piece.yaml"
        config.write_text(propose(pictures / name, folder).text(), encoding="utf-8")
        assert (folder / load_config(config).drawing).samefile(pictures / name)


@pytest.mark.parametrize("name", ["two\nlines.svg", "half-\udcff.svg", "bell\x07.svg"])
def test_a_drawing_that_no_config_can_name_is_refused(tmp_path, name):
    shutil.copy(CONFIGS / "leaf.svg", tmp_path / name)
    with pytest.raises(DrawingError, match="no path can have") as refused:
        propose(tmp_path / name)
    assert refused.value.remedy == "rename or move the drawing"


def test_denser_drawings_become_larger_pieces(tmp_path):
    sizes = [proposed(tmp_path, grid(lines), 8.0).size for lines in (2, 10)]
    assert sizes[0] is not None
    assert sizes[1] is not None
    assert sizes[0] < sizes[1]


def test_bolder_strokes_mean_thicker_wire(tmp_path):
    gauges = [proposed(tmp_path, grid(2), width).wire.gauge for width in (3.0, 8.0, 18.0)]
    assert gauges == pytest.approx([awg_diameter_mm(gauge) for gauge in (20, 18, 16)])


def test_a_drawing_that_is_none_is_refused(tmp_path):
    Image.new("L", (200, 200), 255).save(tmp_path / "blank.png")
    with pytest.raises(DrawingError, match="blank"):
        propose(tmp_path / "blank.png")
