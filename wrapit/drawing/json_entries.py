"""Reads a JSON file and its entries with care: bounded sizes, finite numbers, text that can be written."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from wrapit.errors import DrawingError

# No coordinate or length of a drawing is larger (mm, before scaling).
LARGEST_MM = 1e6
# Under this, a length (mm) is nothing: files hold millionths.
_SMALLEST_MM = 1e-6
# What is too much to be a drawing? A file of 50 MB holds all the Béziers that are allowed twice over, a float
# in full has at most 309 digits before its point, and no reason takes ten thousand characters. Nothing hangs
# on the exact numbers: they bound memory and time, and keep messages readable.
_LARGEST_BYTES = 50_000_000
_LONGEST_NUMBER = 400
_LONGEST_TEXT = 10_000


def load_json(path: Path) -> object:
    """What a JSON file in UTF-8, UTF-16 or UTF-32 holds.

    Raises DrawingError where it can't be read, is too large, or is no strict JSON.
    """
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise DrawingError("the JSON file is larger than 50 MB", str(path), "simplify the drawing")
        data = path.read_bytes()
        text = data.decode(json.detect_encoding(data))
        return json.loads(text, parse_constant=_refuse_word, parse_int=_integer)
    except FileNotFoundError:
        raise DrawingError("no such drawing", str(path), "check its path") from None
    except json.JSONDecodeError as error:
        raise DrawingError(
            f"not valid JSON: {error.msg.lower()}",
            f"{path}:{error.lineno}:{error.colno}",
            "correct it there; the file may be cut off",
        ) from None
    except RecursionError:
        raise DrawingError(
            "lists are nested without end", str(path), "give a drawing.json as a build writes it"
        ) from None
    except UnicodeDecodeError:
        raise DrawingError("the file is no text in UTF-8 or UTF-16", str(path), "save it as UTF-8") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DrawingError(
            f"the drawing can't be read ({reason})", str(path), "give a JSON text file"
        ) from None


def _refuse_word(word: str) -> float:
    raise ValueError(f"{word} is no coordinate")


def _integer(digits: str) -> int:
    if len(digits) > _LONGEST_NUMBER:
        raise ValueError(f"a number has {len(digits)} digits")
    return int(digits)


def number(value: object, largest: float = LARGEST_MM) -> float:
    """A number between -`largest` and `largest`. Raises ValueError for anything else, true and false too."""
    if not is_number(value, largest):
        raise ValueError(f"{shown(value)} is no number between {-largest:g} and {largest:g}")
    return float(value)  # type: ignore[arg-type]  # is_number has told that it is one


def positive(value: object, largest: float = LARGEST_MM) -> float:
    """A number above nothing, up to `largest`. Raises ValueError for anything else."""
    if not is_number(value, largest) or not float(value) >= _SMALLEST_MM:  # type: ignore[arg-type]  # as above
        raise ValueError(f"{shown(value)} is not a positive number up to {largest:g}")
    return float(value)  # type: ignore[arg-type]  # as above


def is_number(value: object, largest: float = LARGEST_MM) -> bool:
    """Whether a JSON value is a number of at most this size."""
    # Compared, not converted: an integer may be too large to become a float.
    return isinstance(value, int | float) and not isinstance(value, bool) and -largest <= value <= largest


def words(value: object) -> str:
    """A text that can be written to a file. Raises ValueError for anything else."""
    if not isinstance(value, str):
        raise ValueError(f"{shown(value)} is no text")
    if len(value) > _LONGEST_TEXT:
        raise ValueError(f"a text has more than {_LONGEST_TEXT} characters")
    if any("\ud800" <= letter <= "\udfff" for letter in value):
        raise ValueError(f"{shown(value)} holds half a character (a lone surrogate)")
    return value


def block(value: object) -> dict[str, Any]:
    """A block of named values. Raises ValueError for anything else."""
    if not isinstance(value, dict):
        raise ValueError(f"{shown(value)} is no block of names and values")
    return value


def pair(value: object) -> tuple[float, float]:
    """A place [x, y]. Raises ValueError for anything else."""
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError(f"{shown(value)} is no place [x, y]")
    return number(value[0]), number(value[1])


def shown(value: Any) -> str:
    """A value for a message, cut short and without characters that can't be printed."""
    text = ascii(value) if isinstance(value, str) else str(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
