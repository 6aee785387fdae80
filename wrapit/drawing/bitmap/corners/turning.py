"""Where a line turns: how much at each point, where most, and where it does so without a pause."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.geometry import FloatArray

# In stroke widths.
# Between which points is turning looked for? From 0.8 to 1.7 on either side: the chord over a width.
_NEAR = 0.8
_PROBE = 1.7
# And between which, where turns are close? Nearer points see two turns a width and a half apart as two.
# Measured on 80 strokes of two corners, 65 to 115 degrees, 1.2 to 3 apart between arcs, 6 to 24 px wide, of
# which 32 come out right (24 without), and on as many with bends of 0.45 to 1 (51 and 51). Not varied alone.
_CLOSE_NEAR = 0.35
_CLOSE_PROBE = 0.9
# How far beside a corner do its sides turn as they do? Where the corner itself is hardly seen. Of 288 rows of
# three cusps (`tests.bench cusps`) 188 come out right, with 1.5 fewer; without all this 53.
_BESIDE = 1.1
# How far is its echo? There the arcs turn otherwise than the corner beside them. (1.5 does as well.)
_ECHO = 2.0
# What does a corner turn at least that its arcs hide? Less is what straight lines do by a hair.
_LEAST_RAD = math.radians(10)
# Where does a crowd of corners end? Where the line turns less than this, over this length: two corners with
# opposite turns cancel each other in between. Parting those that no chain fits once more, at shorter pauses,
# gets 4 of 200 chains more, and takes three times as long on real drawings.
_CALM_RAD = math.radians(14)
_PAUSE = 1.3
# How long may a crowd be? Eight corners three widths apart, less the last. Longer ones end at shorter pauses
# of what nearer points see: an F in outline is one crowd of twelve corners. With 0.8 three of them are lost.
LONGEST = 20
_SHORT_PAUSE = 0.4
# Which are close? Two nearer than this, of which one is as sharp as corners are: bends of 1.6 turn by less.
_TWINS = 2.4
# How near to each other are two tops one? With a width, the gentler of two is lost.
_CLOSE_TOPS = 0.7
_SHARP_RAD = math.radians(45)
# How near to the end of a line? There are no sides within a width and a quarter.
_MARGIN = 1.25
# What turn is worth a look? Less is the hand's; the config's own `corner_angle` is 60 degrees. 20 or 36
# change the Béziers by two in 242.
SEEN_RAD = math.radians(28)


def turning(
    line: Line, width_px: float, first: int, last: int, probes: tuple[float, float] = (_NEAR, _PROBE)
) -> FloatArray:
    """How much the line turns at each of its points, in radians; nothing near the ends of a stretch."""
    return np.abs(_signed_turning(line, width_px, first, last, probes))


def _signed_turning(
    line: Line, width_px: float, first: int, last: int, probes: tuple[float, float]
) -> FloatArray:
    # The points are evenly spaced, so lengths are counts.
    along = line.along
    step = max(line.length / (len(along) - 1), 1e-6)
    near, far = max(1, round(probes[0] * width_px / step)), max(2, round(probes[1] * width_px / step))
    margin = _MARGIN * width_px
    turn = np.zeros(len(along))
    inner = np.flatnonzero((along >= along[first] + margin) & (along <= along[last] - margin))

    def at(shift: int) -> FloatArray:
        return line.points[np.minimum(np.maximum(inner + shift, first), min(last, len(along) - 1))]

    before, after = at(-near) - at(-far), at(far) - at(near)
    turn[inner] = np.arctan2(
        before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1)
    )
    return turn


def kinks(line: Line, width_px: float, first: int, last: int) -> list[int]:
    """The points where the line turns one way between sides that turn the other.

    What the arcs turn hides what such a corner turns. Where two are close by, neither is told.
    """
    turn = _signed_turning(line, width_px, first, last, (_CLOSE_NEAR, _CLOSE_PROBE))
    inner = np.flatnonzero(turn)
    if not len(inner):
        return []
    beside = round(_BESIDE * width_px * (len(turn) - 1) / max(line.length, 1e-6))
    at = np.arange(len(turn))
    around = turn[np.clip(at - beside, inner[0], inner[-1])] + turn[np.clip(at + beside, inner[0], inner[-1])]
    kink = np.abs(turn - around / 2)
    against = (turn * around < 0) & (np.abs(turn) > _LEAST_RAD) & (kink > _SHARP_RAD)
    if not against.any():
        return []
    hidden = tops(line, np.where(against, kink, 0.0), _ECHO * width_px)
    close = tops(line, np.abs(turn), _CLOSE_TOPS * width_px)

    def twin(one: int, other: int) -> bool:
        apart = abs(line.along[one] - line.along[other]) / width_px
        return bool(_CLOSE_TOPS < apart < _TWINS and turn[one] * turn[other] > 0)

    return [kink for kink in hidden.tolist() if not any(twin(kink, other) for other in close)]


def tops(line: Line, turn: FloatArray, width_px: float) -> NDArray[np.intp]:
    """The points where the line turns most, and by enough to be worth a look."""
    if turn.max() <= SEEN_RAD:
        return np.zeros(0, dtype=np.intp)
    reach = max(1, int(width_px * (len(turn) - 1) / max(line.length, 1e-6)))
    peak = np.lib.stride_tricks.sliding_window_view(np.pad(turn, reach), 2 * reach + 1).max(axis=1)
    return np.flatnonzero((turn == peak) & (turn > SEEN_RAD))


def twins(line: Line, width_px: float, first: int, last: int) -> list[tuple[int, int]]:
    """Pairs of turns too close to each other for either to have two sides of its own."""
    turn = turning(line, width_px, first, last, (_CLOSE_NEAR, _CLOSE_PROBE))
    most = tops(line, turn, _CLOSE_TOPS * width_px)
    return [
        (int(a), int(b))
        for a, b in itertools.pairwise(most)
        if line.along[b] - line.along[a] < _TWINS * width_px and max(turn[a], turn[b]) > _SHARP_RAD
    ]


def crowds(
    line: Line, turn: FloatArray, tops: NDArray[np.intp], width_px: float, pause: float = _PAUSE
) -> list[tuple[int, int]]:
    """First and last point of each stretch in which the line turns without a pause, and that has a top."""
    restless = np.flatnonzero(turn >= _CALM_RAD)
    if not len(restless):
        return []
    parted = np.flatnonzero(np.diff(line.along[restless]) > pause * width_px)
    starts = restless[np.concatenate([[0], parted + 1]).astype(np.intp)]
    ends = restless[np.concatenate([parted, [len(restless) - 1]]).astype(np.intp)]
    last = len(turn) - 1
    return [
        (max(int(start) - 1, 0), min(int(end) + 1, last))
        for start, end in zip(starts, ends, strict=True)
        if ((tops >= start) & (tops <= end)).any()
    ]


def parted(line: Line, width_px: float, stretches: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The same, those too long for a chain in parts: nearer points see shorter pauses."""
    parts: list[tuple[int, int]] = []
    for start, end in stretches:
        if line.along[end] - line.along[start] <= LONGEST * width_px:
            parts.append((start, end))
            continue
        turn = turning(line, width_px, 0, len(line.points) - 1, (_CLOSE_NEAR, _CLOSE_PROBE))
        turn[:start] = turn[end + 1 :] = 0.0
        parts += crowds(line, turn, tops(line, turn, _CLOSE_TOPS * width_px), width_px, _SHORT_PAUSE)
    return parts
