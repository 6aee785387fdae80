"""What a file seems to be by its first bytes, so that a refusal can say it."""

from __future__ import annotations

# The longest beginning that `kind_of` looks at.
HEAD_BYTES = 512

# As each format's own specification has them.
_BEGINNINGS: tuple[tuple[bytes, str], ...] = (
    (b"\x89PNG\r\n\x1a\n", "PNG"),
    (b"\xff\xd8\xff", "JPEG"),
    (b"GIF8", "GIF"),
    (b"II*\x00", "TIFF"),
    (b"MM\x00*", "TIFF"),
    (b"%!PS", "PostScript (EPS)"),
    (b"\xc5\xd0\xd3\xc6", "PostScript (EPS)"),
    (b"%PDF", "PDF"),
    (b"8BPS", "Photoshop (PSD)"),
    (b"gimp xcf", "GIMP (XCF)"),
    (b"\x00\x00\x00\x0cJXL ", "JPEG XL"),
    (b"\xff\x0a", "JPEG XL"),
    (b"\x00\x00\x00\x0cjP  ", "JPEG 2000"),
    (b"\xff\x4f\xff\x51", "JPEG 2000"),
    (b"\x00\x00\x01\x00", "Windows icon"),
    (b"\x1f\x8b", "gzip-compressed"),
    (b"PK\x03\x04", "ZIP"),
    (b"\xd7\xcd\xc6\x9a", "Windows metafile"),
    (b"AC10", "AutoCAD DWG"),
)
# The brands of the box format that cameras and browsers write (ISO 14496-12 and 23008-12).
_BRANDS = {
    b"avif": "AVIF",
    b"avis": "AVIF",
    b"heic": "HEIC",
    b"heix": "HEIC",
    b"hevc": "HEIC",
    b"mif1": "HEIC",
    b"msf1": "HEIC",
}


def kind_of(head: bytes) -> str | None:
    """The name of the format that a file's first bytes tell; nothing where they tell none.

    >>> kind_of(b"%PDF-1.7")
    'PDF'
    """
    for beginning, name in _BEGINNINGS:
        if head.startswith(beginning):
            return name
    if head[:4] == b"RIFF" and head[8:12] == b"WEBP":
        return "WebP"
    if head[4:8] == b"ftyp":
        return _BRANDS.get(head[8:12], "video")
    return _kind_of_text(head[:HEAD_BYTES])


def _kind_of_text(head: bytes) -> str | None:
    words = head.replace(b"\0", b"").removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    if words.startswith((b"<!doctype html", b"<html")):
        return "HTML"
    if words.startswith((b"<?xml", b"<svg", b"<!doctype svg", b"<!--")) and b"<svg" in words:
        return "SVG"
    return None
