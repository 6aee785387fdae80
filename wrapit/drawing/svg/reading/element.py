"""An element of an SVG file."""

from __future__ import annotations

from xml.etree.ElementTree import Element as XmlElement

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"


class Element(XmlElement):
    """An element of the XML with its line; names are `{namespace}name`, as selectors want them."""

    def __init__(self, tag: str, attributes: dict[str, str], line: int) -> None:
        super().__init__(tag, attributes)
        self.line = line

    @property
    def name(self) -> str:
        """The name of an element of SVG, without its namespace; empty for one of another language."""
        return self.tag[len(SVG) + 2 :] if self.tag.startswith(f"{{{SVG}}}") else ""

    @property
    def link(self) -> str:
        """What it refers to; the newer attribute counts where both are there."""
        return (self.get("href") or self.get(f"{{{XLINK}}}href") or "").strip()

    @property
    def inside(self) -> list[Element]:
        """The elements in it."""
        return [child for child in self if isinstance(child, Element)]
