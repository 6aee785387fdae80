"""What is no line drawing is refused with a reason."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from tests.drawing.bitmap.crosses import CROSS, SHAPE
from tests.drawing.bitmap.figures import CENTRE, TURNS, few, line, turned
from tests.drawing.generated import degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError


def blank() -> np.ndarray:
    return np.full(SHAPE, 250)


def faint() -> np.ndarray:
    return 255 - (render(CROSS, 9.0, SHAPE) < 128) * 14


def noise() -> np.ndarray:
    return np.random.default_rng(1).integers(0, 256, SHAPE)


def black_and_white_noise() -> np.ndarray:
    return 255 * np.random.default_rng(1).integers(0, 2, SHAPE)


def photo() -> np.ndarray:
    rng = np.random.default_rng(2)
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    waves = sum(
        rng.normal() / k * np.sin(k * (x * rng.normal() + y * rng.normal()) / 60 + rng.uniform(0, 6))
        for k in np.linspace(1, 12, 40)
    )
    return np.clip(128 + 60 * waves / waves.std() + rng.normal(0, 6, SHAPE), 0, 255)


def filled() -> np.ndarray:
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    return 255 - 255 * (np.hypot(x - 180, y - 150) < 90)


def partly_filled() -> np.ndarray:
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    return np.where(np.hypot(x - 180, y - 140) < 50, 0, render(CROSS, 9.0, SHAPE))


def dots() -> np.ndarray:
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    return 255 - 255 * (np.hypot(x % 60 - 30, y % 60 - 30) < 7)


@pytest.mark.parametrize(
    ("picture", "reason"),
    [
        (blank, "blank"),
        (faint, "blank|stands out"),
        (noise, "noise"),
        (black_and_white_noise, "noise"),
        (photo, "photo"),
        (filled, "filled"),
        (partly_filled, "filled"),
        (dots, "dots"),
    ],
)
def test_what_is_no_line_drawing_is_refused(picture, reason, tmp_path):
    path = tmp_path / "picture.png"
    Image.fromarray(picture().astype(np.uint8)).save(path)
    with pytest.raises(DrawingError, match=reason) as caught:
        trace(path, TracingConfig(), 40.0)
    assert str(path) in str(caught.value)
    assert caught.value.remedy


def test_a_filled_shape_becomes_its_outline_on_request(tmp_path):
    path = tmp_path / "disc.png"
    Image.fromarray(filled().astype(np.uint8)).save(path)
    drawing, _ = trace(path, TracingConfig(filled="outline"), 40.0)
    assert degrees(drawing) == [2]
    assert drawing.length_mm == pytest.approx(40 * np.pi, rel=0.01)


def arrow(length: float) -> list[np.ndarray]:
    return [line((0, 0), (length, 0)), line((length / 2, -length / 2), (length, 0), (length / 2, length / 2))]


def chevron(length: float) -> list[np.ndarray]:
    return [line((0, 0), (length / 2, length / 2), (length, 0))]


def cross(length: float) -> list[np.ndarray]:
    return [line((0, 0), (length, length)), line((length, 0), (0, length))]


@few
@given(
    st.sampled_from([(arrow, [1, 1, 1, 3]), (chevron, [1, 1, 2]), (cross, [1, 1, 1, 1, 4])]),
    st.floats(6.2, 12),
    st.floats(6, 24),
    TURNS,
)
def test_a_thick_pen_is_no_filled_shape(tmp_path, drawn, length, width_px, turn):
    figure, ends = drawn
    side = int((2 * length + 4) * width_px)
    strokes = [
        turned(stroke * width_px - length * width_px / 2 + CENTRE, turn) + side / 2 - CENTRE
        for stroke in figure(length)
    ]
    path = tmp_path / "thick.png"
    Image.fromarray(render(strokes, width_px, (side, side))).save(path)
    assert degrees(trace(path, TracingConfig(), 40.0)[0]) == ends


@few
@given(st.floats(0.28, 0.6), st.floats(40, 120), TURNS)
def test_however_long_a_filled_shape_is_it_is_refused(tmp_path, narrow, half_length, turn):
    """Lenses drawn out to points have no one width."""
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]] - np.array([SHAPE[0] / 2, SHAPE[1] / 2])[:, None, None]
    along, across = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
    height = 2 * narrow * half_length * (1 - (along / half_length) ** 2)
    path = tmp_path / "lens.png"
    Image.fromarray((255 * (np.abs(across) > height / 2)).astype(np.uint8)).save(path)
    with pytest.raises(DrawingError, match=r"filled|dots"):
        trace(path, TracingConfig(), 40.0)


def test_a_thin_frame_does_not_make_a_thicker_drawing_a_filled_shape(tmp_path):
    frame = [np.array([(12, 12), (348, 12), (348, 288), (12, 288), (12, 12)], float)]
    picture = np.minimum(render(frame, 4.0, SHAPE), render(CROSS, 11.0, SHAPE))
    path = tmp_path / "framed.png"
    Image.fromarray(picture.astype(np.uint8)).save(path)
    drawing, _ = trace(path, TracingConfig(), 40.0)
    assert len(drawing.segments) == 4  # the cross, without the frame
