"""What is looked at quickly is what a plain look sees: windows, counts, closed slits, the edges of ink."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from scipy.ndimage import maximum_filter, minimum_filter, zoom

from tests.drawing.generated import random_curve, render
from wrapit.drawing.bitmap import centre_lines
from wrapit.drawing.bitmap.corners import edge_fit
from wrapit.drawing.bitmap.hard_edges.slits import _closed, _surrounded
from wrapit.drawing.bitmap.image import count_levels
from wrapit.drawing.bitmap.ink import _enlarged, find_ink
from wrapit.drawing.bitmap.page.cells import _median
from wrapit.drawing.bitmap.page.extremes import highest, lowest

SHAPES = array_shapes(min_dims=2, max_dims=2, max_side=12)
PICTURES = arrays(np.uint8, SHAPES)
MASKS = arrays(np.bool_, SHAPES, elements=st.booleans())


@given(PICTURES, st.integers(0, 9).map(lambda half: 2 * half + 1), st.sampled_from(["nearest", "reflect"]))
def test_windows_are_filters(levels, side, rim):
    if rim == "reflect" and side // 2 > min(levels.shape):
        rim = "nearest"
    assert np.array_equal(highest(levels, side), maximum_filter(levels, side, mode=rim))
    assert np.array_equal(lowest(levels, side), minimum_filter(levels, side, mode=rim))


def test_windows_have_a_middle():
    with pytest.raises(ValueError, match="no middle"):
        highest(np.zeros((4, 4), dtype=np.uint8), 2)


@given(PICTURES, st.integers(0, 10))
def test_levels_are_counted(levels, share):
    # From all paper to none.
    levels = np.where(levels < 25 * share, levels, levels[0, 0])
    assert count_levels(levels).tolist() == np.bincount(levels.ravel(), minlength=256).tolist()
    assert _median(levels) == np.median(levels.astype(np.float32))


@given(MASKS, st.integers(1, 4))
def test_closed_is_what_no_square_of_paper_reaches(mask, width):
    side = width + 1
    padded = np.pad(mask, side)
    paper = np.zeros_like(padded)
    for row in range(padded.shape[0] - side + 1):
        for column in range(padded.shape[1] - side + 1):
            square = (slice(row, row + side), slice(column, column + side))
            if not padded[square].any():
                paper[square] = True
    assert np.array_equal(_closed(mask, width), ~paper[side:-side, side:-side])


@given(MASKS, st.integers(0, 3))
def test_surrounded_places_have_ink_all_around(mask, half):
    padded = np.pad(mask, half)
    side = 2 * half + 1
    places = np.arange(mask.size)
    expected = [
        at
        for at in places.tolist()
        if padded[at // mask.shape[1] :, at % mask.shape[1] :][:side, :side].all()
    ]
    assert _surrounded(mask, places, side).tolist() == expected


def test_edges_in_two_looks_are_those_in_one(monkeypatch):
    ink = find_ink(render([random_curve(np.random.default_rng(7), 300)], 9.0, (300, 300)), "")
    rng = np.random.default_rng(1)
    points = rng.uniform(0, 300, (700, 2))
    turned = rng.uniform(0, 2 * np.pi, 700)
    normals = np.column_stack([np.cos(turned), np.sin(turned)])
    looks = []
    for worth in (0, 10**9):
        monkeypatch.setattr(centre_lines, "_WORTH_PARTING", worth)
        looks.append(centre_lines.edges(ink, points, normals, 40.0, 0.6, inside=1.5))
    assert np.isfinite(looks[0]).any()
    assert np.isnan(looks[0]).any()
    assert np.array_equal(*looks, equal_nan=True)


@given(
    st.integers(0, 2**32 - 1),
    st.floats(0.01, 30),
    st.sampled_from(["walk", "crossed", "still"]),
    st.integers(1, 200),
)
def test_far_sides_are_no_points_nearest(seed, spread, kind, count):
    random = np.random.default_rng(seed)
    steps = random.normal(size=(60, 2)) * (10 if kind == "crossed" else 1)
    steps[10:14] *= kind != "still"  # sides of no length
    chain = np.cumsum(steps, axis=0)
    edge = chain[random.integers(60, size=count)] + random.normal(size=(count, 2)) * spread
    plain = edge_fit.missed(chain, edge, 3.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(edge_fit, "_WORTH_PARTING", 0)
        patch.setattr(edge_fit, "_AT_ONCE", 7)
        quick = edge_fit.missed(chain, edge, 3.0)
    for part in ("side", "share", "outside", "away"):
        assert np.array_equal(getattr(quick, part), getattr(plain, part))


@given(
    arrays(np.float32, array_shapes(min_dims=2, max_dims=2, max_side=6), elements=st.integers(0, 255)),
    st.integers(0, 15),
)
def test_blocks_are_enlarged_as_a_zoom_does(blocks, cut):
    height, width = (16 * side - cut for side in blocks.shape)
    full = zoom(blocks / 3, 16, order=1, mode="nearest", grid_mode=True)[:height, :width]
    assert np.array_equal(_enlarged(blocks / 3, (height, width)), full)
