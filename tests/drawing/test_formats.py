"""Every ordinary kind of picture gives the same drawing; what is no line drawing is refused with a reason."""

from __future__ import annotations

import zlib
from collections.abc import Callable

import numpy as np
import pytest
from PIL import Image

from tests.drawing.generated import render
from tests.drawing.test_bitmaps import degrees
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import ConfigError, DrawingError

SHAPE = (300, 360)
CROSS = [np.array([(40.0, 60), (320, 240)]), np.array([(60.0, 250), (300, 50)])]
KINDS = [1, 1, 1, 1, 4]


@pytest.fixture(scope="module")
def ink() -> np.ndarray:
    return render(CROSS, 9.0, SHAPE)


def junction(drawing: Drawing) -> np.ndarray:
    (index,) = (j for j, ends in enumerate(drawing.half_edges()) if len(ends) == 4)
    frame = drawing.pixel_frame
    assert frame is not None
    return (drawing.junctions[index].point - np.array(frame.origin_mm)) / frame.mm_per_px * [1, -1]


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


@pytest.mark.parametrize(("factor", "width"), [(0.28, 2.2), (1.0, 8.0), (4.0, 60.0)])
def test_size_in_pixels_hardly_matters(factor, width, tmp_path):
    shape = (int(SHAPE[0] * factor), int(SHAPE[1] * factor))
    Image.fromarray(render([curve * factor for curve in CROSS], width, shape)).save(tmp_path / "scaled.png")
    drawing, _ = trace(tmp_path / "scaled.png", TracingConfig(), 40.0)
    assert degrees(drawing) == KINDS
    a, b = CROSS[0] * factor, CROSS[1] * factor
    t = np.linalg.solve(np.column_stack([a[1] - a[0], b[0] - b[1]]), b[0] - a[0])[0]
    assert np.linalg.norm(junction(drawing) - (a[0] + t * (a[1] - a[0]))) < 0.06 * width + 0.1


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


def test_a_bitmap_needs_a_size(ink, tmp_path):
    Image.fromarray(ink).save(tmp_path / "cross.png")
    with pytest.raises(ConfigError, match="size: 40 mm"):
        trace(tmp_path / "cross.png", TracingConfig(), None)


@pytest.mark.parametrize("name", ["missing.png", "missing.svg", "missing.json"])
def test_a_missing_file_is_named(name, tmp_path):
    with pytest.raises(DrawingError, match=name):
        trace(tmp_path / name, TracingConfig(), 40.0)


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


def test_an_unknown_kind_of_file_is_refused(tmp_path):
    (tmp_path / "drawing.pdf").write_bytes(b"%PDF")
    with pytest.raises(DrawingError, match=r"\.pdf"):
        trace(tmp_path / "drawing.pdf", TracingConfig(), 40.0)


def test_a_thin_frame_does_not_make_a_thicker_drawing_a_filled_shape(tmp_path):
    frame = [np.array([(12, 12), (348, 12), (348, 288), (12, 288), (12, 12)], float)]
    picture = np.minimum(render(frame, 4.0, SHAPE), render(CROSS, 11.0, SHAPE))
    path = tmp_path / "framed.png"
    Image.fromarray(picture.astype(np.uint8)).save(path)
    drawing, _ = trace(path, TracingConfig(), 40.0)
    assert len(drawing.segments) == 4  # the cross, without the frame
