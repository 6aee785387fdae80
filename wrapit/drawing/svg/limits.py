"""Counts what drawing an SVG file would take, before anybody starts to: copies, attributes, long texts."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from wrapit.drawing.svg.element import Element
from wrapit.errors import DrawingError

# All copies counted. Reading as many takes a few seconds, and no jewellery has so many.
MOST_SHAPES = 20_000
MOST_PARTS = 20_000
# Programs nest groups a dozen deep; svgelements recurses for each level, copies included.
DEEPEST = 150
# Characters of attributes that are handed down from groups to what is in them, summed over all elements;
# those that every element reads anew weigh more, and styles, of which few rules apply, less.
_MOST_CHARACTERS = 20_000_000
_READ_ANEW, _WEIGHT = ("transform", "d", "points", "style"), 10
_STYLE_SHARE = 5
# Copies of copies make numbers without end; sums stop here, and are only "many" from there.
_ENOUGH = 10**12
_MANY = 10**7

# Path data: a command with what follows, its numbers, and how many of them make one part.
_COMMAND = re.compile(r"([A-DF-Za-df-z])([^A-DF-Za-df-z]*)")
_NUMBER = re.compile(r"[0-9]+\.?[0-9]*|\.[0-9]+")
_NUMBERS_EACH = {"h": 1, "v": 1, "m": 2, "l": 2, "t": 2, "q": 4, "s": 4, "c": 6, "a": 7}


@dataclass(frozen=True)
class _Load:
    """What an element comes to with all that is in it and all that it copies."""

    elements: int
    parts: int
    characters: int
    depth: int


def refuse_endless(root: Element, path: Path) -> None:
    """Raises DrawingError where the elements, with every copy that `use` makes, are too many."""
    load = _load(root, path)
    if load.elements > MOST_SHAPES:
        raise DrawingError(
            f"the drawing has {_many(load.elements)} shapes and groups, copies counted "
            f"(the limit is {MOST_SHAPES})",
            str(path),
            "simplify it, or copy less with <use>",
        )
    refuse_parts(load.parts, path)
    if load.depth > DEEPEST:
        raise DrawingError(
            f"groups and copies are nested {load.depth} deep (the limit is {DEEPEST})",
            str(path),
            "ungroup them, or copy less with <use>",
        )
    if load.characters > _MOST_CHARACTERS:
        raise DrawingError(
            "the attributes of groups and the styles are too long for so many shapes",
            str(path),
            "ungroup them and save it as plain SVG",
        )


def refuse_parts(parts: int, path: Path) -> None:
    """Raises DrawingError where the lines have more straight and curved parts than can be worked on."""
    if parts > MOST_PARTS:
        raise DrawingError(
            f"the lines have {_many(parts)} straight or curved parts (the limit is {MOST_PARTS})",
            str(path),
            "simplify the paths, in Inkscape with Path > Simplify",
        )


def _load(root: Element, path: Path) -> _Load:
    """The root's load; each element counts once, without recursion, as copies may be long chains."""
    named: dict[str, Element] = {}
    waiting = [root]
    for element in waiting:
        waiting += element.children
        if "id" in element.attributes:
            named[element.attributes["id"]] = element
    style = sum(_style_length(element) for element in waiting if element.tag == "style")
    known: dict[int, _Load] = {}
    begun: set[int] = set()
    stack = [root]
    while stack:
        element = stack[-1]
        inside = _inside(element, named)
        if id(element) not in begun:
            begun.add(id(element))
            for other in inside:
                if id(other) in begun and id(other) not in known:
                    raise DrawingError(
                        f"<{other.tag[:40]}> contains a copy of itself",
                        f"{path}:{element.line}",
                        "remove the <use> in it",
                    )
            stack += [other for other in inside if id(other) not in known]
            continue
        stack.pop()
        if id(element) not in known:
            known[id(element)] = _sum(element, [known[id(other)] for other in inside], style)
    return known[id(root)]


def _inside(element: Element, named: dict[str, Element]) -> list[Element]:
    """What is in an element, and what it copies, found as svgelements does."""
    link = element.link
    copied = named.get(link[1:]) if element.tag == "use" and link is not None else None
    return element.children if copied is None else [*element.children, copied]


def _sum(element: Element, inside: list[_Load], style: int) -> _Load:
    elements = 1 + sum(load.elements for load in inside)
    own = sum(len(name) + len(value) for name, value in element.attributes.items())
    anew = _WEIGHT * sum(len(element.attributes.get(name, "")) for name in _READ_ANEW)
    # Each class of an element looks up its rules, and the element itself does.
    styled = style * (1 + len(element.attributes.get("class", "").split())) // _STYLE_SHARE
    characters = own * elements + anew * (elements - 1) + styled
    return _Load(
        min(elements, _ENOUGH),
        min(_parts(element) + sum(load.parts for load in inside), _ENOUGH),
        min(characters + sum(load.characters for load in inside), _ENOUGH),
        1 + max((load.depth for load in inside), default=0),
    )


def _style_length(element: Element) -> int:
    """Characters of its rules; a font in it is long, and applies to nothing."""
    rules = "".join(element.text).split("}")
    return sum(len(rule) for rule in rules if "@font-face" not in rule)


def _parts(element: Element) -> int:
    """How many parts its path or points have; a path of mere moves counts too, as it takes time."""
    points = len(_NUMBER.findall(element.attributes.get("points", ""))) // 2
    commands = _COMMAND.findall(element.attributes.get("d", ""))
    parts = 0
    for command, numbers in commands:
        count = len(_NUMBER.findall(numbers)) // _NUMBERS_EACH.get(command.lower(), 2)
        parts += max(0, count - 1) if command in "mM" else max(1, count)
    return points + max(parts, len(commands) // 3)


def _many(count: int) -> str:
    return f"{count}" if count < _MANY else "over ten million"
