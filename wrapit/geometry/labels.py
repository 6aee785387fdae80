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
    placed = list(taken)
    for text, anchors in wanted:
        half = np.array([max(len(text), 1) * DIGIT_WIDTH / 2 + PADDING, 0.5 + PADDING]) * text_mm
        placed.append(_place(text, anchors, half, ink, placed))
    return tuple(placed[len(taken) :])


def _place(
    text: str,
    anchors: FloatArray,
    half: FloatArray,
    ink: FloatArray,
    placed: Sequence[Label],
) -> Label:
    text_mm = float(half[1]) / (0.5 + PADDING)
    boxes = np.array([[*label.centre, *label.half_size] for label in placed]).reshape(-1, 4)
    fallback: tuple[int, FloatArray, FloatArray, int] | None = None
    for ring in range(200):
        for anchor in anchors:
            # The support of the box in each direction keeps its nearest side at one distance.
            reach = np.abs(_DIRECTIONS) @ half + text_mm * (0.15 + 0.45 * ring)
            centres = anchor + _DIRECTIONS * reach[:, None]
            free = ~_overlaps(centres, half, boxes)
            if not free.any():
                continue
            around = np.abs(ink - anchor).max(axis=1) < float(reach.max() + 2 * half.max())
            hits = np.where(free, _hits(centres, half, ink[around]), len(ink) + 1)
            best = int(np.argmin(hits))
            if hits[best] == 0:
                return _label(text, centres[best], half, anchor, ring)
            if fallback is None or hits[best] < fallback[0]:
                fallback = int(hits[best]), centres[best], anchor, ring
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


def _overlaps(centres: FloatArray, half: FloatArray, boxes: FloatArray) -> BoolArray:
    apart = np.abs(centres[:, None] - boxes[None, :, :2]) >= half + boxes[None, :, 2:]
    return np.asarray(~np.all(np.any(apart, axis=2), axis=1))


def _hits(centres: FloatArray, half: FloatArray, ink: FloatArray) -> IntArray:
    return (np.abs(ink[None] - centres[:, None]) < half).all(axis=2).sum(axis=1)
