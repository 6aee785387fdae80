"""The XML of an SVG file: read safely, whatever encoding it declares, and without loading anything.

Nothing in it can grow: entities may not name others, and the sum of what they could insert is bounded before
the first is inserted. What HTML parsers forgive is forgiven (names of characters such as `&nbsp;`,
prefixes that nobody declared).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from wrapit.drawing.signatures import kind_of
from wrapit.drawing.svg.programs import Program, program_of
from wrapit.drawing.svg.reading.element import SVG, XLINK, Element
from wrapit.errors import DrawingError

# What is no drawing but a burden? Far more than any drawing holds; parsing as much takes seconds.
_LARGEST_BYTES = 50_000_000
_MOST_ELEMENTS = 100_000
# Programs nest groups a dozen deep; everything that follows the tree recurses for each level.
DEEPEST = 150
# What entities and default values could insert, in characters, if each `&` or `<` of the file did so. Those
# of Illustrator (a dozen addresses in a head of twenty lines) come to some ten thousand.
_MOST_INSERTED = 20_000_000
_PLAIN = "save it as plain SVG"
_PICTURE = "save the picture itself, as a file of its own"
# Where a web page says that it is one, if anywhere.
_HEAD = 4_000
_XML_PREFIXES = {"xml": "http://www.w3.org/XML/1998/namespace", "xlink": XLINK, "svg": SVG}


@dataclass(frozen=True, eq=False)
class Document:
    """The root of an SVG file, the style sheets of other files that it names (line, text), its program."""

    root: Element
    sheets: list[tuple[int, str]]
    program: Program


def read_document(path: Path) -> Document:
    """The elements of an SVG file, and what it says of itself.

    Raises DrawingError where it can't be read, is no SVG, or could grow without end.
    """
    data = _bytes(path)
    builder = _parsed(data, path)
    root = builder.root
    name = root.tag.rpartition("}")[2]
    if name.lower() == "html":
        raise DrawingError("the file is a web page, no SVG drawing", str(path), _PICTURE)
    if root.name != "svg":
        raise DrawingError(
            f"the file holds no SVG drawing: its outermost element is <{name[:40]}>", str(path), _PLAIN
        )
    # What programs say of themselves: comments, their own languages, and names and descriptions at the top.
    said = [root.get("id", "")]
    # Of all programs only Canva writes how a viewer may zoom.
    said += ["Canva"] if root.get("zoomAndPan") == "magnify" else []
    said += [element.text or "" for element in root if element.tag.endswith(("}title", "}desc"))]
    return Document(root, builder.sheets, program_of([*builder.traces, *said]))


def _bytes(path: Path) -> bytes:
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise DrawingError("the SVG file is larger than 50 MB", str(path), "simplify it")
        data = path.read_bytes()
    except OSError as error:
        reason = error.strerror or "the system gives no reason"
        raise DrawingError(f"the SVG file can't be read ({reason.lower()})", str(path), _PLAIN) from None
    if kind_of(data) == "gzip-compressed":
        data = _unpacked(data, path)
    if not data.strip():
        raise DrawingError("the SVG file is empty", str(path), "save it again")
    kind = kind_of(data)
    if kind == "HTML":
        raise DrawingError("the file is a web page, no SVG drawing", str(path), _PICTURE)
    if kind not in (None, "SVG"):
        raise DrawingError(f"the file is no SVG drawing but {kind}", str(path), "name it by its kind")
    return data


def _unpacked(data: bytes, path: Path) -> bytes:
    """What a compressed SVG file (svgz) holds; only as much is unpacked as an SVG file may have."""
    import zlib

    # 16 + 15: gzip's head, and its largest window.
    unpacking = zlib.decompressobj(wbits=31)
    try:
        found = unpacking.decompress(data, _LARGEST_BYTES)
    except zlib.error:
        raise DrawingError("the compressed SVG file is damaged", str(path), "save it again") from None
    if unpacking.unconsumed_tail:
        raise DrawingError("the SVG file is larger than 50 MB when unpacked", str(path), "simplify it")
    if not unpacking.eof:
        raise DrawingError("the compressed SVG file is cut off", str(path), "save or copy it again")
    return found


def _parsed(data: bytes, path: Path) -> _Builder:
    from xml.parsers import expat

    parser = expat.ParserCreate()
    builder = _Builder(parser, data, path)
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        if b"<html" in data[:_HEAD].lower():
            raise DrawingError("the file is a web page, no SVG drawing", str(path), _PICTURE) from None
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
    return builder


@cache
def _characters() -> bytes:
    """The names of characters that HTML knows, as entities."""
    from html.entities import name2codepoint

    own = ("lt", "gt", "amp", "quot")
    names = (f'<!ENTITY {name} "&#{code};">' for name, code in name2codepoint.items() if name not in own)
    return "".join(names).encode()


class _Builder:
    """Makes the elements while the parser reads, and refuses at once what may not be there."""

    def __init__(self, parser: Any, data: bytes, path: Path) -> None:
        from xml.parsers.expat import XML_PARAM_ENTITY_PARSING_UNLESS_STANDALONE

        self.root: Element
        self.sheets: list[tuple[int, str]] = []
        self.traces: list[str] = []
        self._parser, self._data, self._path = parser, data, path
        self._open: list[Element] = []
        self._scopes: list[dict[str, str]] = [_XML_PREFIXES]
        self._count = self._inserted = 0
        parser.buffer_text = True
        # Gives a place to define the names of characters in; nothing is loaded for it.
        parser.UseForeignDTD(True)
        parser.SetParamEntityParsing(XML_PARAM_ENTITY_PARSING_UNLESS_STANDALONE)
        parser.ExternalEntityRefHandler = self._outside
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = self._entity
        parser.AttlistDeclHandler = self._default
        parser.ProcessingInstructionHandler = self._instruction
        parser.CommentHandler = self.traces.append

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
        scope = self._scopes[-1]
        declared = {name[6:]: uri for name, uri in attributes.items() if name.startswith("xmlns:")}
        if "xmlns" in attributes:
            declared[""] = attributes["xmlns"]
        if not self._open and not declared.get(""):
            # Files without any namespace are meant as SVG.
            declared.setdefault("", SVG)
        if declared:
            scope = {**scope, **declared}
            self.traces += declared.values()
        self._scopes.append(scope)
        named = {
            _qualified(key, scope) if ":" in key else key: value
            for key, value in attributes.items()
            if not key.startswith("xmlns")
        }
        element = Element(_qualified(name, scope), named, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, _: str) -> None:
        self._scopes.pop()
        self._open.pop()

    def _text(self, text: str) -> None:
        # Of all texts only rules of style are read; of the others, that they are there.
        element = self._open[-1]
        if not len(element) and (element.name == "style" or not element.text or element.text.isspace()):
            element.text = (element.text or "") + text

    def _doctype(self, name: str, *_: object) -> None:
        if name.lower() == "html":
            raise DrawingError("the file is a web page, no SVG drawing", str(self._path), _PICTURE)

    def _outside(self, context: str | None, *_: object) -> int:
        if context is None:
            inner = self._parser.ExternalEntityParserCreate(context)
            inner.EntityDeclHandler = None
            inner.Parse(_characters(), True)
        return 1

    def _entity(self, _name: str, parameter: int, value: str | None, *_: object) -> None:
        if value is None:
            problem = "the SVG file defines entities of other files, which are never loaded"
            raise DrawingError(problem, self._where(), _PLAIN)
        if parameter or "&" in value or "%" in value:
            problem = "the SVG file defines entities by other entities, which are not read for safety"
            raise DrawingError(problem, self._where(), _PLAIN)
        self._insert(len(value) * self._data.count(b"&"))

    def _default(self, _element: str, _name: str, _kind: str, value: str | None, _required: int) -> None:
        self._insert(len(value or "") * self._data.count(b"<"))

    def _insert(self, characters: int) -> None:
        self._inserted += characters
        if self._inserted > _MOST_INSERTED:
            raise DrawingError("the SVG file defines too long entities", self._where(), _PLAIN)

    def _instruction(self, target: str, text: str) -> None:
        if target == "xml-stylesheet":
            self.sheets.append((self._parser.CurrentLineNumber, text))


def _qualified(name: str, scope: dict[str, str]) -> str:
    """`{namespace}name`; a prefix that nobody declared is a language of its own."""
    prefix, _, local = name.rpartition(":")
    uri = scope.get(prefix, prefix)
    return f"{{{uri}}}{local}" if uri else local
