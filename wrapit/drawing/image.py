"""Loads a bitmap as one grey image: dark ink on light paper, whatever the file holds."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.errors import DrawingError

GreyImage = NDArray[np.uint8]

# A channel is preferred to plain grey only where it shows the ink this much better.
_CLEARER = 1.6


def load_grey(path: Path, pixel_limit: int) -> tuple[GreyImage, bool]:
    """The image as grey bytes (h, w), dark ink on light paper; and whether it was light on dark.

    Raises DrawingError for a file that is missing, no image, cut off, or larger than `pixel_limit`
    pixels; nothing of such a large image is decoded.
    """
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            # The limit of the config is the one that counts; Pillow's own would only warn.
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(path) as image:
                _check_size(image.size, path, pixel_limit)
                image.load()
                upright = ImageOps.exif_transpose(image)
                grey = _grey(upright)
    except FileNotFoundError:
        raise DrawingError("no such drawing", str(path), "check `drawing:` in the config") from None
    except Image.DecompressionBombError:
        raise DrawingError(
            f"the image is larger than {pixel_limit / 1e6:g} million pixels", str(path), "scale it down"
        ) from None
    except UnidentifiedImageError:
        raise DrawingError(
            "the file is no image that can be read", str(path), "save it as PNG, JPEG, BMP, TIFF or WebP"
        ) from None
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise DrawingError(
            f"the image can't be read ({reason})", str(path), "it may be cut off; save or scan it again"
        ) from None
    light_on_dark = _is_light_on_dark(grey)
    return (255 - grey if light_on_dark else grey), light_on_dark


def _check_size(size: tuple[int, int], path: Path, pixel_limit: int) -> None:
    width, height = size
    if width * height > pixel_limit:
        raise DrawingError(
            f"the image has {width} × {height} pixels, more than the limit of {pixel_limit / 1e6:g} million",
            str(path),
            "scale it down, or raise tracing.pixel_limit",
        )
    if min(width, height) < 8:
        raise DrawingError(f"the image has only {width} × {height} pixels", str(path), "use a larger picture")


def _grey(image: Any) -> GreyImage:
    if image.mode.startswith("I") or image.mode == "F":
        return _bytes_of(np.asarray(image))
    if image.mode == "L":
        return np.asarray(image)
    if image.mode == "1":
        return np.asarray(image.convert("L"))
    if image.mode in ("LA", "La", "PA", "RGBA", "RGBa") or "transparency" in image.info:
        return _flattened(np.asarray(image.convert("RGBA")))
    return _best_channel(np.asarray(image.convert("RGB")))


def _bytes_of(values: NDArray[Any]) -> GreyImage:
    """Bytes of a deeper image: 16 bits by their range, floats and 32 bits by what they hold."""
    numbers = values.astype(np.float32)
    if not np.isfinite(numbers).all():
        numbers = np.nan_to_num(numbers, nan=0.0, posinf=0.0, neginf=0.0)
    low, high = float(numbers.min()), float(numbers.max())
    if low >= 0 and high <= 255 and values.dtype.kind in "iu":
        low, high = 0.0, 255.0
    elif low >= 0 and high <= 65535 and values.dtype.kind in "iu":
        low, high = 0.0, 65535.0
    return ((numbers - low) * (255.0 / max(high - low, 1e-9)) + 0.5).astype(np.uint8)


def _flattened(rgba: NDArray[np.uint8]) -> GreyImage:
    """Transparent images on the paper that shows their ink best.

    Where everything visible has one colour, the opacity itself is the ink.
    """
    alpha = rgba[..., 3]
    if alpha.min() == 255:
        return _best_channel(rgba[..., :3])
    visible = alpha > 127
    if not visible.any():
        return np.full(alpha.shape, 255, dtype=np.uint8)
    shown = rgba[..., :3][visible]
    if (np.percentile(shown, 95, axis=0) - np.percentile(shown, 5, axis=0)).max() < 48:
        return 255 - alpha
    paper = 0.0 if shown.mean() > 127 and visible.mean() < 0.5 else 255.0
    share = alpha[..., None].astype(np.float32) / 255
    return _best_channel((rgba[..., :3] * share + paper * (1 - share) + 0.5).astype(np.uint8))


def _best_channel(rgb: NDArray[np.uint8]) -> GreyImage:
    """Plain grey, or the darkest (lightest) channel where coloured ink shows much better in it."""
    luma = (rgb @ np.array([0.299, 0.587, 0.114], dtype=np.float32) + 0.5).astype(np.uint8)
    light_on_dark = _is_light_on_dark(luma)
    extreme = rgb.max(axis=2) if light_on_dark else rgb.min(axis=2)
    choices = [luma, extreme, *(np.ascontiguousarray(rgb[..., k]) for k in range(3))]
    contrast = [_contrast(choice) for choice in choices]
    best = int(np.argmax(contrast))
    return choices[best] if contrast[best] > _CLEARER * contrast[0] else luma


def _contrast(grey: GreyImage) -> float:
    """How far the ends of the histogram are apart, forgetting single pixels."""
    shares = np.cumsum(count_levels(grey)) / grey.size
    return float(np.searchsorted(shares, 0.995) - np.searchsorted(shares, 0.005))


def count_levels(grey: GreyImage) -> NDArray[np.int64]:
    """How many pixels have each of the 256 levels; Pillow counts bytes much faster than numpy."""
    from PIL import Image

    return np.array(Image.fromarray(np.ascontiguousarray(grey)).histogram(), dtype=np.int64)


def _is_light_on_dark(grey: GreyImage) -> bool:
    """Whether the rim of the picture, where paper is, is darker than the middle of its range."""
    rim = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
    thinned = grey[::3, ::3]
    shares = np.cumsum(np.bincount(thinned.ravel(), minlength=256)) / thinned.size
    low, high = np.searchsorted(shares, 0.002), np.searchsorted(shares, 0.998)
    return bool(np.median(rim) < (low + high) / 2)
