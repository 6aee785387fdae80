"""Loads a bitmap as one grey image: dark ink on light paper, whatever the file holds."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.grey import GreyImage, count_levels, grey_of, is_light_on_dark
from wrapit.drawing.signatures import HEAD_BYTES, kind_of
from wrapit.errors import DrawingError

__all__ = ["FORMATS", "GreyImage", "count_levels", "load_grey"]

# What a file may hold, whatever its name says: Pillow would start other programs for some others.
FORMATS = ("PNG", "JPEG", "BMP", "TIFF", "WEBP", "GIF")
_SAVE_AS = "save it as PNG, JPEG, BMP, TIFF or WebP"


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
        return DrawingError("the file is no image that can be read", str(path), _SAVE_AS)
    if kind.upper() in FORMATS:
        return DrawingError(
            f"the file is no image that can be read: it starts as {kind} and is damaged",
            str(path),
            "it may be cut off; save or scan it again",
        )
    return DrawingError(f"the file is no image that can be read but {kind}", str(path), _SAVE_AS)


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
