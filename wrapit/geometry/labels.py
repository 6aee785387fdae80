"""Places for short labels beside curves: no two overlap, and ink is avoided where there is room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray, IntArray

BoolArray: TypeAlias = NDArray[np.bool_]

# Width of a digit and padding around a label, as shares of the text height.
DIGIT_WIDTH = 0.62
PADDING = 0.18
_ANGLES = np.arange(16) * (np.pi / 8) + np.pi / 4
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])


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
) -> tuple[Label, ...]:
    """A label for each (text, anchors (m, 2), best first), in that order.

    `ink` (n, 2) are points to keep clear of; `taken` are labels placed before. Labels never overlap one
    another: candidates lie on growing rings around each anchor, and the rings grow until one is free.
    """
    first = len(taken)
    boxes = np.empty((first + len(wanted), 4))
    boxes[:first] = np.array([_box(label) for label in taken]).reshape(-1, 4)
    sorted_ink = ink[np.argsort(ink[:, 0], kind="stable")]
    placed: list[Label] = []
    for text, anchors in wanted:
        half = np.array([max(len(text), 1) * DIGIT_WIDTH / 2 + PADDING, 0.5 + PADDING]) * text_mm
        placed.append(_place(text, anchors, half, sorted_ink, boxes[: first + len(placed)]))
        boxes[first + len(placed) - 1] = _box(placed[-1])
    return tuple(placed)


def _box(label: Label) -> tuple[float, float, float, float]:
    return (*label.centre, *label.half_size)


def _place(
    text: str,
    anchors: FloatArray,
    half: FloatArray,
    ink: FloatArray,
    boxes: FloatArray,
) -> Label:
    """`ink` is sorted by x; `boxes` (k, 4) are centres and half sizes of the labels placed before."""
    text_mm = float(half[1]) / (0.5 + PADDING)
    fallback: tuple[int, FloatArray, FloatArray, int] | None = None
    for ring in range(200):
        # The support of the box in each direction keeps its nearest side at one distance.
        reach = np.abs(_DIRECTIONS) @ half + text_mm * (0.15 + 0.45 * ring)
        centres = (anchors[:, None] + _DIRECTIONS * reach[:, None]).reshape(-1, 2)
        low, high = centres.min(axis=0) - half, centres.max(axis=0) + half
        free = ~_overlaps(centres, half, _boxes_within(boxes, low, high))
        if free.any():
            hits = np.full(len(centres), len(ink) + 1)
            hits[free] = _hits(centres[free], half, _ink_within(ink, low, high))
            best = int(np.argmin(hits))
            if fallback is None or hits[best] < fallback[0]:
                fallback = int(hits[best]), centres[best], anchors[best // len(_DIRECTIONS)], ring
            if hits[best] == 0:
                return _label(text, fallback[1], half, fallback[2], ring)
        if fallback is not None and ring >= 8:
            return _label(text, fallback[1], half, fallback[2], fallback[3])
    raise ValueError(f"no free place within 200 rings for label {text!r}")


def _label(text: str, centre: FloatArray, half: FloatArray, anchor: FloatArray, ring: int) -> Label:
    return Label(
        text,
        (float(centre[0]), float(centre[1])),
        (float(half[0]), float(half[1])),
        (float(anchor[0]), float(anchor[1])),
        ring >= 2,
    )


def _boxes_within(boxes: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    apart = np.abs(boxes[:, :2] - (low + high) / 2) > (high - low) / 2 + boxes[:, 2:]
    return boxes[~apart.any(axis=1)]


def _ink_within(ink: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    first, last = np.searchsorted(ink[:, 0], (low[0], high[0]))
    strip = ink[first:last]
    return strip[(strip[:, 1] > low[1]) & (strip[:, 1] < high[1])]


def _overlaps(centres: FloatArray, half: FloatArray, boxes: FloatArray) -> BoolArray:
    apart = np.abs(centres[:, None] - boxes[None, :, :2]) >= half + boxes[None, :, 2:]
    return np.asarray(~np.all(np.any(apart, axis=2), axis=1))


def _hits(centres: FloatArray, half: FloatArray, ink: FloatArray) -> IntArray:
    return (np.abs(ink[None] - centres[:, None]) < half).all(axis=2).sum(axis=1)
