"""A chain shifted sideways by a smooth function of its length."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import BezierChain, FloatArray, from_chain, unit
from wrapit.geometry.arclength import ArcLength, piece
from wrapit.geometry.arrays import IntArray, norms
from wrapit.geometry.bezier import evaluate
from wrapit.wires.beside.bulb import arc

# How near cubics come to what they stand for: a hundredth of the room that two runs have between them.
TOLERANCE_MM = 1e-4
# A longer cubic bends visibly more or less than its arc.
PIECE_RAD = math.pi / 4
# Directions and bends of either side of a joint are read so near to it: far less than anything that bends,
# far more than rounding loses.
NUDGE_MM = 1e-7
# What turns by more than this at a joint of the chain is a fold; all other bends of it are rounded.
KINK_RAD = 1e-3
# How finely σ of a ramp is found, how often it is tried, and how slowly it rises at least.
STEP_MM, ROUNDS = 0.01, 40
LEAST_GROWTH = 0.05
# Cubics are halved as long as they miss; this often, and the shortest is a millionth of the first.
MOST_HALVINGS = 20


@dataclass(frozen=True)
class Ramp:
    """Where the shift goes over from one value to another, from `start_mm` to `end_mm` of the line."""

    start_mm: float
    end_mm: float
    before_mm: float
    after_mm: float


@dataclass(frozen=True)
class Shift:
    """How far to the left a line is shifted along its length: `first_mm`, and then by ramps in order."""

    first_mm: float
    ramps: tuple[Ramp, ...] = ()


@dataclass(frozen=True, eq=False)
class Shifted:
    """A shifted chain: place `line_mm` (n,) of the line is now at `at_mm` (n,)."""

    chain: BezierChain
    line_mm: FloatArray
    at_mm: FloatArray

    def places_mm(self, line_mm: FloatArray) -> FloatArray:
        """Where places (m,) of the line are now, exactly so at those that were named as bounds."""
        return np.interp(line_mm, self.line_mm, self.at_mm)


@dataclass(frozen=True, eq=False)
class Course:
    """A line and its shift, which is smooth along the shifted line, so that this has no kinks.

    A ramp follows F(x) = 6 x⁵ - 15 x⁴ + 10 x³, whose ends have no slope and no bend. Along the line itself it
    would kink the shifted one wherever the line's curvature κ leaps: its direction is (1 - κ F, F'). So x
    follows σ, with dσ = (1 - κ F) ds: then the direction is (1, dF/dσ).
    """

    line: BezierChain
    shift: Shift

    @cached_property
    def lengths(self) -> ArcLength:
        """Places of the line by their arc lengths."""
        return ArcLength(from_chain(self.line))

    @cached_property
    def reach(self) -> FloatArray:
        """Where each cubic of the line starts, and where the last ends, in mm."""
        return np.concatenate([[0.0], np.cumsum(self.line.lengths)])

    def curvature(self, at_mm: FloatArray) -> FloatArray:
        """Signed curvature (m,) of the line at places (m,)."""
        return self.lengths.spline.curvature(self.lengths.parameter(at_mm))

    def tangents(self, at_mm: FloatArray) -> FloatArray:
        """Unit directions (m, 2) of the line."""
        return unit(self.lengths.spline.derivative(self.lengths.parameter(at_mm)))

    def shifts(self, at_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The shift (m,) to the left at places (m,) of the line, and its slope along the shifted line."""
        shift, slope = np.full(len(at_mm), self.shift.first_mm), np.zeros(len(at_mm))
        for ramp, (places, sigma) in zip(self.shift.ramps, self._ramps, strict=True):
            shift[at_mm >= ramp.end_mm] = ramp.after_mm
            on = (at_mm > ramp.start_mm) & (at_mm < ramp.end_mm)
            if not on.any():
                continue
            x = np.interp(at_mm[on], places, sigma) / sigma[-1]
            rise = ramp.after_mm - ramp.before_mm
            shift[on] = ramp.before_mm + rise * _risen(x)
            slope[on] = rise / sigma[-1] * 30 * x**2 * (1 - x) ** 2
        return shift, slope

    def room(self, at_mm: FloatArray) -> FloatArray:
        """Share (m,) of its radius that the line keeps at places (m,); none is left where it is negative."""
        return np.asarray(1 - self.curvature(at_mm) * self.shifts(at_mm)[0])

    @cached_property
    def _ramps(self) -> list[tuple[FloatArray, FloatArray]]:
        """For each ramp places of the line and σ there, both from its start; found by iteration."""
        found = []
        for ramp in self.shift.ramps:
            inner = self.reach[(self.reach > ramp.start_mm) & (self.reach < ramp.end_mm)]
            steps = max(8, math.ceil((ramp.end_mm - ramp.start_mm) / STEP_MM))
            places = np.union1d(np.linspace(ramp.start_mm, ramp.end_mm, steps + 1), inner)
            curvature = self.curvature((places[:-1] + places[1:]) / 2)
            sigma = places - places[0]
            for _ in range(ROUNDS):
                x = (sigma[:-1] + sigma[1:]) / 2 / sigma[-1]
                shift = ramp.before_mm + (ramp.after_mm - ramp.before_mm) * _risen(x)
                # A line that bends too tightly for its shift is found by its room; σ must rise all the same.
                growth = np.maximum(1 - curvature * shift, LEAST_GROWTH) * np.diff(places)
                sigma = np.concatenate([[0.0], np.cumsum(growth)])
            found.append((places, sigma))
        return found

    def at(self, at_mm: FloatArray, inward_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Shifted places (m, 2) and their derivatives (m, 2), seen from inside where at a joint."""
        inside = self.lengths.parameter(at_mm + inward_mm)
        along = unit(self.lengths.spline.derivative(inside))
        shift, slope = self.shifts(at_mm)
        left = np.column_stack([-along[:, 1], along[:, 0]])
        points = self.lengths.spline.at(self.lengths.parameter(at_mm)) + shift[:, None] * left
        growth = 1 - self.lengths.spline.curvature(inside) * shift
        return points, growth[:, None] * (along + slope[:, None] * left)

    def cubics(self, start_mm: FloatArray, end_mm: FloatArray) -> list[FloatArray]:
        """The shifted line from places (n,) to places (n,): cubics (k, 4, 2) for each in Hermite form.

        No joint of the line lies between any two. All are looked at together, and those that miss are halved.
        """
        owner, low, high = np.arange(len(start_mm)), start_mm, end_mm
        settled: list[tuple[IntArray, FloatArray, FloatArray]] = []
        for halvings in range(MOST_HALVINGS):
            at_end = low == start_mm[owner], high == end_mm[owner]
            cubics, misses = self._hermite(low, high, *at_end)
            done = np.full(len(low), halvings == MOST_HALVINGS - 1) | ~misses
            settled.append((owner[done], low[done], cubics[done]))
            middle = ((low + high) / 2)[~done]
            owner = np.repeat(owner[~done], 2)
            low = np.column_stack([low[~done], middle]).ravel()
            high = np.column_stack([middle, high[~done]]).ravel()
            if not len(low):
                break
        owners, lows, found = (np.concatenate(each) for each in zip(*settled, strict=True))
        order = np.lexsort([lows, owners])
        return np.split(found[order], np.flatnonzero(np.diff(owners[order])) + 1) if len(found) else []

    def _hermite(
        self, low: FloatArray, high: FloatArray, first: NDArray[np.bool_], last: NDArray[np.bool_]
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Cubics (n, 4, 2) between places (n,), and which of them miss the tolerance.

        `first` and `last` say where a joint may be at one's start or end: it is seen from inside there.
        """
        step = high - low
        nudge = np.minimum(NUDGE_MM, step / 4)
        a, leaving = self.at(low, nudge * first)
        b, arriving = self.at(high, -nudge * last)
        cross = leaving[:, 0] * arriving[:, 1] - leaving[:, 1] * arriving[:, 0]
        turn = np.abs(np.arctan2(cross, (leaving * arriving).sum(axis=1)))
        # So long are the handles of an arc's cubic; they are thirds where it doesn't turn.
        third = step / 3 * np.where(turn > 1e-6, np.tan(turn / 4) / np.maximum(turn / 4, 1e-9), 1.0)
        cubics = np.stack([a, a + third[:, None] * leaving, b - third[:, None] * arriving, b], axis=1)
        t = np.array([0.25, 0.5, 0.75])
        between = (low[:, None] + t * step[:, None]).ravel()
        true, ahead = self.at(between, np.zeros(len(between)))
        apart = evaluate(cubics, t).reshape(-1, 2) - true
        ahead = unit(ahead)
        off = np.abs(ahead[:, 0] * apart[:, 1] - ahead[:, 1] * apart[:, 0]).reshape(-1, len(t)).max(axis=1)
        return cubics, (off > TOLERANCE_MM) | (turn > PIECE_RAD)


def shifted(course: Course, bounds_mm: Sequence[float] = ()) -> Shifted:
    """The line, shifted; where it isn't, it stays as it is. At a fold it goes half round the tip.

    `bounds_mm` are places of the line whose new ones must be exact.
    """
    line, reach, shift = course.line, course.reach, course.shift
    ramps = [place for ramp in shift.ramps for place in (ramp.start_mm, ramp.end_mm)]
    own = np.clip([*bounds_mm, *ramps], 0.0, reach[-1])
    breaks = _apart(np.unique(np.concatenate([reach, own])), reach)
    starts, ends = breaks[:-1], breaks[1:]
    plain = np.all([course.shifts((1 - t) * starts + t * ends)[0] == 0 for t in (0, 0.5, 1)], axis=0)
    moved = iter(course.cubics(starts[~plain], ends[~plain]))
    before, after = course.tangents(breaks - NUDGE_MM), course.tangents(breaks + NUDGE_MM)
    aside_mm = course.shifts(breaks)[0]
    parts: list[FloatArray] = []
    at_mm = [0.0]
    for index, stays in enumerate(plain):
        points = piece(line, starts[index], ends[index]).points.copy() if stays else next(moved).copy()
        points[1:, 0] = points[:-1, 3]  # two cubics may see their joint differently in the last bit
        length_mm = BezierChain(points).length
        if parts:
            end = parts[-1][-1, 3]
            tip = _round_the_tip(before[index], after[index], end, points[0, 0], float(aside_mm[index]))
            at_mm[-1] += tip.length if tip is not None else 0.0
            parts += [tip.points] if tip is not None else []
            points[0, 0] = parts[-1][-1, 3]
        parts.append(points)
        at_mm.append(at_mm[-1] + length_mm)
    points = np.concatenate(parts)
    points[1:, 0] = points[:-1, 3]
    return Shifted(BezierChain(points), breaks, np.array(at_mm))


def _apart(breaks: FloatArray, reach: FloatArray) -> FloatArray:
    """The breaks without those that all but repeat a joint of the line, or the one before."""
    near = np.abs(breaks[:, None] - reach).min(axis=1)
    kept = (near == 0) | (near > 1e-5)
    kept[1:] &= (np.diff(breaks) > 1e-5) | (near[1:] == 0)
    return breaks[kept]


def _round_the_tip(
    before: FloatArray, after: FloatArray, end: FloatArray, start: FloatArray, shift_mm: float
) -> BezierChain | None:
    """Half a circle round the tip of a fold; nothing where the line goes on smoothly."""
    bend = math.atan2(before[0] * after[1] - before[1] * after[0], float(before @ after))
    if abs(bend) < KINK_RAD or float(norms(end - start)) < NUDGE_MM:
        return None
    heading = math.atan2(before[1], before[0])
    points = arc(end, heading, abs(shift_mm), -math.copysign(math.pi, shift_mm)).points.copy()
    points[-1, 3] = start
    return BezierChain(points)


def _risen(x: FloatArray) -> FloatArray:
    return np.asarray(x**3 * (10 - 15 * x + 6 * x**2))
