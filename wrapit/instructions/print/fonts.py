"""The print's letters: embedded, so that the PDF looks the same everywhere."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path
from typing import Final

# Bitstream Vera comes with reportlab and has western letters; DejaVu is the same design with those of most
# scripts, and comes with matplotlib, which takes a sixth of a second to load: only names that need it wait.
VERA: Final = ("Vera.ttf", "VeraBd.ttf")
DEJAVU: Final = ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf")


def letters_for(texts: Iterable[str]) -> tuple[str, str, frozenset[str]]:
    """A plain and a bold font that have all letters of these texts, and the letters that none has."""
    wanted = frozenset("".join(texts)) - {"\n"}
    if not _missing(VERA[0], wanted):
        return (*_registered(VERA), frozenset())
    return (*_registered(DEJAVU), _missing(DEJAVU[0], wanted))


def _registered(files: tuple[str, str]) -> tuple[str, str]:
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont

    plain, bold = (file.removesuffix(".ttf") for file in files)
    for name, file in ((plain, files[0]), (bold, files[1])):
        pdfmetrics.registerFont(TTFont(name, str(_path(file))))
    pdfmetrics.registerFontFamily(plain, normal=plain, bold=bold, italic=plain, boldItalic=bold)
    return plain, bold


def _missing(file: str, wanted: frozenset[str]) -> frozenset[str]:
    return wanted - _letters(file)


@lru_cache(4)
def _letters(file: str) -> frozenset[str]:
    from reportlab.pdfbase.ttfonts import TTFontFile

    return frozenset(map(chr, TTFontFile(str(_path(file))).charToGlyph))


def _path(file: str) -> Path:
    if file in DEJAVU:
        import matplotlib

        return Path(matplotlib.get_data_path()) / "fonts" / "ttf" / file
    import reportlab

    return Path(reportlab.__file__).parent / "fonts" / file
