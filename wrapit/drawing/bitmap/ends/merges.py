"""Where a stroke merges into another at a small angle: read from the edges of the ink that both share.

There the single stroke stands alone only far from the joint. But the outer edges of the shared ink still are
those of the two strokes: half a width inside of either runs a centre line. The single stroke's is carried
on from there, as an arc, to where it meets the other's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm
from wrapit.drawing.bitmap.centre_lines import edges
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.pairing import Through, through
from wrapit.geometry import FloatArray, IntArray, unit
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import slopes
from wrapit.geometry.polynomials import angle

# Measured on lines and arcs (radius 2 widths and more) of 4 to 20 px that end on such, at nine angles.
# When is it worth looking? Arcs of two widths have turned by 65 degrees from each other before paper shows
# between them, so the two may part by 80 there, on the other side of the third. At the joint itself they
# part by less than 35: from 45 on, arms alone place joints better (0.007 widths instead of 0.013).
_MOST_RAD = np.radians(80)
_BACK_RAD = np.radians(95)
_ACUTE_RAD = np.radians(35)
# In stroke widths from here on.
# How are the edges measured? Up to 2.2 from the one stroke: the other's is 1.5 away where they part, more
# where it is slanted. From 3 behind the fork on, where the stem's width is that of one stroke (2 are too few
# to see which of two slight arcs goes on), eight times a width.
_REACH = 2.2
_BEHIND = 3.0
_STEP = 8
# Where has paper opened? Where the edge jumps back by a tenth. What of the shared ink tells the arc? Where
# centres are a tenth apart, more than the noise of an edge; and 1.5 of an arm longer than an end's cap.
_PARTED = 0.1
_MERGED = 0.1
_ALONE = 1.5
_KNOWN = 1.0
# Is it an arc? Those generated miss by 0.002 to 0.02, a short arm bent by its cap by 0.05.
_FEWEST = 5
_MISFIT = 0.06
# Is it a touch? Where an arc reaches over the other stroke by less than this; edges are off by about 0.01.
_DIP = 0.03
# When is the place of a touch ill-defined? Where the two are within 0.2 of each other over more than 1.5, as
# arcs of more than six widths; they meet where they are 0.03 apart then, just below what fitted curves may
# leave out. Without this, joints wander by up to 2 widths (a bird of the corpus loses one).
_NEAR = 0.2
_TOGETHER = 1.5
_TOLD = 0.03


@dataclass(frozen=True, eq=False)
class Merge:
    """Where one stroke meets another (2,), its direction (2,) from there, and points (n, 2) up to its arm.

    `pair` holds the two arms of the other stroke, by their places in the list. `turn` is the angle between
    the two strokes, `departs` how far (pixels) the one, carried on, leaves the other behind the joint.
    """

    point: FloatArray
    direction: FloatArray
    lead: FloatArray
    pair: tuple[int, int]
    departs: float
    turn: float


@dataclass(frozen=True, eq=False)
class _SharedInk:
    """The centres of two strokes in their common ink: the `course` of one, and those `beside` it.

    `course` and its directions `along` (n, 2) start `behind` points before the fork; `beside` (m, 2) are the
    other stroke's centres where they are apart from it, at its places `at` (m,).
    """

    course: FloatArray
    along: FloatArray
    behind: int
    beside: FloatArray
    at: IntArray


def find_merge(arms: list[Arm], ink: Ink) -> Merge | None:
    """Where one of three arms merges into the stroke of the two others, or nothing where none does.

    Of the two that part, the single one is that which leaves the third's course more.
    """
    outward = [arm.at(0.0)[1] for arm in arms]
    apart = [angle(outward[(k + 1) % 3], outward[(k + 2) % 3]) for k in range(3)]
    stem = int(np.argmin(apart))
    a, b = (stem + 1) % 3, (stem + 2) % 3
    if apart[stem] > _MOST_RAD or min(apart[a], apart[b]) < _BACK_RAD:
        return None
    first = _merged(arms, stem, a, b, ink)
    second = None if first is None else _merged(arms, stem, b, a, ink)
    if first is None or second is None:
        return None
    best = max(first, second, key=lambda merge: merge.departs)
    return best if best.turn < _ACUTE_RAD else None


def _merged(arms: list[Arm], stem: int, other: int, single: int, ink: Ink) -> Merge | None:
    one, width = arms[single], arms[single].width_px
    shared = _shared_ink(arms[stem], arms[other], one, ink)
    if shared is None:
        return None
    alone = one.points[: np.searchsorted(one.along, _ALONE * width) if one.length > _KNOWN * width else 0]
    arc = _arc(np.vstack([shared.beside, alone]), width)
    if arc is None:
        return None
    gap = arc.distance(shared.course[: shared.at[-1] + 1])
    gap = _smooth(gap * np.sign(gap[-1])) / width
    at = _meeting(gap)
    if at is None:
        return None
    turn = angle(_along(arc, shared, at)[1], shared.along[int(at)])
    if _reached(gap, _NEAR, at) - at > _TOGETHER * _STEP:
        at = _reached(gap, _TOLD, at)
    point, direction = _along(arc, shared, at)
    start, outward = one.at(0.0)
    lead = arc.nearest(shared.beside[shared.at > at + 1])[::2]
    lead = lead[(lead - start) @ outward < 0]
    departs = width * float(np.abs(gap[: shared.behind]).mean())
    return Merge(point, direction, lead, (stem, other), departs, turn)


def _shared_ink(stem: Arm, other: Arm, one: Arm, ink: Ink) -> _SharedInk | None:
    """The ink that `one` shares with the stroke from `stem` to `other`; nothing where edges don't tell."""
    width = one.width_px
    behind = int(min(_BEHIND, stem.length / width) * _STEP)
    on, along = _sampled(through(stem, other), behind, width)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    nearest = int(np.argmin(np.linalg.norm(on - one.points[0], axis=1)))
    if (one.points[0] - on[nearest]) @ across[nearest] < 0:
        across = -across
    left, right = edges(ink, on, across, _REACH * width, max(0.25, width / 24))
    widths = (left + right)[:behind]
    known = np.isfinite(widths)
    if np.count_nonzero(known) < max(_FEWEST, behind / 2):
        return None
    broad = median(widths[known])
    course = on - (np.where(np.isfinite(left), left, broad / 2) - broad / 2)[:, None] * across
    until = behind + _until_parted(right[behind:], broad)
    edge = on[:until] + right[:until, None] * across[:until]
    beside = _inside(edge, across[:until], broad / 2)
    apart = ((beside - course[:until]) * across[:until]).sum(axis=1)
    at = np.flatnonzero(np.isfinite(apart) & (apart > _MERGED * broad))
    return _SharedInk(course, along, behind, beside[at], at) if len(at) >= _FEWEST else None


def _along(arc: _Arc, shared: _SharedInk, at: float) -> tuple[FloatArray, FloatArray]:
    """A place between two points of a stroke's course, and the arc's direction there."""
    k, share = int(at), at % 1
    point = (1 - share) * shared.course[k] + share * shared.course[min(k + 1, len(shared.course) - 1)]
    direction = arc.direction(point)
    return point, direction if direction @ shared.along[k] > 0 else -direction


def _inside(edge: FloatArray, across: FloatArray, far: float) -> FloatArray:
    """The centres (n, 2) that run `far` inside an edge (n, 2), away from where `across` points."""
    even = np.column_stack([_smooth(edge[:, k]) for k in (0, 1)])
    along = unit(slopes(even))
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal *= np.sign((normal * across).sum(axis=1))[:, None]
    return edge - far * normal


def _sampled(curve: Through, behind: int, width: float) -> tuple[FloatArray, FloatArray]:
    """Places and directions (n, 2) along a curve, from its first arm on to its second."""
    at = np.arange(-curve.gap / 2 - behind * width / _STEP, curve.gap / 2, width / _STEP)
    powers = at[:, None] ** np.arange(len(curve.coefficients))
    slopes = np.arange(1, len(curve.coefficients))
    return powers @ curve.coefficients, unit((powers[:, :-1] * slopes) @ curve.coefficients[1:])


def _until_parted(outer: FloatArray, broad: float) -> int:
    """How many distances (n,) to the outer edge there are before paper opens between the two strokes."""
    known = np.isfinite(outer)
    highest = np.maximum.accumulate(np.where(known, outer, 0.0))
    parted = ~known | (outer < highest - _PARTED * broad)
    return int(np.argmax(parted)) if parted.any() else len(outer)


def _smooth(values: FloatArray) -> FloatArray:
    """Means of five neighbours."""
    kernel = np.ones(5) / 5
    padded = np.concatenate([values[:1], values[:1], values, values[-1:], values[-1:]])
    return np.convolve(padded, kernel, mode="valid")


@dataclass(frozen=True, eq=False)
class _Arc:
    """An arc or a straight line: `y = terms · (x² + y², x, 1)` in a frame (2, 2) around a centre."""

    centre: FloatArray
    axes: FloatArray
    terms: FloatArray

    def distance(self, points: FloatArray) -> FloatArray:
        """Signed distance (n,) of points (n, 2)."""
        x, y = ((points - self.centre) @ self.axes.T).T
        a, b, c = self.terms
        value = y - a * (x * x + y * y) - b * x - c
        return value / np.hypot(1 - 2 * a * y, 2 * a * x + b)

    def nearest(self, points: FloatArray) -> FloatArray:
        """The points (n, 2) of the arc next to others near it."""
        a, b, _ = self.terms
        x, y = ((points - self.centre) @ self.axes.T).T
        normal = unit(np.column_stack([-2 * a * x - b, 1 - 2 * a * y])) @ self.axes
        return points - self.distance(points)[:, None] * normal

    def direction(self, point: FloatArray) -> FloatArray:
        """Unit direction (2,) at a point near it."""
        x, y = self.axes @ (point - self.centre)
        a, b, _ = self.terms
        return unit(np.array([1 - 2 * a * y, 2 * a * x + b]) @ self.axes)


def _arc(points: FloatArray, width: float) -> _Arc | None:
    """The arc through points (n, 2), least squares; nothing where they lie on none."""
    centre = points.mean(axis=0)
    along = unit(points[-1] - points[0])
    axes = np.array([along, [-along[1], along[0]]])
    x, y = ((points - centre) @ axes.T).T
    terms, *_ = np.linalg.lstsq(np.column_stack([x * x + y * y, x, np.ones_like(x)]), y, rcond=None)
    arc = _Arc(centre, axes, terms)
    missed = float(np.sqrt((arc.distance(points) ** 2).mean()))
    return arc if missed < _MISFIT * width else None


def _meeting(gap: FloatArray) -> float | None:
    """Where two strokes meet or touch, walking back along one; `gap` (n,) is how far (widths) it is off."""
    below = np.flatnonzero(gap <= 0)
    first = int(below[-1]) if len(below) else int(np.argmin(gap))
    if first == len(gap) - 1 or (first == 0 and gap[0] > _DIP):
        return None
    dip = first
    while dip > 0 and gap[dip - 1] < gap[dip]:
        dip -= 1
    if gap[dip] > -_DIP:
        return float(dip)
    return _reached(gap, 0.0, first)


def _reached(gap: FloatArray, level: float, start: float) -> float:
    """Where a gap (n,) grows beyond a level, from some place on."""
    after = int(start) + int(np.argmax(gap[int(start) :] > level))
    if after <= start:
        return start
    return after - 1 + float((level - gap[after - 1]) / (gap[after] - gap[after - 1]))
