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
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polynomials import angle

_MOST_RAD = np.radians(80)
_BACK_RAD = np.radians(95)
_ACUTE_RAD = np.radians(35)
_REACH = 2.2
_BEHIND = 3.0
_STEP = 8
_PARTED = 0.1
_MERGED = 0.1
_ALONE = 1.5
_KNOWN = 1.0
_MISFIT = 0.06
_DIP = 0.03
_NEAR = 0.2
_TOGETHER = 1.5
_TOLD = 0.03
_FEWEST = 5


@dataclass(frozen=True, eq=False)
class Merge:
    """Where one stroke meets another (2,), its direction (2,) away from there, and which arms are which.

    `pair` holds the two arms of the other stroke, by their places in the list, `single` that of the one.
    """

    point: FloatArray
    direction: FloatArray
    lead: FloatArray
    pair: tuple[int, int]
    single: int
    departs: float
    turn: float


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
    found = [_merged(arms, stem, other, single, ink) for other, single in ((a, b), (b, a))]
    known = [merge for merge in found if merge is not None]
    if len(known) < 2:
        return None
    best = max(known, key=lambda merge: merge.departs)
    return best if best.turn < _ACUTE_RAD else None


def _merged(arms: list[Arm], stem: int, other: int, single: int, ink: Ink) -> Merge | None:
    one, width = arms[single], arms[single].width_px
    behind = int(min(_BEHIND, arms[stem].length / width) * _STEP)
    on, along = _sampled(through(arms[stem], arms[other]), behind, width)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    start = one.points[0]
    nearest = int(np.argmin(np.linalg.norm(on - start, axis=1)))
    if (start - on[nearest]) @ across[nearest] < 0:
        across = -across
    left, right = edges(ink, on, across, _REACH * width, max(0.25, width / 24))
    alone = (left + right)[:behind]
    if np.isnan(alone).mean() > 0.5:
        return None
    broad = float(np.nanmedian(alone))
    if not 0.6 * width < broad < 1.5 * width:
        return None
    shared = behind + _shared(right[behind:], broad)
    course = on - (np.nan_to_num(left, nan=broad / 2) - broad / 2)[:, None] * across
    inner = _beside(on[:shared] + right[:shared, None] * across[:shared], across[:shared], broad / 2)
    apart = ((inner - course[:shared]) * across[:shared]).sum(axis=1)
    known = np.flatnonzero(np.isfinite(apart) & (apart > _MERGED * broad))
    if len(known) < _FEWEST:
        return None
    alone = one.points[one.along <= _ALONE * width] if one.length > _KNOWN * width else inner[:0]
    arc = _arc(np.vstack([inner[known], alone]), width)
    if arc is None:
        return None
    gap = arc.distance(course[: known[-1] + 1])
    gap = _smooth(gap * np.sign(gap[-1]))
    at = _meeting(gap / width)
    if at is None:
        return None
    point, direction = _along(arc, course, along, at)
    turn = angle(direction, along[int(at)])
    if _reached(gap / width, _NEAR, at) - at > _TOGETHER * _STEP:
        at = _reached(gap / width, _TOLD, at)
        point, direction = _along(arc, course, along, at)
    departs = float(np.abs(gap[:behind]).mean())
    lead = arc.nearest(inner[known[known > at + 1]])[::2]
    lead = lead[(lead - start) @ one.at(0.0)[1] < 0]
    return Merge(point, direction, lead, (stem, other), single, departs, turn)


def _along(arc: _Arc, course: FloatArray, along: FloatArray, at: float) -> tuple[FloatArray, FloatArray]:
    """A place between two points of a stroke's course, and the arc's direction there."""
    k, share = int(at), at % 1
    point = (1 - share) * course[k] + share * course[min(k + 1, len(course) - 1)]
    direction = arc.direction(point)
    return point, direction if direction @ along[k] > 0 else -direction


def _beside(edge: FloatArray, across: FloatArray, far: float) -> FloatArray:
    """The centres (n, 2) that run `far` inside an edge (n, 2), away from where `across` points."""
    even = np.column_stack([_smooth(edge[:, k]) for k in (0, 1)])
    along = unit(np.gradient(even, axis=0))
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal *= np.sign((normal * across).sum(axis=1))[:, None]
    return edge - far * normal


def _sampled(curve: Through, behind: int, width: float) -> tuple[FloatArray, FloatArray]:
    """Places and directions (n, 2) along a curve, from its first arm on to its second."""
    at = np.arange(-curve.gap / 2 - behind * width / _STEP, curve.gap / 2, width / _STEP)
    powers = at[:, None] ** np.arange(len(curve.coefficients))
    slopes = np.arange(1, len(curve.coefficients))
    return powers @ curve.coefficients, unit((powers[:, :-1] * slopes) @ curve.coefficients[1:])


def _shared(outer: FloatArray, broad: float) -> int:
    """How many of the places lie before paper opens between the two strokes."""
    known = np.isfinite(outer)
    highest = np.maximum.accumulate(np.where(known, outer, 0.0))
    parted = ~known | (outer < highest - _PARTED * broad)
    return int(np.argmax(parted)) if parted.any() else len(outer)


def _smooth(values: FloatArray) -> FloatArray:
    kernel = np.ones(5) / 5
    return np.convolve(np.pad(values, 2, mode="edge"), kernel, mode="valid")


@dataclass(frozen=True, eq=False)
class _Arc:
    """An arc or a straight line: where `flat · (|x|², x) = y` in a frame with axes (2, 2) around a centre."""

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
    """Where two strokes meet or touch, walking back along one; `gap` (n,) is its distance from the other in widths."""
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
