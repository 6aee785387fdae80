"""Strokes of one to four pixels, as icons and small pictures from the web have them, are no staircases."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from tests.drawing.bitmap.figures import CENTRE, SIZE_PX, TURNS, few
from tests.drawing.bitmap.test_hard_edges import read, wave
from tests.drawing.generated import render
from wrapit.geometry import FloatArray

WIDTHS = st.floats(1.4, 4.4)


def _turning_deg(points: FloatArray) -> float:
    steps = np.diff(points, axis=0)
    return float(np.degrees(np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))).sum()))


def _read(line: FloatArray, width: float, path: Path) -> tuple[float, int, FloatArray, object]:
    Image.fromarray(render([line], width, (SIZE_PX, SIZE_PX))).save(path)
    return read(path)


@few
@given(st.floats(0, 40), TURNS, WIDTHS)
def test_a_thin_wave_turns_as_much_as_it_is_drawn(
    tmp_path: Path, bend: float, turn: float, width: float
) -> None:
    line = wave(bend, turn)
    turning, beziers, places, shape = _read(line, width, tmp_path / "thin.png")
    thick = _read(line, 11.0, tmp_path / "thick.png")
    assert shape == thick[3]
    assert turning <= 1.15 * _turning_deg(line) + 15
    assert beziers <= 1.5 * thick[1] + 3
    away = np.linalg.norm(places[::4, None] - line[None], axis=2).min(axis=1)
    # The wave's own points lie up to 2 px apart.
    assert np.percentile(np.sqrt(np.maximum(away**2 - 1, 0)), 95) < 0.4


@few
@given(st.floats(40, 150), WIDTHS, st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_a_thin_ring_is_round(tmp_path: Path, radius: float, width: float, x: float, y: float) -> None:
    angle = np.linspace(0, 2 * np.pi, 400)
    middle = CENTRE + np.array([x, y])
    ring = middle + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    turning, beziers, places, _ = _read(ring, width, tmp_path / "ring.png")
    assert 350 < turning < 375
    assert beziers <= 8
    assert np.abs(np.linalg.norm(places - middle, axis=1) - radius).max() < 0.35
