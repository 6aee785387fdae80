"""Bitmaps of every mode in little memory; files that are something else, or cut off."""

from __future__ import annotations

import io
import time
import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from tests.drawing.generated import render
from tests.drawing.mutations import damaged
from tests.drawing.refused import PATIENCE_S, refusal
from wrapit.drawing.bitmap import image
from wrapit.drawing.bitmap.image import load_grey
from wrapit.errors import DrawingError

SHAPE = (60, 80)

CROSS = [np.array([(10.0, 12), (70, 50)]), np.array([(12.0, 50), (66, 8)])]


def ink(shape: tuple[int, int] = SHAPE) -> Image.Image:
    scale = shape[0] / SHAPE[0]
    return Image.fromarray(render([curve * scale for curve in CROSS], 6.0 * scale, shape).astype(np.uint8))


SPECIAL: dict[str, Callable[[Image.Image], Image.Image]] = {
    "I;16": lambda picture: Image.fromarray(np.asarray(picture).astype(np.uint16) * 257),
    "LAB": lambda picture: Image.merge("LAB", (picture, *[Image.new("L", picture.size, 0)] * 2)),
    "PA": lambda picture: picture.convert("RGB").quantize(8).convert("PA"),
    "P": lambda picture: picture.convert("RGB").quantize(8),
    "La": lambda picture: picture.convert("LA").convert("La"),
    "RGBa": lambda picture: picture.convert("RGBA").convert("RGBa"),
    "HSV": lambda picture: picture.convert("RGB").convert("HSV"),
    "half-clear": lambda picture: Image.merge(
        "RGBA", (*[picture] * 3, picture.point(lambda level: 255 - level // 3))
    ),
}


def in_mode(picture: Image.Image, mode: str) -> Image.Image:
    return SPECIAL[mode](picture) if mode in SPECIAL else picture.convert(mode)


MODES = (
    "1", "L", "LA", "La", "P", "PA", "RGB", "RGBA", "RGBa", "RGBX", "CMYK", "YCbCr", "LAB", "HSV", "I", "F",
    "I;16", "half-clear",
)  # fmt: skip


@pytest.mark.parametrize("mode", MODES)
def test_every_mode_takes_little_memory_beside_the_decoded_picture(mode, monkeypatch):
    monkeypatch.setattr(image, "_BAND_PIXELS", 50_000)
    picture = in_mode(ink((900, 1200)), mode)
    tracemalloc.start()
    try:
        result = image.grey_of(picture)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert result.shape == (900, 1200)
    # The result takes one byte a pixel; whole intermediate pictures took up to thirty.
    assert peak < 5 * result.size


@pytest.mark.parametrize("mode", MODES)
def test_bands_do_not_show_in_the_result(mode, monkeypatch):
    noise = np.random.default_rng(5).integers(0, 90, SHAPE)
    picture = in_mode(Image.fromarray(np.clip(np.asarray(ink()) - noise, 0, 255).astype(np.uint8)), mode)
    whole = image.grey_of(picture)
    for pixels in (500, 1700):
        monkeypatch.setattr(image, "_BAND_PIXELS", pixels)
        assert np.array_equal(image.grey_of(picture), whole)


def test_coloured_ink_is_read_from_the_channel_that_shows_it_best():
    level = np.asarray(ink())
    rgb = np.stack([np.full_like(level, 250), np.full_like(level, 240), level], axis=2)
    assert np.array_equal(image.grey_of(Image.fromarray(rgb)), level)


def test_an_animation_shows_its_first_frame(tmp_path):
    frames = [ink(), Image.new("L", (80, 60), 255)]
    frames[0].save(tmp_path / "a.gif", save_all=True, append_images=frames[1:])
    assert np.array_equal(load_grey(tmp_path / "a.gif", 10**6)[0], np.asarray(ink()))


@pytest.mark.parametrize("suffix", ["png", "jpg", "bmp", "tif", "webp", "gif"])
@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 100 100\n", "EPS"),
        (b"%PDF-1.7\n", "PDF"),
        (b"8BPS\0\1\0\0\0\0\0\0", "Photoshop"),
        (b"\0\0\0\x18ftypheic\0\0\0\0", "HEIC"),
        (b"\0\0\0\x1cftypavif\0\0\0\0", "AVIF"),
        (b"\0\0\0\x0cJXL \r\n\x87\n", "JPEG XL"),
        (b'<svg xmlns="http://www.w3.org/2000/svg"/>', "SVG"),
        (b"P6 10 10 255 " + b"a" * 300, "no image"),
        (b"", "empty"),
        (b"\x89PNG\r\n\x1a\n", "PNG and is damaged"),
    ],
)
def test_another_kind_of_file_is_named(tmp_path, suffix, data, kind):
    path = tmp_path / f"picture.{suffix}"
    path.write_bytes(data)
    message = refusal(path)
    assert kind in message
    assert str(path) in message


def test_no_other_program_is_started_for_a_picture(tmp_path, monkeypatch):
    monkeypatch.setattr("subprocess.check_call", lambda *_, **__: pytest.fail("a program was started"))
    monkeypatch.setattr("subprocess.Popen", lambda *_, **__: pytest.fail("a program was started"))
    ink().convert("RGB").save(tmp_path / "a.eps")
    (tmp_path / "a.eps").rename(tmp_path / "a.png")
    assert "EPS" in refusal(tmp_path / "a.png")


def test_a_picture_under_the_name_of_another_is_read(tmp_path):
    ink().save(tmp_path / "a.png")
    (tmp_path / "a.png").rename(tmp_path / "a.jpg")
    assert np.array_equal(load_grey(tmp_path / "a.jpg", 10**6)[0], np.asarray(ink()))


def saved(kind: str) -> bytes:
    file = io.BytesIO()
    picture = ink().convert("RGB") if kind in ("jpeg", "webp") else ink()
    picture.save(file, kind)
    return file.getvalue()


@pytest.mark.parametrize("kind", ["png", "jpeg", "bmp", "tiff", "webp", "gif"])
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(draw=st.data())
def test_damaged_pictures_are_read_or_refused(tmp_path, kind, draw):
    path = tmp_path / "picture.png"
    path.write_bytes(draw.draw(damaged(saved(kind))))
    begin = time.process_time()
    refused = None
    try:
        result, _ = load_grey(path, 1_000_000)
        assert result.dtype == np.uint8
    except DrawingError as error:
        refused = error
    assert time.process_time() - begin < PATIENCE_S
    if refused is not None:
        assert refused.remedy
        assert refused.where == str(path)
        assert "()" not in str(refused)
