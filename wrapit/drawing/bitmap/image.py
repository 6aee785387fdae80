"""Loads a bitmap as one grey image: dark ink on light paper, whatever the file holds.

Colours become grey in bands, to save memory: a large picture takes four bytes a pixel decoded and one as
the grey result; whole intermediate pictures in colour or in floating point would take several times that.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.signatures import HEAD_BYTES, export_of, kind_of
from wrapit.errors import DrawingError

GreyImage: TypeAlias = NDArray[np.uint8]
# The same picture anew each time it is called: slices of rows, and those rows (n, w, 3) or (n, w, 4).
_Bands: TypeAlias = Callable[[], Iterator[tuple[slice, NDArray[Any]]]]

# What a file may hold, whatever its name says: Pillow would start other programs for some others.
FORMATS = ("PNG", "JPEG", "BMP", "TIFF", "WEBP", "GIF")
# No drawing has fewer pixels a side: a stroke of four would fill it.
_SMALLEST_PX = 8
# When is one channel better than plain grey? Where it shows the ink this much better, as yellow on white,
# whose contrast in blue is nine times that of its grey; black ink shows alike in all, noise included.
_CLEARER = 1.6
# When are other levels than the paper's counted alone? From a half of all pixels on it takes as long as all.
_MOSTLY_ONE = 0.3
# How much is worked out at a time? Beside a picture of 25 million pixels 4 to 28 bytes a pixel are taken,
# by its mode; bands of 500 pixels give the same bytes.
_BAND_PIXELS = 1_000_000


def load_grey(path: Path, pixel_limit: int) -> tuple[GreyImage, bool]:
    """The image as grey bytes (h, w), dark ink on light paper; and whether it was light on dark.

    Raises DrawingError for a file that is missing, no image, cut off, or larger than `pixel_limit`
    pixels; nothing of such a large image is decoded.
    """
    grey = _decoded(path, pixel_limit)
    light_on_dark = is_light_on_dark(grey)
    return (255 - grey if light_on_dark else grey), light_on_dark


def _decoded(path: Path, pixel_limit: int) -> NDArray[np.uint8]:
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            # The limit of the config is the one that counts, and what a damaged file's tags hold is
            # of no use to anybody; what can't be read is an error all the same.
            warnings.simplefilter("ignore")
            with Image.open(path, formats=FORMATS) as image:
                _check_size(image.size, path, pixel_limit)
                image.load()
                # In place: a copy of a large picture takes four bytes a pixel.
                ImageOps.exif_transpose(image, in_place=True)
                return grey_of(image)
    except FileNotFoundError:
        raise DrawingError("no such drawing", str(path), "check its path") from None
    except Image.DecompressionBombError:
        raise DrawingError(
            f"the image is larger than {pixel_limit / 1e6:g} million pixels", str(path), "scale it down"
        ) from None
    except UnidentifiedImageError:
        raise _no_image(path) from None
    except MemoryError:
        raise DrawingError("the image takes more memory than there is", str(path), "scale it down") from None
    except (OSError, SyntaxError, ValueError, EOFError, ArithmeticError, LookupError, TypeError) as error:
        raise DrawingError(
            f"the image can't be read ({_reason(error)})",
            str(path),
            "it may be cut off; save or scan it again",
        ) from None


def _reason(error: Exception) -> str:
    return (getattr(error, "strerror", None) or str(error)).lower() or "its data is damaged"


def _no_image(path: Path) -> DrawingError:
    """The refusal of a file that none of the formats fits, with what it seems to be instead."""
    try:
        with path.open("rb") as file:
            head = file.read(HEAD_BYTES)
    except OSError as error:
        return DrawingError(f"the image can't be read ({_reason(error)})", str(path), "check the file")
    kind = kind_of(head)
    if not head:
        return DrawingError("the file is empty", str(path), "save or scan it again")
    if kind == "SVG":
        return DrawingError("the file is no image but an SVG drawing", str(path), "name it .svg")
    if kind is None:
        return DrawingError("the file is no image that can be read", str(path), export_of(None))
    if kind.upper() in FORMATS:
        return DrawingError(
            f"the file is no image that can be read: it starts as {kind} and is damaged",
            str(path),
            "it may be cut off; save or scan it again",
        )
    return DrawingError(f"the file is no image that can be read but {kind}", str(path), export_of(kind))


def _check_size(size: tuple[int, int], path: Path, pixel_limit: int) -> None:
    width, height = size
    if width * height > pixel_limit:
        raise DrawingError(
            f"the image has {width} × {height} pixels, more than the limit of {pixel_limit / 1e6:g} million",
            str(path),
            "scale it down, or raise tracing.pixel_limit",
        )
    if min(width, height) < _SMALLEST_PX:
        raise DrawingError(f"the image has only {width} × {height} pixels", str(path), "use a larger picture")


def grey_of(image: Any) -> GreyImage:
    """A decoded Pillow image of any mode as grey bytes (h, w), its ink as clear as it can be shown."""
    if image.mode.startswith("I") or image.mode == "F":
        return _bytes_of(_bands(image))
    if image.mode == "L":
        return np.asarray(image)
    if image.mode == "1":
        return np.asarray(image.convert("L"))
    shape = (image.height, image.width)
    if image.mode in ("LA", "La", "PA", "RGBA", "RGBa") or "transparency" in image.info:
        return _flattened(_bands(image, "RGBA"), shape)
    return _best_channel(_bands(image, "RGB"), shape)


def count_levels(grey: GreyImage) -> NDArray[np.int64]:
    """How many pixels have each of the 256 levels; Pillow counts bytes much faster than numpy."""
    from PIL import Image

    # Counting one level many times over is slow, and plain paper is nearly all of one.
    paper = grey[0, 0]
    other = grey != paper
    rest = np.count_nonzero(other)
    few = 0 < rest < _MOSTLY_ONE * grey.size
    counted = grey[other][None] if few else np.ascontiguousarray(grey)
    counts = np.array(Image.fromarray(counted).histogram(), dtype=np.int64)
    if few:
        counts[paper] = grey.size - rest
    return counts


def is_light_on_dark(grey: GreyImage) -> bool:
    """Whether the rim of the picture, where paper is, is darker than the middle of its range."""
    rim = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
    thinned = grey[::3, ::3]
    shares = np.cumsum(count_levels(thinned)) / thinned.size
    low, high = np.searchsorted(shares, 0.002), np.searchsorted(shares, 0.998)
    return bool(np.median(rim) < (low + high) / 2)


def bands_of(shape: tuple[int, ...], step: int = 1) -> Iterator[slice]:
    """Slices of rows, each of about a million pixels and a multiple of `step` rows, that make the whole."""
    rows = max(1, _BAND_PIXELS // max(shape[1], 1) // step) * step
    for top in range(0, shape[0], rows):
        yield slice(top, min(top + rows, shape[0]))


def _bands(image: Any, mode: str | None = None) -> _Bands:
    width, height = image.size

    def bands() -> Iterator[tuple[slice, NDArray[Any]]]:
        for rows in bands_of((height, width)):
            band = image.crop((0, rows.start, width, rows.stop))
            # Pillow knows no direct way from premultiplied grey to colours.
            band = band.convert("LA") if band.mode == "La" else band
            yield rows, np.asarray(band if mode is None else band.convert(mode))

    return bands


def _bytes_of(bands: _Bands) -> GreyImage:
    """Bytes of a deeper image: 16 bits by their range, floats and 32 bits by what they hold."""
    low, high, whole, parts = np.inf, -np.inf, True, []
    for _, values in bands():
        numbers = _finite(values)
        low, high = min(low, float(numbers.min())), max(high, float(numbers.max()))
        whole = values.dtype.kind in "iu"
    if low >= 0 and high <= 255 and whole:
        low, high = 0.0, 255.0
    elif low >= 0 and high <= 65535 and whole:
        low, high = 0.0, 65535.0
    for _, values in bands():
        parts.append(((_finite(values) - low) * (255.0 / max(high - low, 1e-9)) + 0.5).astype(np.uint8))
    return np.concatenate(parts)


def _finite(values: NDArray[Any]) -> NDArray[np.float32]:
    return np.nan_to_num(values.astype(np.float32), nan=0.0, posinf=0.0, neginf=0.0)


def _flattened(rgba: _Bands, shape: tuple[int, int]) -> GreyImage:
    """Transparent images on the paper that shows their ink best.

    Where everything visible has one colour, the opacity itself is the ink.
    """
    alpha = np.empty(shape, dtype=np.uint8)
    shown = np.zeros((3, 256), dtype=np.int64)
    for rows, band in rgba():
        alpha[rows] = band[..., 3]
        visible = band[..., 3] > 127
        for channel in range(3):
            shown[channel] += np.bincount(band[..., channel][visible], minlength=256)
    if alpha.min() == 255:
        del alpha
        return _best_channel(lambda: ((rows, band[..., :3]) for rows, band in rgba()), shape)
    count = int(shown[0].sum())
    if not count:
        return np.full(shape, 255, dtype=np.uint8)
    if max(_level(levels, 0.95) - _level(levels, 0.05) for levels in shown) < 48:
        return 255 - alpha
    del alpha
    mean = float((shown * np.arange(256)).sum()) / (3 * count)
    paper = 0.0 if mean > 127 and count / (shape[0] * shape[1]) < 0.5 else 255.0

    def flat() -> Iterator[tuple[slice, NDArray[Any]]]:
        for rows, band in rgba():
            share = band[..., 3:].astype(np.float32) / 255
            yield rows, (band[..., :3] * share + paper * (1 - share) + 0.5).astype(np.uint8)

    return _best_channel(flat, shape)


def _level(levels: NDArray[np.int64], share: float) -> float:
    """The level that this share of the counted pixels doesn't exceed, between two levels if need be."""
    total = np.cumsum(levels)
    at = share * (int(total[-1]) - 1)
    below, above = (int(np.searchsorted(total, place, side="right")) for place in (np.floor(at), np.ceil(at)))
    return below + (above - below) * (at - float(np.floor(at)))


def _best_channel(rgb: _Bands, shape: tuple[int, int]) -> GreyImage:
    """Plain grey, or the darkest (lightest) channel where coloured ink shows much better in it."""
    luma = np.empty(shape, dtype=np.uint8)
    # Of the darkest, the lightest and each single channel.
    counts = np.zeros((5, 256), dtype=np.int64)
    for rows, band in rgb():
        luma[rows] = (band @ np.array([0.299, 0.587, 0.114], dtype=np.float32) + 0.5).astype(np.uint8)
        for number in range(5):
            counts[number] += count_levels(_channel(band, number))
    extreme = 1 if is_light_on_dark(luma) else 0
    choices = [extreme, 2, 3, 4]
    plain = _contrast(count_levels(luma))
    contrast = [_contrast(counts[choice]) for choice in choices]
    best = int(np.argmax(contrast))
    if contrast[best] <= _CLEARER * plain:
        return luma
    for rows, band in rgb():
        luma[rows] = _channel(band, choices[best])
    return luma


def _channel(rgb: NDArray[np.uint8], number: int) -> NDArray[np.uint8]:
    """The darkest (0), the lightest (1), or red, green or blue (2, 3, 4) of each pixel."""
    if number < 2:
        darkest: NDArray[np.uint8] = rgb.max(axis=2) if number else rgb.min(axis=2)
        return darkest
    return rgb[..., number - 2]


def _contrast(levels: NDArray[np.int64]) -> float:
    """How far the ends of the histogram are apart, forgetting single pixels."""
    shares = np.cumsum(levels) / levels.sum()
    return float(np.searchsorted(shares, 0.995) - np.searchsorted(shares, 0.005))
