"""The verb of this stage: trace a drawing."""

from __future__ import annotations

from pathlib import Path

from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.errors import ConfigError, DrawingError, Finding

BITMAPS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp", ".gif")


def trace(path: Path, tracing: TracingConfig, size_mm: float | None) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, SVG or JSON file, and what the maker should know about it.

    `size_mm` is the longest side of the piece; bitmaps need it. Raises ConfigError where it is
    missing, DrawingError where the file can't be read or is no line drawing.
    """
    if not path.exists():
        raise DrawingError("no such drawing", str(path), "check `drawing:` in the config")
    if not path.is_file():
        raise DrawingError("the drawing is no file", str(path), "give the path of a picture")
    suffix = path.suffix.lower()
    if suffix == ".json":
        from wrapit.drawing.files import read_drawing

        return read_drawing(path, size_mm), ()
    if suffix == ".svg":
        from wrapit.drawing.svg import trace_svg

        return trace_svg(path, tracing, size_mm)
    if suffix not in BITMAPS:
        raise DrawingError(
            f"unknown kind of drawing {suffix!r}",
            str(path),
            "use .png, .jpg, .bmp, .tif, .webp, .svg or .json",
        )
    if size_mm is None:
        raise ConfigError("a bitmap has no size of its own", "size", "add `size: 40 mm` to the config")
    from wrapit.drawing.bitmap import trace_bitmap

    return trace_bitmap(path, tracing, size_mm)
