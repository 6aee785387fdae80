"""What may be read: the page, files of the last good build by their names, and the drawing; nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from starlette.responses import FileResponse, PlainTextResponse, Response

from wrapit.pipeline.output.ownership import REPORT, is_plain_file, is_plain_name

PAGE: Final = Path(__file__).parent / "page"
"""The page's own files."""
_TYPES: Final = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".json": "application/json",
    ".yaml": "text/plain; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".bmp": "image/bmp",
    ".tif": "image/tiff",
    ".tiff": "image/tiff",
    ".webp": "image/webp",
    ".pdf": "application/pdf",
    ".stl": "model/stl",
    ".3mf": "model/3mf",
}
_ALONE: Final = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'; sandbox"
)
"""What a picture may do that somebody else drew: be looked at."""
_POLICIES: Final = {
    # The guide's few lines of script are its own; it runs as nobody's page and can't ask us for anything.
    ".html": (
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; "
        "frame-ancestors 'self'; sandbox allow-scripts allow-modals"
    ),
    # A sandbox would keep browsers from showing it at all.
    ".pdf": "frame-ancestors 'self'",
}
_DRAWINGS: Final = frozenset({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp", ".svg", ".json"})
"""What a drawing's file ends in; a config that names anything else, or a link to it, shows nothing."""


def page_file(name: str) -> Response:
    """A file of the page."""
    path = PAGE / name
    if not path.is_file():
        return not_there()
    return FileResponse(path, headers={"Content-Type": _TYPES[path.suffix]})


def built_file(folder: Path | None, names: object, name: str) -> Response:
    """A file of an output folder, if `names` has it and it is a file itself, no link."""
    plain = name == REPORT or is_plain_name(name)
    if folder is None or not plain or not isinstance(names, dict) or name not in names:
        return not_there()
    return _file(folder / name) if is_plain_file(folder / name) else not_there()


def drawing_file(path: Path | None) -> Response:
    """The drawing."""
    if path is None:
        return not_there()
    real = path.resolve()
    known = {path.suffix.lower(), real.suffix.lower()} <= _DRAWINGS
    return _file(real) if known and real.is_file() else not_there()


def not_there() -> Response:
    """For all that there isn't, and all that may not be seen."""
    return PlainTextResponse("there is no such file here\n", 404)


def _file(path: Path) -> Response:
    suffix = path.suffix.lower()
    kind = _TYPES.get(suffix, "application/octet-stream")
    headers = {"Content-Type": kind, "Content-Security-Policy": _POLICIES.get(suffix, _ALONE)}
    return FileResponse(path, headers=headers)
