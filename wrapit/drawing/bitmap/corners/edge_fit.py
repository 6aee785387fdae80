"""Corners with short sides between them: the chain of straight sides whose ink has the edges that are seen.

The middle between both edges tells a corner only where a clean side follows on it. Of two corners a width
apart it shows a wiggle; but each of the two edges shows both of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wrapit.geometry import FloatArray, unit
from wrapit.geometry.arrays import norms

# The numbers were measured on 200 chains of 2 to 4 corners, 60 to 150 degrees, with sides of 1 to 3 widths,
# 4 to 30 px wide, two in five with hard edges, of which 123 come out right.
# When has a fit settled? Where a round gains less, in stroke widths: a fiftieth of what edges are off by. Not
# varied alone; 12 rounds and a quarter of that gain, find one in a hundred more.
_ROUNDS = 8
_SETTLED = 0.0004
# How far off is a point that belongs to other ink? In stroke widths; 0.18 and 0.33 do as well.
_OUTLIER = 0.25
# How many corners has a chain, and when does one more help? Where it or the next one lessens the misfit by a
# fourteenth. With a half instead, 109 chains come out right.
_MOST = 8
_GAIN = 0.93
# When does no further corner help? Where a second one doesn't, and one alone misses by less than so many
# times what is good: most of what is tried is one corner that is known already, at 1.3 times. Of 21 chains
# that are found on 160 pictures, the two whose second corner adds nothing miss by more than six times there.
_ALONE = 2.0
# What does a pen draw? No side shorter than this, in stroke widths (0.9 does as well), no corner where
# the chain starts, and none that folds back: that is a tip.
_SHORTEST = 0.7
_LEAST_END = 0.3
_SHARPEST_RAD = math.radians(152)
# When are sides told apart first that are too far away to matter? For fewer pairs of points and sides looking
# at all is as fast. Points come in the order of the line, so that blocks of them are near few of its sides.
_WORTH_PARTING = 60_000
_AT_ONCE = 48
# Chains are short and looked at thousands of times: beside an array a number takes twice as long as an array.
_MINUS_ONE, _ZERO, _HALF, _ONE = (np.array(value) for value in (-1.0, 0.0, 0.5, 1.0))
_LEAST_COSINE, _TINY = np.array(0.1), np.array(1e-9)


@dataclass(frozen=True, eq=False)
class Missed:
    """How far points (n,) of the ink's edges lie outside of the ink of a chain, in stroke widths.

    `side` (n,) is the nearest side, `share` (n,) how far along it its nearest point is, `away` (n, 2) the
    direction from there.
    """

    outside: FloatArray
    side: NDArray[np.intp]
    share: FloatArray
    away: FloatArray

    @cached_property
    def rms(self) -> float:
        """Root mean square, with outliers (other ink) bounded."""
        bounded = np.minimum(np.abs(self.outside), _OUTLIER)
        return math.sqrt(float(bounded @ bounded) / len(bounded))


def missed(chain: FloatArray, edge: FloatArray, width_px: float) -> Missed:
    """What points `edge` (n, 2) of the ink's edges say of a chain (m, 2): all should be half a width away.

    Outside of a corner anything between a bevel and a mitre is right.
    """
    course = chain[1:] - chain[:-1]
    side, share, gap = _nearest(chain, course, edge)
    distance = norms(gap)
    apart = distance / width_px
    outside = apart - 0.5
    ended = share >= 1.0
    corner = side + ended
    ended |= share <= 0.0
    ended &= corner > 0
    ended &= corner < len(course)
    at = ended.nonzero()[0]
    if len(at):
        outside[at] = _beside_corner(course, corner.take(at), gap.take(at, axis=0), apart.take(at))
    return Missed(outside, side, share, gap / np.maximum(distance, _TINY)[:, None])


def _nearest(
    chain: FloatArray, course: FloatArray, points: FloatArray
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """The side nearest to each of points (n, 2), how far along it, and the way from there (n, 2)."""
    if len(points) * len(course) < _WORTH_PARTING:
        return nearest_of_all(chain, course, points)
    side, share, gap = np.empty(len(points), dtype=np.intp), np.empty(len(points)), np.empty((len(points), 2))
    low, high = np.minimum(chain[:-1], chain[1:]), np.maximum(chain[:-1], chain[1:])
    blocks = np.arange(0, len(points), _AT_ONCE)
    least, most = np.zeros((2, len(blocks), len(course)))
    for k in (0, 1):
        before = np.minimum.reduceat(points[:, k], blocks)[:, None]
        behind = np.maximum.reduceat(points[:, k], blocks)[:, None]
        least += np.maximum(np.maximum(low[:, k] - behind, before - high[:, k]), 0.0) ** 2
        most += np.maximum(high[:, k] - before, behind - low[:, k]) ** 2
    # Boxes that are farther away than another one's farthest place hold no point's nearest side.
    close = least <= most.min(axis=1, keepdims=True) * (1 + 1e-9) + 1e-9
    for block, first in enumerate(blocks.tolist()):
        part, near = slice(first, first + _AT_ONCE), np.flatnonzero(close[block])
        of, share[part], gap[part] = nearest_of_all(chain[near], course[near], points[part])
        side[part] = near[of]
    return side, share, gap


def nearest_of_all(
    starts: FloatArray, course: FloatArray, points: FloatArray
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """The side nearest to each of points (n, 2), how far along it, and the way from there (n, 2).

    Sides (m,) go from `starts` (m or more, 2) along their `course` (m, 2).
    """
    # In x and y apart (sides, n): sums over an axis of two and rows of few sides take several times as long.
    course_x, course_y = course[:, :1], course[:, 1:]
    x, y = points[:, 0] - starts[: len(course), :1], points[:, 1] - starts[: len(course), 1:]
    share = x * course_x
    share += y * course_y
    share /= np.maximum(course_x * course_x + course_y * course_y, _TINY)
    np.minimum(np.maximum(share, _ZERO, out=share), _ONE, out=share)
    x -= share * course_x
    y -= share * course_y
    squared = x * x
    squared += y * y
    side = squared.argmin(axis=0)
    # Places in one row are found in a third of the time that pairs of them take.
    at = side * len(points)
    at += np.arange(len(points))
    gap = np.empty((len(points), 2))
    gap[:, 0], gap[:, 1] = x.ravel().take(at), y.ravel().take(at)
    return side, share.ravel().take(at), gap


def _beside_corner(
    course: FloatArray, corner: NDArray[np.intp], gap: FloatArray, distance: FloatArray
) -> FloatArray:
    """How far points beside inner corners lie outside of them, in stroke widths."""
    directions = unit(course)
    before, after = directions.take(corner - 1, axis=0), directions.take(corner, axis=0)
    turn, outwards = before * after, before - after
    half_turn = np.arccos(_bounded(turn[:, 0] + turn[:, 1])) / 2
    squared, towards = outwards * outwards, gap * outwards
    norm = np.sqrt((squared[:, 0] + squared[:, 1]) * (gap[:, 0] * gap[:, 0] + gap[:, 1] * gap[:, 1]))
    aside = np.arccos(_bounded((towards[:, 0] + towards[:, 1]) / np.maximum(norm, _TINY)))
    bevel = 0.5 * np.cos(half_turn) / np.maximum(np.cos(aside), _LEAST_COSINE)
    mitre = 0.5 / np.maximum(np.cos(half_turn - aside), _LEAST_COSINE)
    nearest = np.maximum(distance, np.minimum(bevel, _HALF))
    return np.asarray(distance - np.minimum(nearest, np.maximum(mitre, _HALF)))


def _bounded(cosine: FloatArray) -> FloatArray:
    return np.minimum(np.maximum(cosine, _MINUS_ONE, out=cosine), _ONE, out=cosine)


def fitted(chain: FloatArray, edge: FloatArray, width_px: float) -> tuple[FloatArray, Missed]:
    """The chain with its inner corners moved so that its ink's edges fit best."""
    inner = np.arange(1, len(chain) - 1)
    return settled(chain, inner, lambda moved: moved, np.eye(len(chain))[:, inner], edge, width_px)


def settled(
    start: FloatArray,
    inner: NDArray[np.intp],
    ends: Callable[[FloatArray], FloatArray],
    shares: FloatArray,
    edge: FloatArray,
    width_px: float,
) -> tuple[FloatArray, Missed]:
    """Points (m, 2), those `inner` moved until a chain's edges fit best (Gauss and Newton's method).

    The chain has its `ends` of sides from the points; `shares` (ends, inner) tells how much of each of those
    that move is in each of them.
    """
    moving = start.copy()
    seen = missed(ends(moving), edge, width_px)
    damping, equations = 1e-3, _equations(seen, shares, width_px)
    for _ in range(_ROUNDS):
        step = _step(*equations, width_px, damping)
        moved = moving.copy()
        moved[inner] += step
        new = missed(ends(moved), edge, width_px)
        if new.rms >= seen.rms:
            damping *= 10
            if damping > 10:
                break
            continue
        gained = seen.rms - new.rms
        moving, seen, damping = moved, new, max(damping / 10, 1e-4)
        if gained < _SETTLED:
            break
        equations = _equations(seen, shares, width_px)
    return moving, seen


def _equations(seen: Missed, shares: FloatArray, width_px: float) -> tuple[FloatArray, FloatArray]:
    """The normal matrix of what moves, in x and y, and its right side, from what edges miss."""
    used = (np.abs(seen.outside) < _OUTLIER).nonzero()[0]
    side, share = seen.side.take(used), seen.share.take(used)[:, None]
    moves = shares.take(side, axis=0)
    moves *= _ONE - share
    side += 1
    moves += share * shares.take(side, axis=0)
    # How moving each point changes what edges are missed by: (n, inner, 2), in rows of x and y in turn.
    slope = (moves[:, :, None] * -seen.away.take(used, axis=0)[:, None]).reshape(len(used), -1)
    return slope.T @ slope, slope.T @ (seen.outside.take(used) * width_px)


def _step(normal: FloatArray, right: FloatArray, width_px: float, damping: float) -> FloatArray:
    damped = normal.copy()
    diagonal = damped.ravel()[:: len(normal) + 1]
    diagonal += damping * (np.add.reduce(diagonal) / len(normal) + 1e-9)
    step = np.linalg.solve(damped, right).reshape(-1, 2)
    longest = float(np.maximum.reduce(np.hypot(step[:, 0], step[:, 1])))
    return np.asarray(step * -min(1.0, 0.3 * width_px / max(longest, 1e-9)))


def turns(chain: FloatArray) -> FloatArray:
    """The turn (m - 2,) at each inner corner of a chain, in radians."""
    courses = unit(np.diff(chain, axis=0))
    return np.asarray(np.arccos(np.clip((courses[1:] * courses[:-1]).sum(axis=1), -1, 1)))


def chain_of(middle: FloatArray, edge: FloatArray, width_px: float, good: float) -> FloatArray | None:
    """The chain with the fewest corners that fits the edges, from end to end of a middle line.

    Corners are added one at a time, where the middle line is farthest from the chain. None where the edges
    are missed by more than `good` (in stroke widths), however many there are.
    """
    rough = chain = middle[[0, -1]]
    best, stalled = np.inf, 0
    for _ in range(_MOST):
        rough, added = (_with_farthest(start, middle, width_px) for start in (rough, chain))
        chain, seen = fitted(rough, edge, width_px)
        if seen.rms >= good and not np.array_equal(rough, added):
            other, other_seen = fitted(added, edge, width_px)
            if other_seen.rms < seen.rms:
                chain, seen = other, other_seen
        if seen.rms < good:
            return _pruned(chain, edge, width_px, good)
        stalled = 0 if seen.rms < _GAIN * best else stalled + 1
        if stalled > 1 or (stalled and len(chain) == 4 and seen.rms < _ALONE * good):
            return None
        best = min(best, seen.rms)
    return None


def _with_farthest(chain: FloatArray, middle: FloatArray, width_px: float) -> FloatArray:
    side, at = farthest(chain, middle, width_px)
    return np.insert(chain, side + 1, middle[at], axis=0)


def farthest(chain: FloatArray, middle: FloatArray, width_px: float) -> tuple[int, int]:
    """Which point of a middle line is farthest from a chain, and the side it is nearest to: (side, point)."""
    far = missed(chain, middle, width_px)
    at = 1 + int(np.argmax(far.outside[1:-1]))
    return int(far.side[at]), at


def _pruned(chain: FloatArray, edge: FloatArray, width_px: float, good: float) -> FloatArray | None:
    """The chain without corners that it can do without; None if what remains is none that a pen draws."""
    while len(chain) > 3:
        fewer = [fitted(np.delete(chain, k, axis=0), edge, width_px) for k in range(1, len(chain) - 1)]
        best, seen = min(fewer, key=lambda one: one[1].rms)
        if seen.rms > good:
            break
        chain = best
    return chain if _plausible(chain, width_px) else None


def _plausible(chain: FloatArray, width_px: float) -> bool:
    """Whether no side is shorter than a pen shows and no corner folds back on itself."""
    sides = np.linalg.norm(np.diff(chain, axis=0), axis=1) / width_px
    long = (sides[1:-1] > _SHORTEST).all() and sides[[0, -1]].min() > _LEAST_END
    return bool(long and (turns(chain) < _SHARPEST_RAD).all())
