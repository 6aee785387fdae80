"""An SVG file looked over before it is drawn: no entities, nothing from outside, nothing without end.

The drawing itself is made by svgelements, which copies what `use` names, passes all attributes of a group
on to what is in it, and reads texts with patterns that take the square (or cube) of their length. So the
work is counted here, in one pass over the XML, and refused where it would take minutes.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from wrapit.drawing.signatures import kind_of
from wrapit.drawing.svg.element import Element
from wrapit.drawing.svg.limits import DEEPEST, refuse_endless
from wrapit.drawing.svg.texts import refuse_slow_texts
from wrapit.errors import DrawingError

# What is no drawing but a burden? Far more than any drawing holds; parsing as much takes seconds.
_LARGEST_BYTES = 50_000_000
_MOST_ELEMENTS = 100_000
# The names that SVG files use, and one remedy for many faults.
_SVG = "http://www.w3.org/2000/svg"
_PLAIN = "save it as plain SVG"

# What shows a file or a part of one that it refers to; a link (`a`) only leads there.
_SHOWN = {"image", "use", "feimage", "lineargradient", "radialgradient", "pattern"}
# Attributes of numbers, in which svgelements takes these words for numbers too.
_NUMERIC = re.compile(r"d|points|x[12]?|y[12]?|c[xy]|r[xy]?|width|height")
_NO_NUMBER = re.compile(r"(?<![\w#-])(?:[-+]?nan|[-+]?inf(?:inity)?)(?![\w-])", re.IGNORECASE)


def safe_document(path: Path) -> tuple[bytes, Element]:
    """The bytes of an SVG file that may be drawn, and its root.

    Raises DrawingError where it can't be read, is no SVG, defines entities, refers to other files, or
    would take too long.
    """
    data = _bytes(path)
    root = _parsed(data, path)
    if root.name not in ("svg", f"{_SVG}}}svg"):
        raise DrawingError(
            f"the file holds no SVG drawing: its outermost element is <{root.tag[:40]}>", str(path), _PLAIN
        )
    refuse_endless(root, path)
    for element in _all(root):
        _refuse_outside(element, path)
        refuse_slow_texts(element, path)
        for name, value in element.attributes.items():
            if _NUMERIC.fullmatch(name) and (bad := _NO_NUMBER.search(value)):
                where = f"{path}:{element.line}"
                raise DrawingError(f"{bad.group(0)!r} is no coordinate", where, "correct the path data")
    return data, root


def paths_of(root: Element) -> list[Element]:
    """The elements with path data, as they follow each other in the file."""
    return [element for element in _all(root) if "d" in element.attributes]


def _all(root: Element) -> list[Element]:
    found = [root]
    for element in found:
        found += element.children
    return found


def _bytes(path: Path) -> bytes:
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise DrawingError("the SVG file is larger than 50 MB", str(path), "simplify it")
        data = path.read_bytes()
    except OSError as error:
        reason = error.strerror or "the system gives no reason"
        raise DrawingError(f"the SVG file can't be read ({reason.lower()})", str(path), _PLAIN) from None
    if not data.strip():
        raise DrawingError("the SVG file is empty", str(path), "save it again")
    kind = kind_of(data)
    if kind == "gzip-compressed":
        raise DrawingError("the SVG file is compressed (svgz)", str(path), f"unpack it, or {_PLAIN}")
    if kind == "HTML":
        raise DrawingError("the file is a web page, no SVG drawing", str(path), "save the picture itself")
    if kind not in (None, "SVG"):
        raise DrawingError(f"the file is no SVG drawing but {kind}", str(path), "name it by its kind")
    return data


def _parsed(data: bytes, path: Path) -> Element:
    from xml.parsers import expat

    parser = expat.ParserCreate(namespace_separator="}")
    builder = _Builder(parser, path)
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise DrawingError(
            f"the SVG file is not valid XML ({expat.errors.messages.get(error.code, 'damaged')})",
            f"{path}:{error.lineno}:{error.offset + 1}",
            "it may be cut off; save it again",
        ) from None
    except (ValueError, LookupError) as error:
        # An encoding that nobody knows, or one that takes several bytes for a character.
        raise DrawingError(
            f"the SVG file can't be read ({str(error) or 'its text encoding is unknown'})",
            str(path),
            "save it as plain SVG in UTF-8",
        ) from None
    return builder.root


class _Builder:
    """Makes the elements while the parser reads, and refuses at once what may not be there."""

    def __init__(self, parser: Any, path: Path) -> None:
        self.root: Element
        self._parser, self._path = parser, path
        self._open: list[Element] = []
        self._count = 0
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = self._entity
        parser.ProcessingInstructionHandler = self._instruction

    def _where(self) -> str:
        return f"{self._path}:{self._parser.CurrentLineNumber}"

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self._count += 1
        if self._count > _MOST_ELEMENTS:
            raise DrawingError(
                f"the SVG file has more than {_MOST_ELEMENTS} elements", str(self._path), "simplify it"
            )
        if len(self._open) >= DEEPEST:
            raise DrawingError(
                f"groups are nested more than {DEEPEST} deep", self._where(), "ungroup them, or simplify it"
            )
        element = Element(name, attributes, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, _: str) -> None:
        self._open.pop()

    def _text(self, text: str) -> None:
        self._open[-1].text.append(text)

    def _doctype(self, name: str, _system: str | None, _public: str | None, internal: int) -> None:
        if internal:
            self._entity()
        if name.lower() == "html":
            raise DrawingError(
                "the file is a web page, no SVG drawing", str(self._path), "save the picture itself"
            )

    def _entity(self, *_: object) -> None:
        raise DrawingError(
            "the SVG file defines entities, which are not read for safety", self._where(), _PLAIN
        )

    def _instruction(self, target: str, _: str) -> None:
        if target == "xml-stylesheet":
            raise _outside("xml-stylesheet", self._where())


def _outside(what: str, where: str) -> DrawingError:
    return DrawingError(
        f"the SVG file refers to another file ({what[-60:].strip()}), which is never loaded",
        where,
        "embed or remove it",
    )


def _refuse_outside(element: Element, path: Path) -> None:
    where, link = f"{path}:{element.line}", (element.link or "").strip()
    if element.tag.lower() in _SHOWN and link and not link.startswith(("#", "data:")):
        raise _outside(f"<{element.tag}> {link[:40]}", where)
    texts = [*element.attributes.values(), *(["".join(element.text)] if element.tag == "style" else [])]
    for text in texts:
        # Pieces behind each `url(`, looked at by hand: a pattern with optional blanks takes the square.
        for piece in text.split("url(")[1:]:
            target = piece[:200].lstrip(" \t\r\n\"'")
            if target and not target.startswith(("#", "data:", ")")):
                raise _outside(f"url({target[:40].split(')')[0]})", where)
        if element.tag == "style" and "@import" in text:
            raise _outside("@import", where)
