"""Pages as people have them: ruled and squared paper, frames, signatures, two pens, a photo of pencil."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import gaussian_filter

from tests.drawing.generated import Points, degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError, Finding

SIZE_PX = 600

WIDTH_PX = 9.0


def ring(radius: float, x: float, y: float) -> Points:
    t = np.linspace(0, 2 * math.pi, 241)
    return np.column_stack([x + radius * np.cos(t), y + radius * np.sin(t)])


def page(scale: float = 1.0) -> np.ndarray:
    """Three rings in a row, each crossing the next: four crossings."""
    middle = SIZE_PX / 2
    rings = [ring(scale * 110, middle + scale * at, middle) for at in (-130, 0, 130)]
    return render(rings, WIDTH_PX, (SIZE_PX, SIZE_PX))


def traced(folder: Path, grey: np.ndarray) -> tuple[Drawing, tuple[Finding, ...]]:
    Image.fromarray(grey.astype(np.uint8)).save(folder / "page.png")
    return trace(folder / "page.png", TracingConfig(), 50.0)


def ruled(grey: np.ndarray, level: int, squared: bool, thick: int = 2) -> np.ndarray:
    lined = grey.copy()
    for at in range(17, SIZE_PX, 37):
        lined[at : at + thick] = np.minimum(lined[at : at + thick], level)
        if squared:
            lined[:, at : at + thick] = np.minimum(lined[:, at : at + thick], level)
    return lined


@pytest.mark.parametrize("squared", [False, True])
def test_pale_rules_are_paper(tmp_path, squared):
    drawing, findings = traced(tmp_path, ruled(page(), 205, squared))
    assert degrees(drawing) == [4] * 4
    assert findings == ()


@pytest.mark.parametrize("squared", [False, True])
@pytest.mark.parametrize("thick", [2, 7])
def test_rules_paler_than_the_ink_are_left_out_and_named(tmp_path, squared, thick):
    drawing, findings = traced(tmp_path, ruled(page(), 120, squared, thick))
    assert degrees(drawing) == [4] * 4
    assert [finding.code for finding in findings] == ["ruled-paper"]


def test_thin_rules_as_dark_as_the_ink_are_refused_by_name(tmp_path):
    with pytest.raises(DrawingError, match="ruled or squared"):
        traced(tmp_path, ruled(page(), 0, squared=True))


def test_rules_like_the_strokes_are_traced_and_named(tmp_path):
    _, findings = traced(tmp_path, ruled(page(), 0, squared=False, thick=9))
    assert "ruled-paper" in {finding.code for finding in findings}


def test_a_photo_of_pencil_on_squared_paper_comes_out_right(tmp_path):
    rng = np.random.default_rng(2)
    grain = gaussian_filter(rng.normal(size=(SIZE_PX, SIZE_PX)), 1.0)
    pencil = 255 - (255.0 - page()) / 255 * np.clip(150 + 25 * grain / grain.std(), 60, 255)
    light = np.linspace(0.95, 0.6, SIZE_PX) * np.linspace(1, 0.85, SIZE_PX)[:, None]
    photo = gaussian_filter(ruled(pencil, 205, True), 1.0) * light + rng.normal(scale=4, size=light.shape)
    drawing, findings = traced(tmp_path, np.clip(photo, 0, 255))
    assert degrees(drawing) == [4] * 4
    assert {finding.code for finding in findings} == {"uneven-paper"}


@pytest.mark.parametrize("askew_deg", [0.0, 1.0])
def test_a_frame_around_a_small_drawing_is_left_out_and_named(tmp_path, askew_deg):
    framed = Image.fromarray(page(0.45))
    ImageDraw.Draw(framed).rectangle((25, 25, SIZE_PX - 26, SIZE_PX - 26), outline=0, width=6)
    drawing, findings = traced(tmp_path, np.asarray(framed.rotate(askew_deg, fillcolor=255)))
    assert degrees(drawing) == [4] * 4
    assert [finding.code for finding in findings] == ["frame"]
    assert [removal.what for removal in drawing.removed] == ["frame"]


def test_a_frame_that_the_drawing_touches_stays(tmp_path):
    framed = Image.fromarray(page())
    pen = ImageDraw.Draw(framed)
    pen.rectangle((25, 25, SIZE_PX - 26, SIZE_PX - 26), outline=0, width=9)
    pen.line((300, 30, 300, 190), fill=0, width=9)
    drawing, findings = traced(tmp_path, np.asarray(framed))
    assert degrees(drawing) == [2] * 4 + [3, 3] + [4] * 4
    assert findings == ()


def test_a_signature_is_left_out_and_named(tmp_path):
    signed = Image.fromarray(page())
    ImageDraw.Draw(signed).text((330, 540), "Anna M. 2024", fill=0, font=ImageFont.load_default(36))
    drawing, findings = traced(tmp_path, np.asarray(signed))
    assert degrees(drawing) == [4] * 4
    assert "left-out" in {finding.code for finding in findings}


def test_a_broad_stroke_among_thin_ones_is_not_taken_for_two(tmp_path):
    thin = [np.array([(x, 60.0), (x + 30, 540.0)]) for x in (120.0, 230.0, 340.0, 450.0)]
    grey = np.minimum(
        render(thin, 7.0, (SIZE_PX, SIZE_PX)),
        render([np.array([(40.0, 290.0), (560.0, 310.0)])], 13.0, (SIZE_PX, SIZE_PX)),
    )
    drawing, findings = traced(tmp_path, grey)
    assert degrees(drawing) == [1] * 10 + [4] * 4
    assert "touching" not in {finding.code for finding in findings}


@pytest.mark.parametrize("sides", ["all around", "left and below"])
def test_the_table_around_photographed_paper_is_left_out_and_named(tmp_path, sides):
    table = np.full((SIZE_PX + 200, SIZE_PX + 200), 60.0)
    table[100:-100, 100:-100] = page()
    photo = table if sides == "all around" else table[100:, :-100]
    drawing, findings = traced(tmp_path, gaussian_filter(photo, 1.0))
    assert degrees(drawing) == [4] * 4
    assert [finding.code for finding in findings] == ["dark-table"]


def test_chalk_on_a_board_is_no_paper_on_a_table(tmp_path):
    drawing, findings = traced(tmp_path, 255 - page())
    assert degrees(drawing) == [4] * 4
    assert [finding.code for finding in findings] == ["light-on-dark"]
