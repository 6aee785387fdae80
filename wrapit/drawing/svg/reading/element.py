"""An element of an SVG file, and whether it is meant for this reader (SVG 2, 5.8)."""

from __future__ import annotations

from xml.etree.ElementTree import Element as XmlElement

# The names of the languages, as their specifications give them.
SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"

# What is drawn where a file has several languages.
_LANGUAGE = "en"
# Elements that nothing is drawn for are no choice of a `switch`.
_DRAWN = {
    "a", "circle", "ellipse", "foreignObject", "g", "image", "line", "path", "polygon", "polyline", "rect",
    "svg", "switch", "text", "use",
}  # fmt: skip


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


def met(element: Element) -> bool:
    """Whether an element's conditions hold."""
    if element.get("requiredExtensions", "").strip():
        return False
    languages = element.get("systemLanguage")
    return languages is None or any(
        language.strip().lower().partition("-")[0] == _LANGUAGE for language in languages.split(",")
    )


def chosen(switch: Element) -> list[Element]:
    """The first child whose conditions hold, if any."""
    for child in switch.inside:
        if child.name in _DRAWN and met(child):
            return [child]
    return []
