"""Refuses attributes and styles of an SVG file on which svgelements's patterns would take minutes.

Those patterns take the square of a text's length, or a higher power, only on texts that fit them almost:
a bracket or comment without end, a number of hundreds of digits. No program writes such.
"""

from __future__ import annotations

import re
from pathlib import Path

from wrapit.drawing.svg.element import Element
from wrapit.errors import DrawingError

# Some hundreds of blanks, and values of thousands of characters, are where the patterns begin to take
# seconds; programs write a few dozen.
_LONGEST_BLANK = 200
_LONGEST_VALUE = 2_000
_LONGEST_RULE = 5_000
# Digits of one number: in general, and where several numbers follow each other in one pattern (fewer if it is
# not in order).
_MOST_DIGITS = 400
_MOST_DIGITS_OF_PAIR = 20
_MOST_DIGITS_OF_COLOUR = 12
_MOST_DIGITS_OF_OTHER_COLOUR = 4
# Sum of the squares of the selectors' lengths.
_MOST_SELECTING = 20_000_000

# Attributes of numbers and of colours, each read by patterns of its own.
_NUMBERS = {
    "viewBox", "width", "height", "x", "y", "x1", "x2", "y1", "y2", "cx", "cy", "r", "rx", "ry",
    "stroke-width", "opacity", "stroke-opacity", "fill-opacity", "font", "font-family", "font-size",
}  # fmt: skip
_COLOURS = {"fill", "stroke", "color", "stop-color"}
# What is looked for in them, by patterns that take linear time.
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_POINTS = re.compile(r"[-+.,0-9eE\s]*")
_PART_OF_COLOUR = re.compile(r"\s*[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)%?\s*")
_BLANK = re.compile(rf"\s{{{_LONGEST_BLANK},}}")


def refuse_slow_texts(element: Element, path: Path) -> None:
    """Raises DrawingError for an attribute or style that would take minutes to read."""
    where = f"{path}:{element.line}"
    for name, value in element.attributes.items():
        if name == "points":
            _refuse_digits(value, name, _MOST_DIGITS_OF_PAIR, where)
            _refuse_blanks(value, name, where)
            if (end := _POINTS.match(value)) and end.end() < len(value):
                raise DrawingError(f"{value[end.end()]!r} is no number in points", where, "correct it")
        elif name == "d":
            _refuse_digits(value, name, _MOST_DIGITS, where)
            _refuse_blanks(value, name, where)
        elif name == "style" or name in _COLOURS:
            _refuse_rule(value, f"{name!r} of <{element.tag[:40]}>", where)
        elif name.lower().endswith("transform"):
            _refuse_open_brackets(value, name, where)
        elif name in _NUMBERS and len(value) > _LONGEST_VALUE:
            raise DrawingError(
                f"{name!r} of <{element.tag[:40]}> is longer than {_LONGEST_VALUE} characters",
                where,
                "shorten it",
            )
    if element.tag == "style":
        _refuse_style("".join(element.text), where)


def _refuse_style(text: str, where: str) -> None:
    if "/*" in text and "*/" not in text[text.rfind("/*") + 2 :]:
        raise DrawingError("a comment in a <style> has no end", where, "write */ behind it")
    plain = _COMMENT.sub("", text)
    if plain.rfind("{") > plain.rfind("}"):
        raise DrawingError("a rule in a <style> has no end", where, "write } behind it")
    selecting, selector = 0, ""
    for number, piece in enumerate(plain.split("{")):
        body, _, following = piece.partition("}")
        if number and not selector.lstrip().startswith("@"):
            _refuse_rule(body, f"a rule of {selector.strip()[-40:]!r}", where)
        selector = following if number else piece
        selecting += len(selector) ** 2
    if selecting > _MOST_SELECTING:
        raise DrawingError("a <style> has too long selectors", where, "save it as plain SVG")


def _refuse_rule(text: str, what: str, where: str) -> None:
    if len(text) > _LONGEST_RULE:
        raise DrawingError(f"{what} is longer than {_LONGEST_RULE} characters", where, "shorten it")
    if "rgb" in text or "hsl" in text:
        ordered = all(map(_in_order, re.split(r"rgba?\(|hsla?\(", text)[1:]))
        most = _MOST_DIGITS_OF_COLOUR if ordered else _MOST_DIGITS_OF_OTHER_COLOUR
        _refuse_digits(text, what, most, where)
    _refuse_blanks(text, what, where)
    if "transform" in text:
        _refuse_open_brackets(text, what, where)


def _in_order(colour: str) -> bool:
    """Whether what follows `rgb(` is three or four numbers and a bracket."""
    inside, bracket, _ = colour.partition(")")
    parts = inside.split(",")
    return bool(bracket) and len(parts) in (3, 4) and all(map(_PART_OF_COLOUR.fullmatch, parts))


def _refuse_digits(text: str, what: str, most: int, where: str) -> None:
    if re.search(rf"[0-9]{{{most + 1}}}", text):
        raise DrawingError(f"a number in {what} has more than {most} digits", where, "round it")


def _refuse_blanks(text: str, what: str, where: str) -> None:
    if _BLANK.search(text):
        raise DrawingError(f"{what} has {_LONGEST_BLANK} blanks in a row", where, "remove them")


def _refuse_open_brackets(text: str, what: str, where: str) -> None:
    if any(")" not in piece for piece in text.split("(")[1:]):
        raise DrawingError(f"a bracket in {what} has no end", where, "write ) behind it")
