"""Every ordinary kind of picture gives the same drawing."""

from __future__ import annotations

import zlib
from collections.abc import Callable

import numpy as np
import pytest
from PIL import Image

from tests.drawing.bitmap.crosses import KINDS, SHAPE, junction
from tests.drawing.generated import degrees
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError


def as_alpha(ink: np.ndarray) -> Image.Image:
    rgba = np.zeros((*SHAPE, 4), dtype=np.uint8)
    rgba[..., 3] = 255 - ink
    return Image.fromarray(rgba)


def as_white_alpha(ink: np.ndarray) -> Image.Image:
    rgba = np.full((*SHAPE, 4), 255, dtype=np.uint8)
    rgba[..., 3] = 255 - ink
    return Image.fromarray(rgba)


def as_colour(ink: np.ndarray) -> Image.Image:
    rgb = np.stack([np.full_like(ink, 250), np.full_like(ink, 240), ink], axis=2)
    return Image.fromarray(rgb)


def as_coloured_paper(ink: np.ndarray) -> Image.Image:
    share = ink[..., None] / 255
    return Image.fromarray((share * [250, 230, 120] + (1 - share) * [160, 20, 30]).astype(np.uint8))


def as_palette(ink: np.ndarray) -> Image.Image:
    return Image.fromarray(ink).convert("RGB").quantize(16)


def as_16_bit(ink: np.ndarray) -> Image.Image:
    return Image.fromarray(ink.astype(np.uint16) * 257)


def as_shaded(ink: np.ndarray) -> Image.Image:
    y, x = np.mgrid[: SHAPE[0], : SHAPE[1]]
    light = 0.35 + 0.6 * x / SHAPE[1] * (0.6 + 0.4 * y / SHAPE[0])
    return Image.fromarray((light * (40 + ink * 0.82)).astype(np.uint8))


def as_noisy(ink: np.ndarray) -> Image.Image:
    noise = np.random.default_rng(4).normal(0, 14, SHAPE)
    return Image.fromarray(np.clip(20 + ink * 0.85 + noise, 0, 255).astype(np.uint8))


PICTURES: dict[str, Callable[[np.ndarray], Image.Image]] = {
    "grey.png": Image.fromarray,
    "grey.bmp": Image.fromarray,
    "grey.tif": Image.fromarray,
    "lossless.webp": lambda ink: Image.fromarray(ink).convert("RGB"),
    "photo.jpg": Image.fromarray,
    "one-bit.png": lambda ink: Image.fromarray(ink > 127),
    "inverted.png": lambda ink: Image.fromarray(255 - ink),
    "alpha.png": as_alpha,
    "white-alpha.png": as_white_alpha,
    "yellow-on-white.png": as_colour,
    "red-on-yellow.png": as_coloured_paper,
    "palette.png": as_palette,
    "cmyk.jpg": lambda ink: Image.fromarray(ink).convert("CMYK"),
    "sixteen.png": as_16_bit,
    "sixteen.tif": as_16_bit,
    "float.tif": lambda ink: Image.fromarray(ink.astype(np.float32) / 255),
    "shaded.png": as_shaded,
    "noisy.png": as_noisy,
}


@pytest.mark.parametrize("name", PICTURES)
def test_every_kind_of_picture_gives_the_same_crossing(name, ink, tmp_path):
    path = tmp_path / name
    PICTURES[name](ink).save(path)
    drawing, _ = trace(path, TracingConfig(), 40.0)
    assert degrees(drawing) == KINDS
    reference = tmp_path / "reference.png"
    Image.fromarray(ink).save(reference)
    expected, _ = trace(reference, TracingConfig(), 40.0)
    assert np.linalg.norm(junction(drawing) - junction(expected)) < 0.6


def test_uneven_paper_and_light_ink_are_reported(ink, tmp_path):
    as_shaded(ink).save(tmp_path / "shaded.png")
    Image.fromarray(255 - ink).save(tmp_path / "inverted.png")
    codes = [
        {finding.code for finding in trace(tmp_path / name, TracingConfig(), 40.0)[1]}
        for name in ("shaded.png", "inverted.png")
    ]
    assert "uneven-paper" in codes[0]
    assert "light-on-dark" in codes[1]


def test_a_rotated_photo_is_traced_upright(ink, tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(np.rot90(ink)).save(tmp_path / "turned.jpg", exif=exif, quality=95)
    drawing, _ = trace(tmp_path / "turned.jpg", TracingConfig(), 40.0)
    Image.fromarray(ink).save(tmp_path / "upright.png")
    expected, _ = trace(tmp_path / "upright.png", TracingConfig(), 40.0)
    assert np.abs(drawing.bounds_mm[1] - expected.bounds_mm[1]).max() < 0.1


@pytest.mark.parametrize("content", [b"", b"not an image", b"\x89PNG\r\n\x1a\n"])
def test_what_is_no_image_is_refused(content, tmp_path):
    (tmp_path / "broken.png").write_bytes(content)
    with pytest.raises(DrawingError):
        trace(tmp_path / "broken.png", TracingConfig(), 40.0)


@pytest.mark.parametrize("suffix", ["png", "jpg", "tif", "webp", "bmp"])
def test_a_truncated_file_is_refused(suffix, ink, tmp_path):
    path = tmp_path / f"cut.{suffix}"
    Image.fromarray(ink).save(path)
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(DrawingError, match=r"cut off|no image"):
        trace(path, TracingConfig(), 40.0)


def test_a_decompression_bomb_is_never_decoded(tmp_path):
    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")

    header = (100_000).to_bytes(4, "big") * 2 + bytes([8, 0, 0, 0, 0])
    (tmp_path / "bomb.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", b""))
    with pytest.raises(DrawingError, match="million"):
        trace(tmp_path / "bomb.png", TracingConfig(), 40.0)


def test_the_pixel_limit_is_the_config_s(ink, tmp_path):
    Image.fromarray(ink).save(tmp_path / "cross.png")
    with pytest.raises(DrawingError, match="pixel_limit"):
        trace(tmp_path / "cross.png", TracingConfig(pixel_limit=50_000), 40.0)
