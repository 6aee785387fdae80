"""An element of an SVG file, as it is looked over before anything is drawn."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(eq=False)
class Element:
    """An element of the XML; names are `namespace}name`, or the bare name without a namespace."""

    name: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)
    text: list[str] = field(default_factory=list)

    @property
    def tag(self) -> str:
        """The name without its namespace."""
        return self.name.rpartition("}")[2]

    @property
    def link(self) -> str | None:
        """What it refers to; the newer attribute counts where both are there."""
        return self.attributes.get("href", self.attributes.get("http://www.w3.org/1999/xlink}href"))
