"""Which elements are meant for this reader: `switch`, `systemLanguage`, `requiredExtensions` (SVG 2, 5.8)."""

from __future__ import annotations

from wrapit.drawing.svg.reading.element import Element

# What is drawn where a file has several languages.
_LANGUAGE = "en"
# Elements that nothing is drawn for are no choice of a `switch`.
_DRAWN = {
    "a", "circle", "ellipse", "foreignObject", "g", "image", "line", "path", "polygon", "polyline", "rect",
    "svg", "switch", "text", "use",
}  # fmt: skip


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
