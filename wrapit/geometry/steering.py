"""The path nearest to given points whose curvature stays within a bound: a car's, whose wheels turn only so far.

All in units of the least radius, points as complex numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry.arrays import FloatArray

ComplexArray: TypeAlias = NDArray[np.complex128]
Held: TypeAlias = Literal["pinned", "placed", "free"]

# Bends stay below one by what cubics add to an arc of 50 degrees (0.2 %), and a little.
MOST_BEND: Final = 1 / 1.004
# From here an arc counts as one at full lock.
NEARLY: Final = 1e-9
# Bound of the last step, which only meets the ends: without room its sets of arcs at full lock may go round.
LAST_BEND: Final = 1 / 1.0022
# Length of the arcs that a path is made of: 40 degrees at full lock. Half of it gains 1 % of the deviation.
STEP: Final = 0.7
# Rounds of Gauss and Newton: most windows move by less than SETTLED in a round after 6 to 12.
ROUNDS: Final = 24
SOFTER, EASING, MOST_GAP = 0.3, 0.2, 0.5
STIFF, STIFFENING = 1e-5, 2.0
SETTLED: Final = 5e-3
# Ends and headings are met to this.
CLOSED: Final = 1e-9
CLOSING: Final = 8
# Share of the distance along the path that counts beside the one square to it: keeps feet from sliding away.
ALONG: Final = 0.5
# Weights that settle what points leave open: change of bends in a round, and from arc to arc.
DAMPING: Final = 1e-3
EVENNESS: Final = 1e-4
# Headings turn by no more than this (rad) in a round, beyond which a linear view of the path is worth little.
MOST_TURN: Final = 0.7
# Conditions yield by so much of what it takes to keep them: solvable even where all arcs are at full lock.
YIELDING: Final = 1e-8
# How often the set of arcs at full lock is mended in a round.
MOST_SETS: Final = 12


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

    def arc(self, places: FloatArray) -> NDArray[np.int64]:
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
        """Headings with so many before and after: of the other end where it is closed, otherwise straight on."""
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


@dataclass(frozen=True, eq=False)
class Feet:
    """Which place of the path is nearest to each point of the course, and which of the course to its own places."""

    own: FloatArray
    on_path: FloatArray
    on_course: FloatArray

    @classmethod
    def first(cls, path: Path, course: Course) -> Feet:
        """As far along one as along the other."""
        n, m = len(path.bends), len(course.points)
        own = np.arange(2 * n + 1) / 2
        return cls(own, np.linspace(0.0, n, m), np.linspace(0.0, m - 1, len(own)))

    def nearer(self, path: Path, course: Course) -> Feet:
        """After the path was moved."""
        on_path = _feet(path, course.points, self.on_path)
        return Feet(self.own, on_path, _feet_on(course, path.on(self.own)[0], self.on_course))


def steered(course: Course) -> Path | None:
    """The path nearest to a course in the least squares of the course's distances; None if no path is found."""
    path = _first(course)
    feet = Feet.first(path, course)
    for number in range(ROUNDS):
        moved = _nearer(path, course, feet, SOFTER * EASING**number, STIFF * STIFFENING**number)
        if moved is None:
            return None
        change = float(np.abs(moved.joints - path.joints).max())
        path, feet = moved, feet.nearer(moved, course)
        if change < SETTLED:
            break
    return _closed(path, course)


def _closed(path: Path, course: Course) -> Path | None:
    """The path with its ends met exactly by the least change of bends, None if that takes too long."""
    n = len(path.bends)
    # Where the path starts costs next to nothing, or its two ends would not be treated alike; full lock stays.
    locked = np.abs(path.bends) > MOST_BEND - NEARLY
    square = np.diag(np.concatenate([np.full(3, 1e-9), [1.0], np.where(locked, 1e6, 1.0)]))
    for _ in range(CLOSING):
        places = np.array([0, n // 2, n])
        slopes = _slopes(path, places.astype(np.float64), path.joints[places])
        conditions, missing = _conditions(path, course, slopes[[0, 2]])
        if np.abs(missing).max(initial=0.0) < CLOSED:
            return path
        step = _within_bounds(square, np.zeros(4 + n), conditions, missing, path.bends, LAST_BEND)
        path = _stepped(path, step, slopes[1], LAST_BEND)
    return None


def _first(course: Course) -> Path:
    """The course's headings, evened out until they turn slowly enough, followed from end to end."""
    count = 2 * max(2, math.ceil(course.length / STEP / 2))
    step, m = course.length / count, len(course.points)
    if course.closed:  # long enough to come round
        step = max(step, abs(course.headings[-1] - course.headings[0]) / count / MOST_BEND)
    low, high, headings = 0, 4 * m, course.headings
    fine = course.spacing
    while high - low > 1:  # the narrowest window that does
        half = (low + high) // 2
        wide = course.widened(half)
        total = np.concatenate([[0.0], np.cumsum(wide)])
        evened = (total[2 * half + 1 :] - total[: -2 * half - 1]) / (2 * half + 1)
        if np.abs(np.diff(evened)).max() <= fine:
            high, headings = half, evened
        else:
            low = half
    at = np.interp(np.linspace(0, m - 1, count + 1), np.arange(m), headings)
    path = Path(0j, float(at[0]), np.clip(np.diff(at) / step, -MOST_BEND, MOST_BEND), step)
    points = path.on(np.linspace(0.0, count, m))[0]
    return path.moved(complex((course.points - points).mean()))


def _nearer(path: Path, course: Course, feet: Feet, softer: float, stiff: float) -> Path | None:
    """One round: the best path as far as a linear view of it goes, bends within the bound, ends as held."""
    n = len(path.bends)
    # Distances from the course to the path, across the path, and from the path to the course, across the course.
    places = np.concatenate([feet.on_path, feet.own])
    points, headings = path.on(places)
    back, ways = course.on(feet.on_course)
    turned = np.exp(-1j * np.concatenate([headings[: len(course.points)], ways]))
    slopes_at = _slopes(path, places, points)
    slopes = slopes_at * turned[:, None]
    off = (np.concatenate([course.points, back]) - points) * turned
    rows = np.concatenate([slopes.imag, ALONG * slopes.real])
    rest = np.concatenate([off.imag, ALONG * off.real])
    share = course.spacing
    square, pull = share * rows.T @ rows, share * rows.T @ rest
    bends = np.arange(4, 4 + n)
    square[bends, bends] += DAMPING + softer + stiff
    change = np.diff(np.eye(n), axis=0)
    even = EVENNESS + softer
    square[4:, 4:] += even * change.T @ change
    pull[4:] -= even * change.T @ (change @ path.bends)
    ends = slopes_at[[len(course.points), -1]]
    conditions, missing = _conditions(path, course, ends)
    missing = missing * min(1.0, MOST_GAP / max(float(np.sqrt(missing @ missing)), 1e-12))
    step = _within_bounds(square, pull, conditions, missing, path.bends, MOST_BEND)
    return _stepped(path, step, slopes_at[len(course.points) + n], MOST_BEND)


def _stepped(path: Path, step: FloatArray, middle_slopes: ComplexArray, most: float) -> Path:
    """The path after a step, cut down where it would turn too far.

    Moved by its middle, so that a path and the same path the other way move alike.
    """
    turns = step[2] + path.step * np.concatenate([[0.0], np.cumsum(step[4:])])
    turns += (path.headings - path.heading) * (step[3] / path.step)
    step = step * min(
        1.0, MOST_TURN / max(float(np.abs(turns).max()), 1e-12), path.step / 3 / max(abs(step[3]), 1e-12)
    )
    middle = len(path.bends) // 2
    place = path.joints[middle] + middle_slopes @ step
    turn = (
        step[2]
        + path.step * step[4 : 4 + middle].sum()
        + (path.headings[middle] - path.heading) * (step[3] / path.step)
    )
    bends = np.clip(path.bends + step[4:], -most, most)
    new = Path(0j, 0.0, bends, path.step + step[3])
    new = Path(0j, float(path.headings[middle] + turn - new.headings[middle]), bends, new.step)
    return new.moved(complex(place - new.joints[middle]))


def _slopes(path: Path, places: FloatArray, points: ComplexArray) -> ComplexArray:
    """How points at places (m,) move with start (x, y), heading, step and each bend: (m, 4 + n)."""
    n, step = len(path.bends), path.step
    arc = path.arc(places)
    number = np.arange(n)
    # What a bend turns turns about the end of its arc; inside the arc it grows with the length from its start.
    lever = _lever(path.headings[:-1], path.bends, np.full(n, step))
    slopes = np.empty((len(places), 4 + n), dtype=np.complex128)
    by_bend = slopes[:, 4:]
    np.multiply(
        (1j * step) * points[:, None] + 1j * (lever - step * path.joints[1:]),
        number < arc[:, None],
        out=by_bend,
    )
    run = (places - arc) * step
    by_bend[np.arange(len(places)), arc] = 1j * _lever(path.headings[arc], path.bends[arc], run)
    slopes[:, 0], slopes[:, 1] = 1, 1j
    slopes[:, 2] = 1j * (points - path.start)
    slopes[:, 3] = (points - path.start + by_bend @ path.bends) / step
    return slopes


def _conditions(path: Path, course: Course, slopes: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """What has to hold at the ends, as rows (c, 4 + n) and by how much it is missed (c,)."""
    n = len(path.bends)
    ends = path.joints[[0, n]]
    first, last = slopes
    turn_first, turn_last = np.zeros(4 + n), np.zeros(4 + n)
    turn_first[2] = turn_last[2] = 1
    turn_last[3] = path.bends.sum()
    turn_last[4:] = path.step
    rows: list[FloatArray] = []
    missing: list[float] = []
    if course.closed:
        gap, turn = last - first, course.headings[-1] - course.headings[0]
        rows += [gap.real, gap.imag, turn_last - turn_first]
        off = ends[0] - ends[1]
        missing += [off.real, off.imag, turn - (path.headings[-1] - path.headings[0])]
    for held, at, row, turn_row in ((course.start, 0, first, turn_first), (course.end, -1, last, turn_last)):
        if held == "free" or (course.closed and at):
            continue
        off = course.points[at] - ends[at]
        rows += [row.real, row.imag]
        missing += [off.real, off.imag]
        if held == "pinned":
            rows.append(turn_row)
            missing.append(course.headings[at] - path.headings[at])
    return np.array(rows).reshape(-1, 4 + n), np.array(missing, dtype=np.float64)


def _within_bounds(
    square: FloatArray,
    pull: FloatArray,
    rows: FloatArray,
    missing: FloatArray,
    bends: FloatArray,
    most: float,
) -> FloatArray:
    """Least squares with conditions and bounds, by sets of bends at full lock (primal and dual active sets)."""
    size, held = len(pull), len(missing)
    lock = np.where(np.abs(bends) > most - NEARLY, np.sign(bends), 0.0).astype(int)
    step = np.zeros(size)
    for _ in range(MOST_SETS):
        free = np.concatenate([np.ones(4, dtype=bool), lock == 0])
        fixed = np.zeros(size)
        fixed[4:] = np.where(lock != 0, lock * most - bends, 0.0)
        count = int(free.sum())
        system = np.zeros((count + held, count + held))
        system[:count, :count] = square[np.ix_(free, free)]
        system[:count, count:] = rows[:, free].T
        system[count:, :count] = rows[:, free]
        system[range(count, count + held), range(count, count + held)] = -YIELDING
        right = np.concatenate([(pull - square @ fixed)[free], missing - rows @ fixed])
        solved = np.linalg.solve(system, right)
        step = fixed.copy()
        step[free] = solved[:count]
        force = (pull - square @ step - rows.T @ solved[count:])[4:]
        bent = bends + step[4:]
        new = np.where(lock == 0, np.where(bent > most, 1, np.where(bent < -most, -1, 0)), lock)
        new = np.where((lock != 0) & (force * lock < 0), 0, new)
        if np.array_equal(new, lock):
            return step
        lock = new
    return step


def _feet(path: Path, points: ComplexArray, places: FloatArray) -> FloatArray:
    """Places nearer to the feet of points on the path: one step of Newton's each, at most one arc."""
    at, headings = path.on(places)
    off = (points - at) * np.exp(-1j * headings)
    # Bends between the middles of arcs, so that at a joint neither side counts more.
    bends = np.interp(places, np.arange(len(path.bends)) + 0.5, path.bends)
    move = off.real / np.maximum(1 - bends * off.imag, 0.3) / path.step
    return np.clip(places + np.clip(move, -1.0, 1.0), 0.0, len(path.bends))


def _feet_on(course: Course, points: ComplexArray, places: FloatArray) -> FloatArray:
    """The same on the course, places counted in its points; at most one point on or back."""
    at, headings = course.on(places)
    move = ((points - at) * np.exp(-1j * headings)).real / course.spacing
    return np.clip(places + np.clip(move, -1.0, 1.0), 0.0, len(course.points) - 1)


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
