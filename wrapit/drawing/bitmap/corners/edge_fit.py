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
    # In x and y apart (n, m - 1): sums over an axis of two take several times as long.
    (course_x, course_y), (x, y) = course.T, (edge[:, k, None] - chain[:-1, k] for k in (0, 1))
    share = x * course_x
    share += y * course_y
    share /= np.maximum(course_x**2 + course_y**2, 1e-9)
    np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
    x -= share * course_x
    y -= share * course_y
    squared = x * x + y * y
    side = squared.argmin(axis=1)
    # Places in one row are found in a third of the time that pairs of them take.
    at = np.arange(0, squared.size, squared.shape[1]) + side
    share, distance = share.ravel().take(at), np.sqrt(squared.ravel().take(at))
    gap = np.empty((len(edge), 2))
    gap[:, 0], gap[:, 1] = x.ravel().take(at), y.ravel().take(at)
    outside = distance / width_px - 0.5
    corner = side + (share >= 1.0)
    at_corner = ((share <= 0.0) | (share >= 1.0)) & (corner > 0) & (corner < len(chain) - 1)
    if at_corner.any():
        outside[at_corner] = _beside_corner(
            unit(course), corner[at_corner], gap[at_corner], distance[at_corner] / width_px
        )
    return Missed(outside, side, share, gap / np.maximum(distance, 1e-9)[:, None])


def _beside_corner(
    courses: FloatArray, corner: NDArray[np.intp], gap: FloatArray, distance: FloatArray
) -> FloatArray:
    (ax, ay), (bx, by), (x, y) = courses[corner - 1].T, courses[corner].T, gap.T
    outwards_x, outwards_y = ax - bx, ay - by
    half_turn = np.arccos(np.minimum(np.maximum(ax * bx + ay * by, -1), 1)) / 2
    norm = np.sqrt((outwards_x**2 + outwards_y**2) * (x**2 + y**2))
    cosine = (x * outwards_x + y * outwards_y) / np.maximum(norm, 1e-9)
    aside = np.arccos(np.minimum(np.maximum(cosine, -1), 1))
    bevel = 0.5 * np.cos(half_turn) / np.maximum(np.cos(aside), 0.1)
    mitre = 0.5 / np.maximum(np.cos(half_turn - aside), 0.1)
    return distance - np.minimum(np.maximum(distance, np.minimum(bevel, 0.5)), np.maximum(mitre, 0.5))


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
    used = np.flatnonzero(np.abs(seen.outside) < _OUTLIER)
    side, share = seen.side[used], seen.share[used, None]
    moves = (1 - share) * shares[side] + share * shares[side + 1]
    # How moving each point changes what edges are missed by: (n, inner, 2), in rows of x and y in turn.
    slope = (moves[:, :, None] * -seen.away[used, None]).reshape(len(used), -1)
    return slope.T @ slope, slope.T @ (seen.outside[used] * width_px)


def _step(normal: FloatArray, right: FloatArray, width_px: float, damping: float) -> FloatArray:
    damped = normal + damping * (np.trace(normal) / len(normal) + 1e-9) * np.eye(len(normal))
    step = -np.linalg.solve(damped, right).reshape(-1, 2)
    longest = float(np.hypot(step[:, 0], step[:, 1]).max())
    return step * min(1.0, 0.3 * width_px / max(longest, 1e-9))


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
