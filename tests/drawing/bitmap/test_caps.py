"""How far strokes go: to the edge of a flat end or the picture's side, half a width less at a round end."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from tests.drawing.bitmap.figures import TURNS, few
from tests.drawing.generated import Points, degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace

SIZE = 520
MIDDLE = SIZE / 2


def flat(start: Points, end: Points, width: float) -> np.ndarray:
    """The grey of a stroke that is cut off square at both ends."""
    ahead = (end - start) / np.linalg.norm(end - start)
    y, x = np.mgrid[:SIZE, :SIZE]
    offset = np.stack([x, y], axis=-1) - (start + end) / 2
    along = np.abs(offset @ ahead) - np.linalg.norm(end - start) / 2
    across = np.abs(offset @ [-ahead[1], ahead[0]]) - width / 2
    outside = np.hypot(np.maximum(along, 0), np.maximum(across, 0)) + np.minimum(np.maximum(along, across), 0)
    return (255 * np.clip(outside + 0.5, 0, 1) + 0.5).astype(np.uint8)


def legs(turn: float, length: float) -> list[tuple[Points, Points]]:
    """A bar and a leg that stands on its middle."""
    ahead = length * np.array([math.cos(turn), math.sin(turn)])
    middle = np.array([MIDDLE, MIDDLE])
    return [(middle - ahead, middle + ahead), (middle, middle + 0.9 * np.array([-ahead[1], ahead[0]]))]


def length_px(grey: np.ndarray, tmp_path, kinds: list[int]) -> float:
    path = tmp_path / "ends.png"
    Image.fromarray(grey).save(path)
    drawing, _ = trace(path, TracingConfig(), 50.0)
    assert degrees(drawing) == kinds
    return drawing.length_mm / drawing.pixel_frame.mm_per_px


def hardened(grey: np.ndarray) -> np.ndarray:
    return np.where(grey < 128, 0, 255).astype(np.uint8)


@few
@given(st.floats(4, 30), TURNS)
def test_flat_ends_are_at_the_edge_of_their_ink(tmp_path, width, turn):
    grey = np.minimum(*(flat(a, b, width) for a, b in legs(turn, 200)))
    assert abs(length_px(grey, tmp_path, [1, 1, 1, 3]) - 580) < 3 * 0.2 * width


@few
@given(st.floats(9, 30), TURNS)
def test_flat_ends_are_at_the_edge_of_hard_ink(tmp_path, width, turn):
    grey = hardened(np.minimum(*(flat(a, b, width) for a, b in legs(turn, 200))))
    assert abs(length_px(grey, tmp_path, [1, 1, 1, 3]) - 580) < 3 * 0.2 * width


@few
@given(st.floats(4, 30), TURNS, st.booleans())
def test_round_ends_are_half_a_width_before_it(tmp_path, width, turn, hard):
    grey = render([np.array(leg) for leg in legs(turn, 200)], width, (SIZE, SIZE))
    off = length_px(hardened(grey) if hard else grey, tmp_path, [1, 1, 1, 3]) - 580
    assert abs(off) < 3 * 0.1 * width


@few
@given(st.floats(5, 30), st.floats(60, 120))
def test_the_side_of_the_picture_cuts_strokes_flat(tmp_path, width, angle):
    turn = math.radians(angle)
    grey = np.minimum(*(flat(a, b, width) for a, b in legs(turn, 900)))
    # From the upper side to the lower one, and from the middle to the left one.
    expected = SIZE / math.sin(turn) + (MIDDLE + 0.5) / math.sin(turn)
    assert abs(length_px(grey, tmp_path, [1, 1, 1, 3]) - expected) < 3 * 0.2 * width
