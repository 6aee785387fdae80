"""Hard-edged pictures give the curves of their smooth twins; slits across strokes are closed, others stay."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageDraw

from tests.bench.drawing import CORPUS
from tests.bench.hard_edges import points_px
from tests.drawing.bitmap.figures import ACROSS, CENTRE, SIZE_PX, TURNS, few, turned
from tests.drawing.generated import render
from wrapit.config import TracingConfig
from wrapit.drawing.bitmap.hard_edges.pixels import block_side, is_hard, stair_px
from wrapit.drawing.bitmap.hard_edges.slits import without_slits
from wrapit.drawing.bitmap.ink import find_ink
from wrapit.drawing.stage import trace


def read(path):
    """Turning in degrees, number of Béziers, places in pixels, segments and degrees."""
    drawing, _ = trace(path, TracingConfig(), 60.0)
    frame = drawing.pixel_frame
    turning, places = 0.0, []
    for segment in drawing.segments:
        points = (segment.curve.sampled(0.5 * frame.mm_per_px) - frame.origin_mm) / frame.mm_per_px * [1, -1]
        steps = np.diff(points, axis=0)
        steps = steps[np.hypot(*steps.T) > 1e-9]
        turning += np.degrees(np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))).sum())
        places.append(points)
    beziers = sum(len(segment.curve) for segment in drawing.segments)
    shape = len(drawing.segments), sorted(len(ends) for ends in drawing.half_edges())
    return turning, beziers, np.concatenate(places), shape


def saved(picture, path, kind):
    """The picture thresholded, and saved as a kind says; the factor that it is enlarged by."""
    hard = Image.fromarray(((picture >= 128) * 255).astype(np.uint8))
    times = 1.0
    if kind.startswith("x"):
        times = float(kind[1:])
        hard = hard.resize([round(side * times) for side in hard.size], Image.Resampling.NEAREST)
    if kind == "jpeg":
        hard.save(path.with_suffix(".jpg"), quality=80)
        return path.with_suffix(".jpg"), times
    hard.convert({"1-bit": "1", "palette": "P"}.get(kind, "L")).save(path)
    return path, times


def wave(bend, turn):
    x = np.linspace(60, SIZE_PX - 60, 200)
    return turned(np.column_stack([x, CENTRE + bend * np.sin(x / 45)]), turn)


@few
@given(
    st.floats(0, 40), TURNS, st.floats(4.5, 28.0),
    st.sampled_from(["plain", "1-bit", "palette", "jpeg", "x2", "x3", "x4"]),
)  # fmt: skip
def test_a_hard_edged_wave_has_the_curves_of_the_smooth_one(tmp_path, bend, turn, width, kind):
    picture = render([wave(bend, turn)], width, (SIZE_PX, SIZE_PX))
    Image.fromarray(picture).save(tmp_path / "smooth.png")
    path, times = saved(picture, tmp_path / "hard.png", kind)
    smooth, hard = read(tmp_path / "smooth.png"), read(path)
    assert hard[3] == smooth[3]
    assert hard[0] <= 1.2 * smooth[0] + 12
    assert hard[1] <= 1.5 * smooth[1] + 3
    away = np.linalg.norm((hard[2][::8, None] + 0.5) / times - 0.5 - smooth[2][None], axis=2).min(axis=1)
    # Each of the two fits may leave its points by 0.04 widths.
    assert np.percentile(away, 95) < 0.5 + 0.04 * width


def off_the_lines_px(drawing, lines):
    """How far the drawing lies off the true lines, in pixels, at points a fifth of one apart.

    Places beyond 100 px from the middle are left out: whether an end is round or flat is another question.
    """
    from scipy.spatial import cKDTree

    true = [np.linspace(a, b, 5 * int(np.hypot(*(b - a))) + 2) for c in lines for a, b in pairwise(c)]
    points = points_px(drawing)
    near = np.linalg.norm(points - CENTRE, axis=1) < 100
    return cKDTree(np.concatenate(true)).query(points[near])[0]


def hard_edged(lines, width, path):
    edged = np.where(render(lines, width, (SIZE_PX, SIZE_PX)) < 128, 0, 255).astype(np.uint8)
    Image.fromarray(edged).save(path)
    return trace(path, TracingConfig(), 60.0)[0]


def random_strokes(seed):
    """A joint's two lines and a bend's one, turned at random, and a width: level edges have no middle."""
    rng = np.random.default_rng(seed)
    turn, shift = rng.uniform(0, 2 * np.pi), rng.uniform(-6, 6, 2)
    stem, side = np.radians([rng.uniform(50, 130), -rng.uniform(60, 110)])
    joint = [ACROSS, CENTRE + 140 * np.array([[0, 0], [np.cos(stem), -np.sin(stem)]])]
    bend = np.vstack([[60 - CENTRE, 0], [0, 0], [150 * np.cos(side), -150 * np.sin(side)]]) + CENTRE
    return [turned(c, turn, shift) for c in joint], [turned(bend, turn, shift)], rng.uniform(6, 15)


@few
@given(st.integers(0, 10_000))
def test_hard_edged_joints_and_bends_lie_on_the_true_lines(tmp_path, seed):
    worst, sides = [], []
    for part in range(8):
        joint, bend, width = random_strokes([seed, part])
        drawing = hard_edged(joint, width, tmp_path / "joint.png")
        assert sorted(len(ends) for ends in drawing.half_edges()) == [1, 1, 1, 3]
        worst.append(off_the_lines_px(drawing, joint).max())
        sides.append(
            np.percentile(off_the_lines_px(hard_edged(bend, width, tmp_path / "bend.png"), bend), 90)
        )
    assert np.mean(worst) < 0.5
    assert np.mean(sides) < 0.32


@few
@given(st.integers(0, 10_000))
def test_gentle_corners_on_hard_edges_keep_their_apexes(tmp_path, seed):
    off = []
    for part in range(8):
        rng = np.random.default_rng([seed, part])
        turn, width = rng.uniform(0, 2 * np.pi), rng.uniform(8, 14)
        half = np.radians(rng.uniform(36, 52) / 2)
        sides = [[-150 * np.cos(half), 150 * np.sin(half)], [0, 0], [150 * np.cos(half), 150 * np.sin(half)]]
        line = turned(CENTRE + np.array(sides), turn, rng.uniform(-6, 6, 2))
        off.append(off_the_lines_px(hard_edged([line], width, tmp_path / "gentle.png"), [line]).max())
    assert np.mean(off) < 0.8


@pytest.mark.skipif(not (CORPUS / "evaluate.py").exists(), reason="the corpus is not here; set WRAPIT_CORPUS")
@pytest.mark.parametrize("kind", ["plain", "x1.5", "x2.5"])
@pytest.mark.parametrize("name", ["lucide_anchor", "lucide_ship_wheel", "openmoji_mushroom", "tabler_atom"])
def test_a_real_drawing_thresholded_has_the_curves_of_the_smooth_one(tmp_path, name, kind):
    source = CORPUS / "dev" / f"{name}.png"
    path, _ = saved(np.asarray(Image.open(source).convert("L")), tmp_path / "hard.png", kind)
    smooth, hard = read(source), read(path)
    assert hard[3] == smooth[3]
    assert hard[0] <= 1.2 * smooth[0]
    assert hard[1] <= 1.5 * smooth[1]


@few
@given(TURNS, st.floats(4.0, 20.0), st.sampled_from([2, 3, 4, 7]))
def test_blocks_and_stairs_are_found(turn, width, side):
    picture = render([wave(30, turn)], width, (SIZE_PX, SIZE_PX))
    assert not is_hard(find_ink(picture, "wave"))
    mask = picture < 128
    assert block_side(mask) == 1
    # Level waves leave some rows out.
    assert 1.0 <= stair_px(mask) < 1.4
    assert block_side(np.kron(mask, np.ones((side, side), dtype=bool))) == side
    assert is_hard(find_ink(np.where(mask, np.uint8(0), np.uint8(255)), "wave"))


def painted(points, width, slit):
    """Rectangles end to end, `slit` apart, without joins."""
    image = Image.new("L", (900, 900), 255)
    draw = ImageDraw.Draw(image)
    for start, end in pairwise(points):
        along = (end - start) / np.linalg.norm(end - start)
        across = np.array([-along[1], along[0]]) * width / 2
        a, b = start + along * slit / 2, end - along * slit / 2
        draw.polygon([tuple(p) for p in (a + across, b + across, b - across, a - across)], fill=0)
    return image


@few
@given(st.integers(36, 60), st.floats(14, 34), st.floats(0, 0.07), st.floats(0, 1))
def test_a_ring_of_painted_polygons_is_one_loop(tmp_path, count, width, slit, phase):
    angle = np.linspace(0, 2 * np.pi, count + 1) + phase
    ring = 450 + 300 * np.column_stack([np.cos(angle), np.sin(angle)])
    painted(ring, width, slit * width).save(tmp_path / "ring.png")
    turning, _, places, (segments, _) = read(tmp_path / "ring.png")
    assert segments == 1
    assert turning < 620
    assert np.abs(np.linalg.norm(places - 450, axis=1) - 300).max() < 2.5


@few
@given(TURNS, st.floats(8.0, 24.0), st.floats(0.12, 0.4))
def test_white_lines_between_strokes_stay(turn, width, gap):
    apart = max(gap * width, 2.0) + width
    strokes = [turned(ACROSS + np.array([0, k * apart]), turn) for k in range(4)]
    ink = find_ink(render(strokes, width, (SIZE_PX, SIZE_PX)), "lines")
    assert without_slits(ink) is ink
