"""Round things that are no lines are known by place and size, from a file of either kind."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageDraw

from wrapit.config import TracingConfig
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.model import Dot
from wrapit.drawing.spots import spots_of_ink, spots_of_outlines
from wrapit.drawing.stage import trace

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">{}</svg>'
LINE = '<path d="M 2 38 C 10 20 50 20 58 38" fill="none" stroke="black" stroke-width="1"/>'


def dots_in(folder: Path, drawn: str) -> tuple[Dot, ...]:
    path = folder / "drawing.svg"
    path.write_text(PAGE.format(LINE + drawn))
    drawing, _ = trace(path, TracingConfig(), None)
    assert "dots" not in drawing_json(drawing)
    return drawing.dots


@pytest.mark.parametrize(
    "drawn",
    [
        '<circle cx="20" cy="10" r="2" fill="none" stroke="black"/>',
        '<circle cx="20" cy="10" r="2"/>',
        '<path d="M 20 10 h 0" stroke="black" stroke-width="4" stroke-linecap="round"/>',
        '<ellipse cx="20" cy="10" rx="2.2" ry="1.8" fill="none" stroke="black"/>',
    ],
)
def test_rings_discs_and_dots_of_an_svg(tmp_path: Path, drawn: str) -> None:
    (dot,) = dots_in(tmp_path, drawn)
    assert dot.diameter_mm == pytest.approx(4, rel=0.01)
    # The drawing's lower left corner is where its line's is: at (2, 38), y down.
    assert dot.at == pytest.approx((18, 28), abs=0.01)


@pytest.mark.parametrize(
    "drawn",
    [
        '<rect x="18" y="8" width="4" height="4" fill="none" stroke="black"/>',
        '<ellipse cx="20" cy="10" rx="3" ry="1.5" fill="none" stroke="black"/>',
        '<path d="M 18 10 L 22 10" fill="none" stroke="black"/>',
        '<path d="M 18 10 A 2 2 0 1 1 20 12" fill="none" stroke="black"/>',
    ],
)
def test_what_is_not_round_is_no_dot(tmp_path: Path, drawn: str) -> None:
    assert dots_in(tmp_path, drawn) == ()


def test_discs_and_rings_of_a_picture(tmp_path: Path) -> None:
    picture = Image.new("L", (1200, 800), 255)
    pen = ImageDraw.Draw(picture)
    pen.arc((100, 300, 1100, 1100), 180, 360, fill=0, width=16)
    pen.ellipse((380, 180, 440, 240), fill=0)
    pen.ellipse((740, 160, 840, 260), outline=0, width=16)
    path = tmp_path / "drawing.png"
    picture.save(path)
    drawing, _ = trace(path, TracingConfig(), 100.0)
    sizes = sorted(dot.diameter_mm for dot in drawing.dots)
    # 10 px are a millimetre; a ring is as large as its middle line.
    assert sizes == pytest.approx([6, 8.4], abs=0.35)
    assert sorted(dot.at[0] for dot in drawing.dots) == pytest.approx([31, 69], abs=0.6)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.3, 1.0), st.floats(0.5, 50), st.floats(0, 3.1))
def test_an_oval_is_round_up_to_four_thirds(flat: float, radius: float, turned: float) -> None:
    angles = np.linspace(0, 2 * np.pi, 33)
    points = radius * np.stack([np.cos(angles), flat * np.sin(angles)], axis=1)
    c, s = np.cos(turned), np.sin(turned)
    points = points @ np.array([[c, s], [-s, c]])
    points[-1] = points[0]
    a, b = points[:-1], points[1:]
    outline = np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b], axis=1)
    found = spots_of_outlines([outline])
    if abs(flat - 0.75) > 0.02:
        assert len(found) == (flat > 0.75)
    for spot in found:
        assert spot.at_px == pytest.approx((0, 0), abs=0.01 * radius)
        assert spot.diameter_px == pytest.approx(radius * (1 + flat), rel=0.02)


def test_ink_is_a_dot_where_its_skeleton_is_hardly_longer_than_a_point() -> None:
    pixels = np.array([[0.0, 0], [1, 0], [50, 50], [51, 50], [52, 50], [53, 50], [54, 50]])
    pairs = np.array([[0, 1], [2, 3], [3, 4], [4, 5], [5, 6]])
    distance = np.array([8.0, 8, 3, 3, 3, 3, 3])
    (spot,) = spots_of_ink(pixels, pairs, distance)
    assert spot.at_px == (0.5, 0)
    assert spot.diameter_px == pytest.approx(16.5)
