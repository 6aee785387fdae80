"""The cascade (CSS Cascade 4): attributes, rules of style sheets by their selectors, the style attribute.

tinycss2 splits the text, cssselect2 matches selectors. The work of matching is bounded before it begins: a
selector with blanks tries every choice of that many ancestors.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from wrapit.drawing.svg.reading.element import Element
from wrapit.errors import DrawingError

# Elements that selectors are tried on, times the ways in which each can be tried: some ten seconds. Style
# sheets of Illustrator (thousands of elements, hundreds of classes) come to a few hundred thousand.
_MOST_TRIED = 20_000_000
# Brackets within brackets; nobody writes more than four, and what splits them recurses.
_MOST_NESTED = 50
# Characters of one selector; the longest that programs write are some dozen.
_LONGEST_SELECTOR = 500
# Parts of one selector; cssselect2 nests a bracket for each, and Python's own parser takes 200.
_MOST_COMBINED = 30
# Style attributes are alike in most shapes of a drawing; as many different ones are remembered.
_REMEMBERED = 10_000

# Rules that hold other rules; what is asked of a browser by `@supports`, it can.
_GROUPS = {"media", "supports", "layer"}
# Attributes with other meanings than the properties of their names.
_NO_PROPERTIES = {"style", "class", "id", "translate", "rotate", "scale", "font", "marker"}
_PLAIN = "save it as plain SVG"

# Name, value and whether it is `!important`, as written.
Declaration = tuple[str, str, bool]
_Rule = tuple[tuple[int, ...], int, tuple[Declaration, ...]]
# Says whether a property may have a value: one that may not leaves the place to what comes before.
Valid = Callable[[str, str], bool]


class Cascade:
    """The declarations of each element of a file, those that hold."""

    def __init__(self, root: Element, path: Path, valid: Valid) -> None:
        self._path, self._valid = path, valid
        self._known: dict[int, dict[str, str]] = {}
        self._rules = _matched(root, path)

    def declared(self, element: Element) -> dict[str, str]:
        """What holds for an element's properties, before anything is inherited."""
        known = self._known.get(id(element))
        if known is None:
            known = self._known[id(element)] = self._cascaded(element)
        return known

    def _cascaded(self, element: Element) -> dict[str, str]:
        found: dict[str, str] = {}
        for name, value in element.items():
            if "}" not in name and name not in _NO_PROPERTIES and self._valid(name, value):
                found[name] = value
        sheets = [line for _, _, lines in self._rules.get(id(element), ()) for line in lines]
        style = element.get("style")
        own = _of_style(style, f"{self._path}:{element.line}") if style else ()
        # Important rules come above the style attribute, and its important ones above all.
        for lines, important in ((sheets, False), (own, False), (sheets, True), (own, True)):
            for name, value, marked in lines:
                if marked == important and self._valid(name, value):
                    found[name] = value
        return found


@lru_cache(_REMEMBERED)
def _of_style(text: str, where: str) -> tuple[Declaration, ...]:
    import tinycss2

    refuse_nested(text, where)
    return tuple(
        _declarations(tinycss2.parse_blocks_contents(text, skip_comments=True, skip_whitespace=True))
    )


def _declarations(nodes: Iterable[Any]) -> list[Declaration]:
    import tinycss2

    return [
        (node.lower_name, tinycss2.serialize(node.value).strip(), node.important)
        for node in nodes
        if node.type == "declaration"
    ]


def refuse_nested(text: str, where: str) -> None:
    """Raises DrawingError where brackets are nested deeper than anything means."""
    depth = 0
    for character in text:
        if character in "([{":
            depth += 1
            if depth > _MOST_NESTED:
                problem = f"brackets in a style are nested more than {_MOST_NESTED} deep"
                raise DrawingError(problem, where, "correct it, or remove it")
        elif character in ")]}":
            depth = max(0, depth - 1)


@dataclass(frozen=True)
class _Size:
    """What the work of matching depends on: how many elements, how deep, and how many in one."""

    elements: int
    depth: int
    siblings: int

    def tries(self, selector: str) -> float:
        """In how many ways a selector can be tried on all elements, at most."""
        blanks = len(re.findall(r"[^\s>+~,(]\s+(?=[^\s>+~,)])", selector))
        beside = selector.count("~") + selector.count(":nth") + selector.count("-of-type")
        inside = self.elements ** selector.count(":has")
        return math.comb(self.depth, min(blanks, self.depth)) * self.siblings**beside * inside * self.elements


def _matched(root: Element, path: Path) -> dict[int, list[_Rule]]:
    """The rules for each element, the weakest first; by the identity of the element."""
    sheets = [element for element in root.iter() if isinstance(element, Element) and element.name == "style"]
    if not sheets:
        return {}
    from cssselect2 import ElementWrapper, Matcher

    size, tried, matcher = _size(root), 0.0, Matcher()
    for sheet in sheets:
        kind = sheet.get("type", "").strip().lower()
        if kind not in ("", "text/css") or not _for_screens(sheet.get("media", "")):
            continue
        where, text = f"{path}:{sheet.line}", sheet.text or ""
        refuse_nested(text, where)
        for rule in _rules_in(text):
            selectors = _serialised(rule.prelude)
            # Attribute selectors may hold commas; then their parts are too short, which only lets more pass.
            for selector in selectors.split(","):
                combined = len(re.findall(r"[\s>+~]+", selector.strip()))
                if len(selector) > _LONGEST_SELECTOR or combined > _MOST_COMBINED:
                    raise DrawingError("a selector in a <style> is too long", where, _PLAIN)
                tried += size.tries(selector.strip())
            if tried > _MOST_TRIED:
                raise DrawingError("a <style> has too many selectors for so many shapes", where, _PLAIN)
            lines = _of_rule(rule)
            for compiled in _compiled(rule.prelude):
                matcher.add_selector(compiled, lines)
    found: dict[int, list[_Rule]] = {}
    for wrapped in ElementWrapper.from_xml_root(root).iter_subtree():
        matches = [
            (rank, order, lines) for rank, order, pseudo, lines in matcher.match(wrapped) if pseudo is None
        ]
        if matches:
            found[id(wrapped.etree_element)] = matches
    return found


def _size(root: Element) -> _Size:
    elements, depth, siblings, level = 0, 0, 1, [root]
    while level:
        elements, depth = elements + len(level), depth + 1
        siblings = max(siblings, *(len(element) for element in level))
        level = [child for element in level for child in element.inside]
    return _Size(elements, depth, siblings)


def _compiled(prelude: list[Any]) -> list[Any]:
    """The selectors of a rule; one that is not in order makes the rule void, as in browsers."""
    from cssselect2 import SelectorError, compile_selector_list

    try:
        return compile_selector_list(prelude)
    except SelectorError:
        return []


def _rules_in(text: str) -> list[Any]:
    """The rules of a style sheet that hold for a screen, those within other rules too."""
    import tinycss2

    rules: list[Any] = []
    waiting = tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True)[::-1]
    while waiting:
        node = waiting.pop()
        if node.type == "qualified-rule":
            rules.append(node)
        elif node.type == "at-rule" and node.content and _holds(node):
            inner = tinycss2.parse_rule_list(node.content, skip_comments=True, skip_whitespace=True)
            waiting += inner[::-1]
    return rules


def _holds(rule: Any) -> bool:
    keyword = rule.lower_at_keyword
    return keyword in _GROUPS and (keyword != "media" or _for_screens(_serialised(rule.prelude)))


def _of_rule(rule: Any) -> tuple[Declaration, ...]:
    import tinycss2

    content = tinycss2.parse_blocks_contents(rule.content, skip_comments=True, skip_whitespace=True)
    return tuple(_declarations(content))


def _serialised(nodes: Any) -> str:
    import tinycss2

    return tinycss2.serialize(nodes)


def _for_screens(media: str) -> bool:
    """Whether a media query holds for a screen; of its conditions only that light is preferred is met."""
    for part in media.lower().split(","):
        words = " ".join(part.split()).removeprefix("only ")
        no = words.startswith("not ")
        kind, *conditions = words.removeprefix("not ").split(" and ")
        if kind.startswith("("):
            kind, conditions = "all", [kind, *conditions]
        light = all("".join(each.split()) == "(prefers-color-scheme:light)" for each in conditions)
        if (kind in ("", "all", "screen") and light) != no:
            return True
    return False
