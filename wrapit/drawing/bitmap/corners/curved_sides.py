"""Corners between short curved sides: a chain of parabolas whose ink has the edges that are seen.

Each side is drawn as facets, and their ends are sums of the corners and the sides' bulges. So what edges say
of facets says it of those (`edge_fit.missed`), and the same method fits them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.corners.edge_fit import Missed, farthest, settled
from wrapit.geometry import FloatArray, unit

# In stroke widths. Measured on 120 strokes of 1 to 3 corners, 68 to 140 degrees, between arcs of radius 1 to
# 4 and length 1 to 2, 4 to 30 px wide, two in five with hard edges, of which 65 come out right (48 without).
# How many facets has a side? At a radius of 1.5 four are 0.02 inside of a side two widths long; six are no
# better.
_FACETS = 4
# How many corners has a chain, and when is it given up? Where neither of two more lessens the misfit by a
# tenth; giving up at the first that doesn't loses three of the 120.
_MOST = 5
_GAIN = 0.9
# Which corners can a chain do without? Those without which it fits as well as grey edges can be seen, or
# hardly worse: small steps lose their corners otherwise, as two bulging sides nearly do.
_WELL = 0.01
_LOSS = 1.5
# What does a pen draw? No side shorter than this, none that bulges by more than a third of its chord (that is
# a loop), and no corner that folds back (that is a tip). As with straight sides; not varied alone.
_SHORTEST = 0.7
_LEAST_END = 0.5
_BULGIEST = 0.35
_SHARPEST = np.cos(np.radians(152))
# Which of a chain's ends tells how it bends? One this long: half a width takes 12 of a corner's 68 degrees.
_LEAST_BENT = 0.8


@dataclass(frozen=True, eq=False)
class Curves:
    """Corners (m, 2), and how far the middle of each side lies from that of its chord (m - 1, 2)."""

    corners: FloatArray
    bulges: FloatArray

    @property
    def facets(self) -> FloatArray:
        """The ends of all facets."""
        return _shares(len(self.corners)) @ np.vstack([self.corners, self.bulges])

    @property
    def arriving(self) -> FloatArray:
        """Unit directions (m - 1, 2) in which the sides end."""
        return unit(np.diff(self.corners, axis=0) - 4 * self.bulges)

    @property
    def leaving(self) -> FloatArray:
        """Unit directions (m - 1, 2) in which the sides start."""
        return unit(np.diff(self.corners, axis=0) + 4 * self.bulges)

    def points(self, side: int, share: FloatArray) -> FloatArray:
        """Points (n, 2) on a side, at shares (n,) of it."""
        t = share[:, None]
        start, end = self.corners[side : side + 2]
        return np.asarray((1 - t) * start + t * end + 4 * t * (1 - t) * self.bulges[side])


def _shares(corners: int) -> FloatArray:
    """How much of each corner, and of each bulge, is in each end of a facet."""
    sides = corners - 1
    at = np.arange(sides * _FACETS + 1)
    side = np.minimum(at // _FACETS, sides - 1)
    t = at / _FACETS - side
    shares = np.zeros((len(at), corners + sides))
    shares[at, side] = 1 - t
    shares[at, side + 1] += t
    shares[at, corners + side] = 4 * t * (1 - t)
    return shares


def fitted_curves(curves: Curves, edge: FloatArray, width_px: float) -> tuple[Curves, Missed]:
    """The chain with its inner corners and its bulges moved so that its ink's edges fit best."""
    count = len(curves.corners)
    shares = _shares(count)
    start = np.vstack([curves.corners, curves.bulges])
    chords = np.linalg.norm(np.diff(curves.corners, axis=0), axis=1)
    told = chords > _LEAST_BENT * width_px
    told[1:-1] = True
    start[count:][~told] = 0.0
    inner = np.r_[1 : count - 1, count + np.flatnonzero(told)]

    def ends(moved: FloatArray) -> FloatArray:
        return shares @ _upright(moved, count)

    best, seen = settled(start, inner, ends, shares[:, inner], edge, width_px)
    best = _upright(best, count)
    return Curves(best[:count], best[count:]), seen


def _upright(moved: FloatArray, count: int) -> FloatArray:
    """The same with bulges across their chords: along them, they only change how fast the side is run."""
    chords = unit(np.diff(moved[:count], axis=0))
    along = (moved[count:] * chords).sum(axis=1)[:, None] * chords
    return np.vstack([moved[:count], moved[count:] - along])


def curves_of(
    middle: FloatArray, known: list[FloatArray], edge: FloatArray, width_px: float, good: float
) -> Curves | None:
    """The chain of curved sides with the fewest corners that fits the edges, from end to end of a line.

    Corners are added where the middle line is farthest from the chain: to those `known`, then to none. None
    where the edges are missed by more than `good` (in stroke widths), or no pen draws such a chain.
    """
    for start in ([*known], []) if known else ([],):
        corners = np.vstack([middle[:1], *start, middle[-1:]])
        chain = _grown(Curves(corners, np.zeros((len(corners) - 1, 2))), middle, edge, width_px, good)
        if chain is not None and _plausible(chain, width_px):
            return chain
    return None


def _grown(
    chain: Curves, middle: FloatArray, edge: FloatArray, width_px: float, good: float
) -> Curves | None:
    """The chain with as many corners as it needs to fit; None if it never does."""
    if len(chain.corners) > 2:
        chain, seen = fitted_curves(chain, edge, width_px)
        if seen.rms < good:
            return _pruned(chain, edge, width_px, min(good, max(_WELL, _LOSS * seen.rms)))
    best, stalled = np.inf, 0
    while len(chain.corners) < _MOST + 2:
        chain, seen = fitted_curves(_with_farthest(chain, middle, width_px), edge, width_px)
        if seen.rms < good:
            return _pruned(chain, edge, width_px, min(good, max(_WELL, _LOSS * seen.rms)))
        stalled = 0 if seen.rms < _GAIN * best else stalled + 1
        if stalled > 1:
            return None
        best = min(best, seen.rms)
    return None


def _with_farthest(chain: Curves, middle: FloatArray, width_px: float) -> Curves:
    facet, at = farthest(chain.facets, middle, width_px)
    side = facet // _FACETS
    bulges = np.insert(chain.bulges, side, 0, axis=0)
    bulges[side : side + 2] = 0
    return Curves(np.insert(chain.corners, side + 1, middle[at], axis=0), bulges)


def _pruned(chain: Curves, edge: FloatArray, width_px: float, good: float) -> Curves:
    """The chain without corners that it can do without."""
    while len(chain.corners) > 3:
        fewer = [fitted_curves(_without(chain, k), edge, width_px) for k in range(1, len(chain.corners) - 1)]
        best, seen = min(fewer, key=lambda one: one[1].rms)
        if seen.rms > good:
            break
        chain = best
    return chain


def _without(chain: Curves, corner: int) -> Curves:
    before, _, after = chain.corners[corner - 1 : corner + 2]
    bulges = np.delete(chain.bulges, corner, axis=0)
    bulges[corner - 1] = chain.corners[corner] - (before + after) / 2
    longest = 0.25 * float(np.linalg.norm(after - before))
    bulges[corner - 1] *= min(1.0, longest / max(float(np.linalg.norm(bulges[corner - 1])), 1e-9))
    return Curves(np.delete(chain.corners, corner, axis=0), bulges)


def _plausible(chain: Curves, width_px: float) -> bool:
    """Whether a pen draws such sides: long enough, no loops, no corner that folds back."""
    chords = np.linalg.norm(np.diff(chain.corners, axis=0), axis=1)
    long = (chords[1:-1] > _SHORTEST * width_px).all() and chords[[0, -1]].min() > _LEAST_END * width_px
    bulgy = np.linalg.norm(chain.bulges, axis=1) > _BULGIEST * chords
    folded = (chain.arriving[:-1] * chain.leaving[1:]).sum(axis=1) < _SHARPEST
    return bool(long and not bulgy.any() and not folded.any())
