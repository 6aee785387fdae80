"""Affine matrices, and the transforms that SVG and CSS write; CSS Transforms 1 and 2.

A matrix is (a, b, c, d, e, f): x' = a x + c y + e, y' = b x + d y + f.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from wrapit.drawing.svg.reading.lengths import Measure, numbers
from wrapit.geometry import FloatArray

Matrix = tuple[float, float, float, float, float, float]

# The matrix that does nothing.
IDENTITY: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
# A function with its arguments, and what may stand before it in a list.
_FUNCTION = re.compile(r"[\s,]*([A-Za-z0-9]+)\s*\(([^()]*)\)")
# The units of angles (CSS Values 4, 7.1).
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0}
# Where `transform-origin` has words.
_PLACES = {"left": 0.0, "top": 0.0, "center": 50.0, "right": 100.0, "bottom": 100.0}

# The arguments of a function: numbers with their units, and what lengths are relative to.
_Arguments = list[tuple[float, str]]


def times(one: Matrix, other: Matrix) -> Matrix:
    """The matrix that does the other first."""
    a, b, c, d, e, f = one
    p, q, r, s, t, u = other
    return (a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f)


def moved_by(x: float, y: float) -> Matrix:
    """The matrix that moves."""
    return (1.0, 0.0, 0.0, 1.0, x, y)


def determinant(matrix: Matrix) -> float:
    """By how much it makes areas larger."""
    a, b, c, d, _, _ = matrix
    return a * d - b * c


def inverse(matrix: Matrix) -> Matrix | None:
    """The matrix that undoes it; None where it makes the plane a line."""
    a, b, c, d, e, f = matrix
    size = determinant(matrix)
    if not size or not math.isfinite(1 / size):
        return None
    return (d / size, -b / size, -c / size, a / size, (c * f - d * e) / size, (b * e - a * f) / size)


def applied(matrix: Matrix, points: FloatArray) -> FloatArray:
    """Points (..., 2) moved by a matrix."""
    a, b, c, d, e, f = matrix
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large is refused by name
        return points @ np.array([[a, b], [c, d]]) + np.array([e, f])


def transform(text: str, measure: Measure) -> Matrix | None:
    """The matrix of a `transform`, as attribute or as property; None where it is not in order."""
    text = text.strip()
    matrix, at = IDENTITY, 0
    if text == "none":
        return matrix
    while found := _FUNCTION.match(text, at):
        arguments = numbers(found[2])
        make = _FUNCTIONS.get(found[1].lower())
        if arguments is None or make is None:
            return None
        try:
            single = make(arguments, measure)
        except (IndexError, KeyError, ValueError, OverflowError):
            # Too few numbers, a unit that is none, or a tangent without bound.
            return None
        matrix, at = times(matrix, single), found.end()
    return matrix if not text[at:].strip() else None


def written_transform(declared: dict[str, str]) -> str:
    """All that properties say of a transform, as one list; the single ones come before the list."""
    parts = [
        f"{name}({declared[name].strip() if name == 'rotate' else ','.join(declared[name].split())})"
        for name in ("translate", "rotate", "scale")
        if name in declared and declared[name].strip() != "none"
    ]
    parts.append(declared.get("transform", ""))
    return " ".join(part for part in parts if part.strip() not in ("", "none"))


def about(written: str, place: str, x: float, y: float, measure: Measure) -> Matrix:
    """The matrix of a transform about an origin within a box with a corner and the measure's size."""
    found = transform(written, measure) if written else None
    if found is None:
        return IDENTITY
    dx, dy = origin(place, measure) or (0.0, 0.0)
    return times(moved_by(x + dx, y + dy), times(found, moved_by(-x - dx, -y - dy)))


def origin(text: str, measure: Measure) -> tuple[float, float] | None:
    """`transform-origin` within a box of the measure's width and height; None where it is not in order."""
    words = text.replace(",", " ").split()[:2]
    if (
        words
        and words[0] in ("top", "bottom")
        and (len(words) == 1 or words[1] in ("left", "center", "right"))
    ):
        words = [words[1] if len(words) > 1 else "center", words[0]]
    elif len(words) == 2 and words[1] in ("left", "right"):
        words.reverse()
    found: list[float] = []
    for word, side in zip([*words, "center"][:2], ("width", "height"), strict=True):
        if word in _PLACES:
            found.append(_PLACES[word] / 100 * (measure.width if side == "width" else measure.height))
            continue
        numbers_in = numbers(word)
        if not numbers_in or len(numbers_in) != 1:
            return None
        value = measure.user_units(*numbers_in[0], "width" if side == "width" else "height")
        if value is None:
            return None
        found.append(value)
    return (found[0], found[1]) if words else None


def _length(argument: tuple[float, str], measure: Measure, horizontal: bool) -> float:
    value = measure.user_units(*argument, "width" if horizontal else "height")
    if value is None:
        raise KeyError(argument[1])
    return value


def _radians(argument: tuple[float, str]) -> float:
    return math.radians(argument[0] * _DEGREES[argument[1].lower()])


def _share(argument: tuple[float, str]) -> float:
    return argument[0] * {"": 1.0, "%": 0.01}[argument[1]]


def _exactly(arguments: _Arguments, *counts: int) -> None:
    if len(arguments) not in counts:
        raise ValueError(len(arguments))


def _matrix(arguments: _Arguments, measure: Measure) -> Matrix:
    _exactly(arguments, 6)
    a, b, c, d = (_share(argument) for argument in arguments[:4])
    return (a, b, c, d, _length(arguments[4], measure, True), _length(arguments[5], measure, False))


def _matrix3d(arguments: _Arguments, _: Measure) -> Matrix:
    """What it does within the plane."""
    _exactly(arguments, 16)
    m = [_share(argument) for argument in arguments]
    return (m[0], m[1], m[4], m[5], m[12], m[13])


def _translate(arguments: _Arguments, measure: Measure) -> Matrix:
    _exactly(arguments, 1, 2, 3)
    y = _length(arguments[1], measure, False) if len(arguments) > 1 else 0.0
    return moved_by(_length(arguments[0], measure, True), y)


def _translate_y(arguments: _Arguments, measure: Measure) -> Matrix:
    _exactly(arguments, 1)
    return moved_by(0.0, _length(arguments[0], measure, False))


def _scale(arguments: _Arguments, _: Measure) -> Matrix:
    _exactly(arguments, 1, 2, 3)
    x = _share(arguments[0])
    return (x, 0.0, 0.0, _share(arguments[1]) if len(arguments) > 1 else x, 0.0, 0.0)


def _scale_x(arguments: _Arguments, _: Measure) -> Matrix:
    _exactly(arguments, 1)
    return (_share(arguments[0]), 0.0, 0.0, 1.0, 0.0, 0.0)


def _scale_y(arguments: _Arguments, _: Measure) -> Matrix:
    _exactly(arguments, 1)
    return (1.0, 0.0, 0.0, _share(arguments[0]), 0.0, 0.0)


def _rotate(arguments: _Arguments, measure: Measure) -> Matrix:
    _exactly(arguments, 1, 3)
    angle = _radians(arguments[0])
    turn: Matrix = (math.cos(angle), math.sin(angle), -math.sin(angle), math.cos(angle), 0.0, 0.0)
    if len(arguments) == 1:
        return turn
    x, y = _length(arguments[1], measure, True), _length(arguments[2], measure, False)
    return times(moved_by(x, y), times(turn, moved_by(-x, -y)))


def _skew(arguments: _Arguments, _: Measure) -> Matrix:
    _exactly(arguments, 1, 2)
    y = math.tan(_radians(arguments[1])) if len(arguments) > 1 else 0.0
    return (1.0, y, math.tan(_radians(arguments[0])), 1.0, 0.0, 0.0)


def _skew_y(arguments: _Arguments, _: Measure) -> Matrix:
    _exactly(arguments, 1)
    return (1.0, math.tan(_radians(arguments[0])), 0.0, 1.0, 0.0, 0.0)


# By their names in lower case (CSS Transforms 1 and 2); of those in space, what they do in the plane.
_FUNCTIONS: dict[str, Callable[[_Arguments, Measure], Matrix]] = {
    "matrix": _matrix,
    "matrix3d": _matrix3d,
    "translate": _translate,
    "translate3d": _translate,
    "translatex": _translate,
    "translatey": _translate_y,
    "translatez": lambda *_: IDENTITY,
    "scale": _scale,
    "scale3d": _scale,
    "scalex": _scale_x,
    "scaley": _scale_y,
    "scalez": lambda *_: IDENTITY,
    "rotate": _rotate,
    "rotatez": _rotate,
    "skew": _skew,
    "skewx": lambda arguments, measure: _skew(arguments[:1], measure),
    "skewy": _skew_y,
}
