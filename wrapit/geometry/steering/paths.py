"""Paths of arcs, and the courses that they follow.

All in units of the least radius, points as complex numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray, IntArray

ComplexArray: TypeAlias = NDArray[np.complex128]
Held: TypeAlias = Literal["pinned", "placed", "free"]


@dataclass(frozen=True, eq=False)
class Path:
    """Arcs of one length, each going on where and as the one before ends; `bends` (n,) are curvatures."""

    start: complex
    heading: float
    bends: FloatArray
    step: float

    @cached_property
    def headings(self) -> FloatArray:
        """At the ends of arcs, (n + 1,)."""
        return self.heading + self.step * np.concatenate([[0.0], np.cumsum(self.bends)])

    @cached_property
    def joints(self) -> ComplexArray:
        """Ends of arcs, (n + 1,)."""
        return self.start + np.concatenate(
            [[0.0], np.cumsum(_chord(self.headings[:-1], self.bends, self.step))]
        )

    def on(self, places: FloatArray) -> tuple[ComplexArray, FloatArray]:
        """Points and headings at places (m,), counted in arcs."""
        arc = self.arc(places)
        run = (places - arc) * self.step
        bend, heading = self.bends[arc], self.headings[arc]
        return self.joints[arc] + _chord(heading, bend, run), heading + bend * run

    def arc(self, places: FloatArray) -> IntArray:
        """Number of the arc that a place is on."""
        return np.clip(places.astype(np.int64), 0, len(self.bends) - 1)

    def moved(self, shift: complex) -> Path:
        """The path elsewhere."""
        return Path(self.start + shift, self.heading, self.bends, self.step)


@dataclass(frozen=True, eq=False)
class Course:
    """What a path has to follow: points (m,) at even lengths, headings there (unwrapped), and its ends."""

    points: ComplexArray
    headings: FloatArray
    length: float
    start: Held
    end: Held
    closed: bool = False

    def widened(self, count: int) -> FloatArray:
        """Headings with so many more at both ends: straight on, or of the other end where it is closed."""
        if not self.closed:
            return np.pad(self.headings, count, mode="edge")
        steps = np.diff(self.headings)
        around = np.take(steps, np.arange(-count, len(steps) + count), mode="wrap")
        return self.headings[0] - around[:count].sum() + np.concatenate([[0.0], np.cumsum(around)])

    @property
    def spacing(self) -> float:
        """Length between neighbouring points."""
        return self.length / (len(self.points) - 1)

    def on(self, places: FloatArray) -> tuple[ComplexArray, FloatArray]:
        """Points and headings at places (m,), counted in points."""
        number = np.arange(len(self.points))
        x, y = (np.interp(places, number, part) for part in (self.points.real, self.points.imag))
        return x + 1j * y, np.interp(places, number, self.headings)


def slopes_at(path: Path, places: FloatArray, points: ComplexArray) -> ComplexArray:
    """How points at places (m,) move with start (x, y), heading, step and each bend: (m, 4 + n)."""
    n, step = len(path.bends), path.step
    arc = path.arc(places)
    number = np.arange(n)
    # What comes after an arc turns about its end; inside, the turn grows with the length from its start.
    levers = _lever(path.headings[:-1], path.bends, np.full(n, step))
    slopes = np.empty((len(places), 4 + n), dtype=np.complex128)
    by_bend = slopes[:, 4:]
    np.multiply(
        (1j * step) * points[:, None] + 1j * (levers - step * path.joints[1:]),
        number < arc[:, None],
        out=by_bend,
    )
    run = (places - arc) * step
    by_bend[np.arange(len(places)), arc] = 1j * _lever(path.headings[arc], path.bends[arc], run)
    slopes[:, 0], slopes[:, 1] = 1, 1j
    slopes[:, 2] = 1j * (points - path.start)
    slopes[:, 3] = (points - path.start + by_bend @ path.bends) / step
    return slopes


def _chord(heading: FloatArray, bend: FloatArray, run: FloatArray | float) -> ComplexArray:
    """From start to end of an arc."""
    half = bend * run / 2
    return np.asarray(run * np.sinc(half / math.pi) * np.exp(1j * (heading + half)))


def _lever(heading: FloatArray, bend: FloatArray, run: FloatArray) -> ComplexArray:
    """∫ s exp(i (heading + bend s)) ds along an arc, by its series about the middle (to 1e-7 for 1 rad)."""
    half = bend * run / 2
    square = half * half
    across = run**3 * bend / 12 * (1 - square / 10 + square * square / 280)
    along = run * run / 2 * np.sinc(half / math.pi)
    return np.asarray(np.exp(1j * (heading + half)) * (along + 1j * across))
