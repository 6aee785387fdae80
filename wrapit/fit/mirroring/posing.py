"""The pose in which a sketch is worked on: the same however it lies, is numbered, and its lines run."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.bezier import derivative, evaluate

# The eight ways to lay a sheet on a square: exact in floating point, and so undone to the last bit.
_POSES: Final = tuple(
    np.diag(signs) @ axes
    for axes in (np.eye(2), np.eye(2)[::-1])
    for signs in itertools.product((1.0, -1.0), repeat=2)
)
# Moments of these powers of x and y tell poses apart, in this order: which way a figure is wider, heavier,
# slanted. What is alike in all of them is a figure with a symmetry of its own.
_POWERS: Final = np.array(
    [(2, 0), (3, 0), (0, 3), (1, 1), (2, 1), (1, 2), (3, 1), (1, 3), (5, 0), (0, 5), (4, 1), (1, 4)]
)
# Moments of a figure of size one that differ by less are equal: sums in another order differ by 1e-15, twins
# that were read apart by a hundredth of a millimetre by 1e-4.
_DIGITS: Final = 7
# Each cubic is looked at in so many places, alike from both its ends.
_PARAMETERS: Final = (np.arange(6) + 0.5) / 6
# How exactly lines are put in order at first (digits of mm): what a figure that was read anew differs by.
_PLACE_DIGITS: Final = 6


def posed(sketch: Sketch) -> tuple[Sketch, FloatArray]:
    """The sketch in its pose, numbered by where its parts lie there, and the matrix (2, 2) for that.

    A figure, its mirror image and the figure turned by right angles about the origin are the same there to
    the last bit. Of poses in which a figure looks the same, the places of its lines decide, and then which
    is the first: not its last bits, which may be others on another machine.
    """
    laid = [(_laid(sketch, matrix), matrix) for matrix in _poses(sketch)]
    lines, matrix = min(laid, key=lambda each: [_place(line) for line in each[0]]) if laid[1:] else laid[0]
    names: dict[int, int] = {}
    for line in lines:
        for node in (line.start, line.end):
            names.setdefault(node, len(names))
    return Sketch(
        {name: sketch.nodes[node] @ matrix + 0.0 for node, name in names.items()},
        {n: replace(line, start=names[line.start], end=names[line.end]) for n, line in enumerate(lines)},
        _moved(sketch.removed, matrix),
    ), matrix


def unposed(sketch: Sketch, matrix: FloatArray) -> Sketch:
    """The sketch as it lay before it was put into its pose; numbers stay."""
    back = matrix.T
    lines = {n: replace(line, curve=_turned(line.curve, back)) for n, line in sketch.lines.items()}
    nodes = {node: point @ back + 0.0 for node, point in sketch.nodes.items()}
    return Sketch(nodes, lines, _moved(sketch.removed, back))


def _poses(sketch: Sketch) -> list[FloatArray]:
    """Of the eight poses those with the greatest moments: one, but for figures with a symmetry."""
    cubics = np.concatenate([line.curve.points for line in sketch.lines.values()])
    points = evaluate(cubics, _PARAMETERS)
    steps = np.linalg.norm(derivative(cubics, _PARAMETERS), axis=-1).ravel()
    points = points.reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    x, y = ((points - (low + high) / 2) / float((high - low).max())).T
    table = (np.vander(x, 6, increasing=True) * steps[:, None]).T @ np.vander(y, 6, increasing=True)
    rounded = np.round(table / steps.sum(), _DIGITS)

    def moments(matrix: FloatArray) -> list[float]:
        """Those of the figure in a pose are those of the figure, but for signs and for which is x."""
        signs = np.prod(matrix.sum(axis=0) ** _POWERS, axis=1)
        of_x, of_y = (_POWERS if matrix[0, 0] else _POWERS[:, ::-1]).T
        return [float(each) for each in signs * rounded[of_x, of_y]]

    every = [moments(matrix) for matrix in _POSES]
    return [matrix for matrix, each in zip(_POSES, every, strict=True) if each == max(every)]


def _laid(sketch: Sketch, matrix: FloatArray) -> list[Line]:
    """The lines in a pose, each travelled from its lower end, by where they lie."""
    lines = [_forwards(replace(line, curve=_turned(line.curve, matrix))) for line in sketch.lines.values()]
    return sorted(lines, key=_rank)


def _turned(curve: BezierChain, matrix: FloatArray) -> BezierChain:
    """The curve in a pose; no zero is negative, as directions of level lines would tell them apart."""
    return BezierChain(curve.points @ matrix + 0.0)


def _forwards(line: Line) -> Line:
    """The line travelled from its lower end; a ring from its lower handle."""
    back = line.reversed()
    return min(line, back, key=_rank)


def _rank(line: Line) -> tuple[list[float], list[float]]:
    """What lines are ordered by: where they lie, so far as that is certain, and then by the last bit."""
    return _place(line), line.curve.points.ravel().tolist()


def _place(line: Line) -> list[float]:
    """Where a line lies, as every machine reads it."""
    return [float(each) for each in np.round(line.curve.points, _PLACE_DIGITS).ravel() + 0.0]


def _moved(removed: tuple[Removal, ...], matrix: FloatArray) -> tuple[Removal, ...]:
    places = [np.array(removal.at) @ matrix + 0.0 for removal in removed]
    return tuple(replace(r, at=(float(x), float(y))) for r, (x, y) in zip(removed, places, strict=True))
