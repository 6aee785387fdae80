"""What elements of a file refer to: by their ids, without copies that contain themselves."""

from __future__ import annotations

from urllib.parse import unquote

from wrapit.drawing.svg.reading.element import Element

# What has stops (SVG 2, 14.2).
_GRADIENTS = ("linearGradient", "radialGradient")
# Gradients may take what they lack from others; a chain longer than this goes round, or nobody wrote it.
_LONGEST_CHAIN = 20


class Links:
    """The elements of a file by their ids, and the copies that would go on for ever."""

    def __init__(self, root: Element) -> None:
        self._elements = [element for element in root.iter() if isinstance(element, Element)]
        self._named: dict[str, Element] = {}
        for element in self._elements:
            if name := element.get("id"):
                self._named.setdefault(name, element)
        self._endless = self._find_endless()

    def target(self, link: str) -> Element | None:
        """What a link within the file leads to; None for one that leads nowhere, or out of it."""
        return self._named.get(unquote(link[1:].strip())) if link.startswith("#") else None

    def named_in(self, value: str) -> Element | None:
        """What `url(#name)` leads to; None for another value."""
        value = value.strip()
        return (
            self.target(value[4:].partition(")")[0].strip(" \t\n\"'")) if value.startswith("url(") else None
        )

    def mask(self, declared: dict[str, str]) -> str:
        """The name of the mask that declarations give, if there is one."""
        target = self.named_in(declared.get("mask", ""))
        return target.get("id", "") if target is not None and target.name == "mask" else ""

    def is_endless(self, use: Element) -> bool:
        """Whether what a `use` copies contains the `use` itself, over however many others."""
        return id(use) in self._endless

    def paints(self, link: str, flat: bool) -> bool:
        """Whether a gradient or pattern paints anything; on a `flat` shape only if it needs no box."""
        units, stops = None, False
        element = self.target(link)
        for _ in range(_LONGEST_CHAIN):
            if element is None or element.name not in (*_GRADIENTS, "pattern"):
                break
            kind = "patternUnits" if element.name == "pattern" else "gradientUnits"
            units = units or element.get(kind)
            stops = stops or any(
                child.name == "stop" or element.name == "pattern" for child in element.inside
            )
            element = self.target(element.link)
        return stops and not (flat and units != "userSpaceOnUse")

    def _find_endless(self) -> set[int]:
        uses = [
            element
            for element in self._elements
            if element.name == "use" and self.target(element.link) is not None
        ]
        if not uses:
            return set()
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        number = {id(element): index for index, element in enumerate(self._elements)}
        pairs = [(number[id(e)], number[id(child)]) for e in self._elements for child in e.inside]
        copies = [(number[id(use)], number[id(self.target(use.link))]) for use in uses]
        rows, columns = zip(*pairs, *copies, strict=True)
        count = len(self._elements)
        graph = coo_array(([1] * len(rows), (rows, columns)), shape=(count, count))
        # Whoever contains or copies whom, there and back, is of one group.
        _, group = connected_components(graph, connection="strong")
        return {id(use) for use, (one, other) in zip(uses, copies, strict=True) if group[one] == group[other]}
