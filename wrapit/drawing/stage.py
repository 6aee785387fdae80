"""The verb of this stage: trace a drawing."""

from __future__ import annotations

import stat
from pathlib import Path

from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.signatures import HEAD_BYTES, export_of, kind_by_name, kind_of
from wrapit.errors import ConfigError, DrawingError, Finding

# What Pillow reads without starting another program.
BITMAPS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp", ".gif")
# What are readable files called whose names say something else?
_NAMES = {
    "PNG": ".png", "JPEG": ".jpg", "GIF": ".gif", "TIFF": ".tif", "BMP": ".bmp", "WebP": ".webp",
    "SVG": ".svg",
}  # fmt: skip
# How much of a path is shown where the path itself is at fault? Enough to know it by, on one screen.
_LONGEST_PLACE = 200


def trace(path: Path, tracing: TracingConfig, size_mm: float | None) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, SVG or JSON file, and what the maker should know about it.

    `size_mm` is the longest side of the piece; bitmaps need it. Raises ConfigError where it is
    missing, DrawingError where the file can't be read or is no line drawing.
    """
    _refuse_no_file(path)
    suffix = path.suffix.lower()
    if suffix == ".json":
        from wrapit.drawing.json_file import read_drawing

        return read_drawing(path, size_mm), ()
    if suffix in (".svg", ".svgz"):
        from wrapit.drawing.svg.stage import trace_svg

        return trace_svg(path, tracing, size_mm)
    if suffix not in BITMAPS:
        raise _of_other_kind(path, suffix)
    if size_mm is None:
        raise ConfigError("a bitmap has no size of its own", "size", "add `size: 40 mm` to the config")
    from wrapit.drawing.bitmap.stage import trace_bitmap

    return trace_bitmap(path, tracing, size_mm)


def _of_other_kind(path: Path, suffix: str) -> DrawingError:
    """The refusal of a file by its name, or where that tells nothing by its first bytes."""
    kind = kind_by_name(suffix)
    if kind is not None:
        return DrawingError(f"{suffix} files ({kind}) can't be read", str(path), export_of(kind))
    try:
        with path.open("rb") as file:
            kind = kind_of(file.read(HEAD_BYTES))
    except OSError:
        # Its name alone is reason enough.
        kind = None
    problem = f"unknown kind of drawing {suffix[:40]!r}"
    if kind in _NAMES:
        return DrawingError(f"{problem}: the file is {kind}", str(path), f"name it {_NAMES[kind]}")
    if kind is not None:
        return DrawingError(f"{problem}: the file is {kind}", str(path), export_of(kind))
    return DrawingError(problem, str(path), "use .png, .jpg, .bmp, .tif, .webp, .svg or .json")


def _refuse_no_file(path: Path) -> None:
    """Only ordinary files are opened: reading a pipe or a device may never end."""
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise DrawingError("no such drawing", str(path), "check its path") from None
    except (OSError, ValueError) as error:
        # Too long a name, no permission, links in a circle, a null character or half a character.
        reason = getattr(error, "strerror", None) or str(error) or "the system gives no reason"
        where = ascii(str(path))[1:-1]
        raise DrawingError(
            f"the drawing can't be reached ({reason.lower()})",
            where if len(where) <= _LONGEST_PLACE else f"{where[:_LONGEST_PLACE]}…",
            "check its path",
        ) from None
    if not stat.S_ISREG(mode):
        kind = "a folder" if stat.S_ISDIR(mode) else "a pipe or a device"
        raise DrawingError(f"the drawing is no file but {kind}", str(path), "give the path of a picture")
