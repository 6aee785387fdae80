"""Path data (SVG 2, chapter 9): what is in order is drawn, up to the first error, as browsers do."""

from __future__ import annotations

import re

from wrapit.drawing.svg.reading.lengths import NUMBER
from wrapit.drawing.svg.reading.pen import Pen, Point, Subpath

# The commands, and how many numbers each takes.
_NUMBERS_EACH = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7, "z": 0}
# What is between commands, what is between numbers, and numbers; flags need nothing between them.
_BLANK = re.compile(r"[ \t\r\n\f]*")
_COMMA = re.compile(r"[ \t\r\n\f]*,?[ \t\r\n\f]*")
_NUMBER = re.compile(NUMBER)
_FLAG = re.compile("[01]")


def path_subpaths(text: str, most: int) -> tuple[list[Subpath], int | None, int]:
    """The subpaths of path data, where its first error is (None if it has none), and the number of its parts.

    Stops behind `most` parts, moves included.
    """
    pen, error = Pen(), None
    path = _Path(pen)
    at = _skip(_BLANK, text, 0)
    while at < len(text) and error is None and pen.drawn <= most:
        command = text[at]
        count = _NUMBERS_EACH.get(command.lower())
        if count is None or (not path.begun and command not in "mM"):
            error = at
            break
        begin, at = at, _skip(_BLANK, text, at + 1)
        values, after = _values(text, at, count, command)
        if values is None:
            error = begin
            break
        path.draw(command, values)
        # Further numbers repeat the command; those of a move are lines.
        again = {"m": "l", "M": "L"}.get(command, command)
        while count and pen.drawn <= most:
            at = _skip(_COMMA, text, after)
            if at >= len(text) or text[at].isalpha():
                error = after if "," in text[after:at] else None
                break
            values, after = _values(text, at, count, again)
            if values is None:
                error = at
                break
            path.draw(again, values)
        if not count:
            at = _skip(_BLANK, text, after)
    return pen.subpaths(), error, pen.drawn


def polygon_subpaths(text: str, closed: bool, most: int) -> tuple[list[Subpath], int | None, int]:
    """The same for `points`: what is no number ends them, and half a point is left out."""
    pen, values, at = Pen(), list[float](), _skip(_BLANK, text, 0)
    while len(values) <= 2 * most + 2 and (found := _NUMBER.match(text, at)):
        values.append(float(found[0]))
        at = _skip(_COMMA, text, found.end())
    points = list(zip(values[::2], values[1::2], strict=False))
    if len(points) > 1:
        pen.move(points[0])
        for point in points[1:]:
            pen.line(point)
        if closed:
            pen.close()
    return pen.subpaths(), at if at < len(text) else None, pen.drawn


def _skip(what: re.Pattern[str], text: str, at: int) -> int:
    found = what.match(text, at)
    return found.end() if found else at


def _values(text: str, at: int, count: int, command: str) -> tuple[list[float] | None, int]:
    """So many numbers from a place on, and the place behind them; None where one is missing."""
    values: list[float] = []
    for index in range(count):
        if index:
            at = _skip(_COMMA, text, at)
        found = (_FLAG if command in "aA" and index in (3, 4) else _NUMBER).match(text, at)
        if not found:
            return None, at
        values.append(float(found[0]))
        at = found.end()
    return values, at


class _Path:
    """Draws commands one after another; remembers the last handle for the smooth ones."""

    def __init__(self, pen: Pen) -> None:
        self.begun = False
        self._pen = pen
        self._handle: Point | None = None
        self._last = ""

    def draw(self, command: str, values: list[float]) -> None:
        """One command with its numbers."""
        self.begun = True
        pen, kind = self._pen, command.lower()
        x, y = pen.at if command.islower() else (0.0, 0.0)
        smooth = (
            self._handle if self._handle and self._last in {"s": "cs", "t": "qt"}.get(kind, "") else pen.at
        )
        first = 2 * pen.at[0] - smooth[0], 2 * pen.at[1] - smooth[1]
        points = [(x + p, y + q) for p, q in zip(values[::2], values[1::2], strict=False)]
        self._handle = None
        if kind == "m":
            pen.move(points[0])
        elif kind == "l":
            pen.line(points[0])
        elif kind == "h":
            pen.line((x + values[0], pen.at[1]))
        elif kind == "v":
            pen.line((pen.at[0], y + values[0]))
        elif kind == "c":
            self._handle = points[1]
            pen.cubic(*points)
        elif kind == "s":
            self._handle = points[0]
            pen.cubic(first, points[0], points[1])
        elif kind == "q":
            self._handle = points[0]
            pen.quadratic(*points)
        elif kind == "t":
            self._handle = first
            pen.quadratic(first, points[0])
        elif kind == "a":
            to = x + values[5], y + values[6]
            pen.arc(values[0], values[1], values[2], bool(values[3]), bool(values[4]), to)
        else:
            pen.close()
        self._last = kind
