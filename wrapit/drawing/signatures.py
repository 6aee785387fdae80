"""What a file seems to be by its name or first bytes, and how its program exports what can be read."""

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
    (b"BM", "BMP"),
    (b"AC10", "AutoCAD DWG"),
    (b"CSFCHUNK", "Clip Studio"),
    (b"PDN3", "Paint.NET"),
    (b"\x00\xffKA", "Affinity"),
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

# The kinds of those names whose bytes tell less: Illustrator writes PDF, Krita and others ZIP.
_SUFFIXES = {
    ".heic": "HEIC", ".heif": "HEIC", ".avif": "AVIF", ".jxl": "JPEG XL", ".jp2": "JPEG 2000",
    ".pdf": "PDF", ".eps": "PostScript (EPS)", ".ps": "PostScript (EPS)", ".ai": "Illustrator",
    ".dxf": "DXF", ".dwg": "AutoCAD DWG", ".cdr": "CorelDRAW",
    ".psd": "Photoshop (PSD)", ".psb": "Photoshop (PSD)", ".xcf": "GIMP (XCF)", ".kra": "Krita",
    ".procreate": "Procreate", ".clip": "Clip Studio", ".pdn": "Paint.NET", ".fig": "Figma",
    ".sketch": "Sketch", ".afdesign": "Affinity", ".afphoto": "Affinity", ".af": "Affinity",
    ".odg": "LibreOffice Draw", ".docx": "Word", ".doc": "Word", ".pptx": "PowerPoint",
    ".excalidraw": "Excalidraw", ".wmf": "Windows metafile", ".emf": "Windows metafile",
    ".dng": "raw photo", ".cr2": "raw photo", ".cr3": "raw photo", ".nef": "raw photo",
    ".arw": "raw photo", ".ico": "Windows icon", ".webarchive": "HTML", ".html": "HTML", ".htm": "HTML",
    ".mp4": "video", ".mov": "video", ".webm": "video", ".zip": "ZIP",
    ".lbrn": "LightBurn", ".lbrn2": "LightBurn", ".stl": "solid", ".step": "solid", ".3mf": "solid",
}  # fmt: skip
_PLAIN_SVG = "open it in Inkscape and save it as Plain SVG (File > Save As)"
_EXPORT_PNG = "export it as PNG (File > Export)"
# In the words of the programs' own menus.
_EXPORTS = {
    "HEIC": "in the phone's share menu or in Photos, export it as JPEG",
    "AVIF": "open it in a browser or drawing program and save it as PNG or JPEG",
    "JPEG XL": "open it in GIMP and export it as PNG (File > Export As)",
    "JPEG 2000": "open it in GIMP and export it as PNG (File > Export As)",
    "PDF": f"{_PLAIN_SVG}, or export the page as PNG",
    "PostScript (EPS)": f"{_PLAIN_SVG}, or in Illustrator save it as SVG (File > Save As)",
    "Illustrator": "in Illustrator choose File > Save As, SVG, and untick 'Preserve Illustrator Editing "
    "Capabilities'; or File > Export > Export As, PNG",
    "gzip-compressed": "unpack it, or if it is a compressed SVG, name it .svgz",
    "DXF": _PLAIN_SVG,
    "AutoCAD DWG": "in the CAD program export it as PDF or DXF, then " + _PLAIN_SVG,
    "CorelDRAW": "in CorelDRAW choose File > Export, SVG or PNG",
    "Photoshop (PSD)": "in Photoshop choose File > Export > Export As, PNG",
    "GIMP (XCF)": "in GIMP choose File > Export As and name it .png",
    "Krita": "in Krita choose File > Export, PNG",
    "Procreate": "in Procreate choose Actions > Share > PNG",
    "Clip Studio": "in Clip Studio choose File > Export (Single Layer), PNG",
    "Paint.NET": "in Paint.NET choose File > Save As, PNG",
    "Figma": "in Figma select the drawing and choose Export, SVG or PNG",
    "Sketch": "in Sketch select the drawing and choose Export, SVG or PNG",
    "Affinity": "in Affinity choose File > Export, SVG or PNG",
    "LibreOffice Draw": "in LibreOffice Draw choose File > Export, SVG or PNG",
    "Word": "in Word right-click the picture and choose Save as Picture, PNG or SVG",
    "PowerPoint": "in PowerPoint right-click the picture and choose Save as Picture, PNG or SVG",
    "Excalidraw": "in Excalidraw choose Export image, SVG",
    "Windows metafile": _PLAIN_SVG,
    "Windows icon": "open it in GIMP and export its largest picture as PNG (File > Export As)",
    "raw photo": "in the camera's or phone's Photos program, export it as JPEG",
    "HTML": "save the picture itself, not the page around it (in Canva: Share > Download, PNG or SVG)",
    "video": "pause it, take a screenshot and crop that to the drawing",
    "ZIP": "unpack it and use the PNG, JPEG or SVG file in it",
    "LightBurn": "in LightBurn choose File > Export, SVG",
    "solid": "a flat drawing is needed: " + _EXPORT_PNG + " or as SVG from the CAD program's sketch",
}
# The remedy for all others.
_SAVE_AS = "save it as PNG, JPEG, BMP, TIFF or WebP"


def kind_by_name(suffix: str) -> str | None:
    """The kind of file with this suffix, of those that can't be read but exported otherwise.

    >>> kind_by_name(".ai")
    'Illustrator'
    """
    return _SUFFIXES.get(suffix.lower())


def export_of(kind: str | None) -> str:
    """How a file of this kind becomes one that can be read, in the words of the program that made it.

    >>> export_of("GIMP (XCF)")
    'in GIMP choose File > Export As and name it .png'
    """
    return _EXPORTS.get(kind or "", _SAVE_AS)


def kind_of(head: bytes) -> str | None:
    """The name of the format that a file's first bytes tell; nothing where they tell none.

    >>> kind_of(b"%PDF-1.7")
    'PDF'
    """
    for beginning, name in _BEGINNINGS:
        if head.startswith(beginning):
            return "Krita" if name == "ZIP" and b"application/x-krita" in head[:80] else name
    if head[:4] == b"RIFF":
        return "WebP" if head[8:12] == b"WEBP" else "CorelDRAW" if head[8:11] == b"CDR" else "sound or video"
    if head[4:8] == b"ftyp":
        return _BRANDS.get(head[8:12], "video")
    return _kind_of_text(head[:HEAD_BYTES])


def _kind_of_text(head: bytes) -> str | None:
    words = head.replace(b"\0", b"").removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    if words.startswith((b"0\nsection", b"0\r\nsection", b"999\n")) or b"\nsection\n" in words[:64]:
        return "DXF"
    if words.startswith((b"<!doctype html", b"<html")):
        return "HTML"
    if words.startswith((b"<?xml", b"<svg", b"<!doctype svg", b"<!--")) and b"<svg" in words:
        return "SVG"
    return None
