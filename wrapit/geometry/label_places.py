"""Places for short labels beside curves: no two overlap, and ink is avoided where there is room."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray, IntArray

BoolArray: TypeAlias = NDArray[np.bool_]

# Width of a digit and padding around a label, as shares of the text height.
DIGIT_WIDTH = 0.62
PADDING = 0.18
# Where a label is tried: in sixteen directions, first up and to the right, as on maps, on ever wider rings.
_ANGLES = np.arange(16) * (np.pi / 8) + np.pi / 4
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
# Only a bound: sixty labels at one point all found room within it.
_MOST_RINGS = 200


@dataclass(frozen=True)
class Label:
    """A placed label; `anchor` is what it names, `leader` says that a line should join the two."""

    text: str
    centre: tuple[float, float]
    half_size: tuple[float, float]
    anchor: tuple[float, float]
    leader: bool


def place_labels(
    wanted: Sequence[tuple[str, FloatArray]],
    ink: FloatArray,
    text_mm: float,
    taken: Sequence[Label] = (),
    rings: int | None = None,
) -> tuple[Label, ...]:
    """A label for each (text, anchors (m, 2), best first), in that order.

    `ink` (n, 2) are points to keep clear of; `taken` are labels placed before. Labels never overlap one
    another: candidates lie on growing rings around each anchor, and the rings grow until one is free. With
    `rings`, a label that finds no place within so many is left out.
    """
    field = _Field(ink, text_mm)
    for earlier in taken:
        field.add(earlier)
    for text, anchors in wanted:
        half = np.array([max(len(text), 1) * DIGIT_WIDTH / 2 + PADDING, 0.5 + PADDING]) * text_mm
        label = _place(text, anchors, half, field, text_mm, rings or _MOST_RINGS)
        if label is not None:
            field.add(label)
        elif rings is None:
            raise ValueError(f"no free place within {_MOST_RINGS} rings for label {text!r}")
    return tuple(field.labels[len(taken) :])


class _Field:
    """Ink and placed labels, by place: what is far away is never looked at."""

    def __init__(self, ink: FloatArray, text_mm: float) -> None:
        from scipy.spatial import cKDTree

        self.labels: list[Label] = []
        self.ink = ink
        self._tree = cKDTree(ink) if len(ink) else None
        self._cell_mm = 4 * text_mm
        self._cells: dict[tuple[int, int], list[int]] = {}
        self._boxes: list[tuple[float, float, float, float]] = []

    def add(self, label: Label) -> None:
        """A label that others keep clear of."""
        (x, y), (half_x, half_y) = label.centre, label.half_size
        for cell in self._between(x - half_x, y - half_y, x + half_x, y + half_y):
            self._cells.setdefault(cell, []).append(len(self._boxes))
        self._boxes.append((x, y, half_x, half_y))
        self.labels.append(label)

    def boxes_near(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Boxes (n, 4) of the labels in the cells of a rectangle: centres and half sizes."""
        found = {each for cell in self._between(*low, *high) for each in self._cells.get(cell, ())}
        return np.array([self._boxes[each] for each in sorted(found)]).reshape(-1, 4)

    def ink_in(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Points (n, 2) of the ink in a square that holds this rectangle."""
        if self._tree is None:
            return self.ink
        middle, reach = (low + high) / 2, float((high - low).max()) / 2
        return self.ink[self._tree.query_ball_point(middle, reach * (1 + 1e-9), p=np.inf)]

    def _between(self, left: float, low: float, right: float, high: float) -> Iterator[tuple[int, int]]:
        columns = range(int(left // self._cell_mm), int(right // self._cell_mm) + 1)
        rows = range(int(low // self._cell_mm), int(high // self._cell_mm) + 1)
        return itertools.product(columns, rows)


def _place(
    text: str, anchors: FloatArray, half: FloatArray, field: _Field, text_mm: float, rings: int
) -> Label | None:
    fallback: tuple[int, Label] | None = None
    for ring in range(rings):
        # The support of the box in each direction keeps its nearest side at one distance.
        reach = np.abs(_DIRECTIONS) @ half + text_mm * (0.15 + 0.45 * ring)
        room = False
        # One anchor after the other: those of a long curve lie far apart, with much ink between them.
        for anchor in anchors:
            best = _best(anchor + _DIRECTIONS * reach[:, None], half, field)
            if best is None:
                continue
            room, (hits, centre) = True, best
            if hits == 0:
                return _label(text, centre, half, anchor, ring)
            if fallback is None or hits < fallback[0]:
                fallback = hits, _label(text, centre, half, anchor, ring)
        if room and fallback is not None and ring >= 8:
            return fallback[1]
    return None


def _best(centres: FloatArray, half: FloatArray, field: _Field) -> tuple[int, FloatArray] | None:
    """The first of the free places with the fewest points of ink, and how many; None where none is free."""
    low, high = centres.min(axis=0) - half, centres.max(axis=0) + half
    free = centres[~_overlaps(centres, half, field.boxes_near(low, high))]
    if not len(free):
        return None
    hits = _hits(free, half, field.ink_in(low, high))
    first = int(np.argmin(hits))
    return int(hits[first]), free[first]


def _label(text: str, centre: FloatArray, half: FloatArray, anchor: FloatArray, ring: int) -> Label:
    return Label(
        text,
        (float(centre[0]), float(centre[1])),
        (float(half[0]), float(half[1])),
        (float(anchor[0]), float(anchor[1])),
        ring >= 2,
    )


def _overlaps(centres: FloatArray, half: FloatArray, boxes: FloatArray) -> BoolArray:
    apart = np.abs(centres[:, None] - boxes[None, :, :2]) >= half + boxes[None, :, 2:]
    return np.asarray(~np.all(np.any(apart, axis=2), axis=1))


def _hits(centres: FloatArray, half: FloatArray, ink: FloatArray) -> IntArray:
    return (np.abs(ink[None] - centres[:, None]) < half).all(axis=2).sum(axis=1)
